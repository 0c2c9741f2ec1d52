//! What the processor can do, asked in one place; only what was asked is used.
//!
//! A loop that is to run on the widest vectors is written once, as a [`Work`]; [`InstructionSet::run`] holds one copy of it for each set
//! of instructions and enters only copies that the processor can execute. All give the same bits: the sets differ in how many numbers an
//! instruction takes and in how a fused multiply-add is made ([`crate::math::Fma`]), never in the order of operations.
//!
//! ```
//! use carom::instructions::{InstructionSet, Work};
//! use carom::math::Fma;
//!
//! struct Sum<'a>(&'a [f64], f64);
//! impl Work for Sum<'_> {
//!     type Output = f64;
//!     #[inline(always)]
//!     fn run<F: Fma, const LANES: usize>(self, f: F) -> f64 {
//!         self.0.iter().fold(0.0, |sum, &x| f.fma(self.1, x, sum))
//!     }
//! }
//! for set in InstructionSet::available() {
//!     assert_eq!(set.run(Sum(&[0.1, 0.2], 3.0)).to_bits(), InstructionSet::Portable.run(Sum(&[0.1, 0.2], 3.0)).to_bits());
//! }
//! ```

use crate::math::{Fma, Plain};

/// A set of instructions. All give the same bits; only the speed differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InstructionSet {
    /// x86-64 with AVX-512 F, DQ, VL and BW, beside all of [`InstructionSet::Avx2`]: eight numbers at once.
    Avx512,
    /// x86-64 with AVX2, FMA, BMI1 and BMI2: four numbers at once.
    Avx2,
    /// AArch64, which has fused multiply-add and vectors of two numbers on every processor.
    Neon,
    /// What the crate was compiled for, and no fused multiply-add.
    Portable,
}

/// Something to compute, compiled for each set of instructions.
pub trait Work: Sized {
    /// What it computes.
    type Output;

    /// How many lanes it is laid out for, if it is: it has no copies for sets of other lanes. Who lays it out has asked what the processor has.
    const LAID_OUT_FOR: Option<usize> = None;

    /// The work, with the multiply-add of the set; `LANES` numbers fill two of its vectors (1 where there are none to fill). Must be
    /// `#[inline(always)]`, and all it calls that is to be vectorised: what is not inlined is compiled for the plain machine.
    fn run<F: Fma, const LANES: usize>(self, f: F) -> Self::Output;

    /// The work on [`InstructionSet::Portable`]; loops of many numbers do it with [`crate::math::watched`].
    #[inline(always)]
    fn run_portable(self) -> Self::Output {
        self.run::<_, 1>(Plain)
    }
}

impl InstructionSet {
    /// Those that this processor has, best first.
    pub fn available() -> impl Iterator<Item = Self> {
        [Self::Avx512, Self::Avx2, Self::Neon, Self::Portable].into_iter().filter(|set| set.is_here())
    }

    /// The best that this processor has.
    #[inline]
    pub fn best() -> Self {
        Self::available().next().unwrap_or(Self::Portable)
    }

    /// Does the work with these instructions, or with [`InstructionSet::Portable`] where the processor lacks them.
    pub fn run<W: Work>(self, work: W) -> W::Output {
        match self {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: the processor has all that `avx512` is compiled for, as was just asked.
            Self::Avx512 if const { fits::<W>(16) } && x86::has_avx512() => unsafe { x86::avx512(work) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: the processor has all that `avx2` is compiled for, as was just asked.
            Self::Avx2 if const { fits::<W>(8) } && x86::has_avx2() => unsafe { x86::avx2(work) },
            #[cfg(target_arch = "aarch64")]
            Self::Neon => work.run::<_, 4>(crate::math::Fused),
            _ => work.run_portable(),
        }
    }

    fn is_here(self) -> bool {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => x86::has_avx512(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => x86::has_avx2(),
            Self::Neon => cfg!(target_arch = "aarch64"),
            Self::Portable => true,
            #[allow(unreachable_patterns)]
            _ => false,
        }
    }
}

/// Whether a copy of the work for so many lanes is one that may be asked for.
const fn fits<W: Work>(lanes: usize) -> bool {
    match W::LAID_OUT_FOR {
        None => true,
        Some(wanted) => wanted == lanes,
    }
}

/// Work on single numbers, not on vectors (one impact): with the processor's fused multiply-add if there is one.
// without `inline`: a copy for each part of a crate that asks would be no faster
pub fn run_scalar<W: Work>(work: W) -> W::Output {
    run_fused(work, W::run_portable)
}

/// Likewise; what is done where there is none is the caller's, which may have it compiled already.
#[inline]
pub(crate) fn run_fused<W: Work>(work: W, otherwise: impl FnOnce(W) -> W::Output) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    if x86::has_fma() {
        // SAFETY: the processor has what `fma` is compiled for, as was just asked.
        return unsafe { x86::fma(work) };
    }
    if cfg!(target_arch = "aarch64") { work.run::<_, 1>(crate::math::Fused) } else { otherwise(work) }
}

/// The questions and the copies stand side by side: a feature that is enabled in a copy is asked for in its question.
#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::Work;
    use crate::math::Fused;

    /// Asked while running, with `std`; else what the crate was compiled for.
    macro_rules! all {
        ($($feature:tt)*) => {{
            #[cfg(feature = "std")]
            let here = true $(&& std::arch::is_x86_feature_detected!($feature))*;
            #[cfg(not(feature = "std"))]
            let here = true $(&& cfg!(target_feature = $feature))*;
            here
        }};
    }

    #[inline]
    pub(super) fn has_avx512() -> bool {
        all!("avx512f" "avx512dq" "avx512vl" "avx512bw" "avx2" "fma" "bmi1" "bmi2")
    }

    // a frame of its own, even where work is done within work
    #[inline(never)]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw,avx2,fma,bmi1,bmi2")]
    pub(super) fn avx512<W: Work>(work: W) -> W::Output {
        work.run::<_, 16>(Fused)
    }

    #[inline]
    pub(super) fn has_avx2() -> bool {
        all!("avx2" "fma" "bmi1" "bmi2")
    }

    #[inline(never)]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2")]
    pub(super) fn avx2<W: Work>(work: W) -> W::Output {
        work.run::<_, 8>(Fused)
    }

    #[inline]
    pub(super) fn has_fma() -> bool {
        all!("fma")
    }

    #[target_feature(enable = "fma")]
    pub(super) fn fma<W: Work>(work: W) -> W::Output {
        work.run::<_, 1>(Fused)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Horner<'a>(&'a [f64]);

    impl Work for Horner<'_> {
        type Output = (u64, usize);
        #[inline(always)]
        fn run<F: Fma, const LANES: usize>(self, f: F) -> (u64, usize) {
            (self.0.iter().fold(1.0, |sum, &x| f.fma(sum, x, 0.1)).to_bits(), LANES)
        }
    }

    #[test]
    fn every_set_does_the_work_with_the_same_bits() {
        let numbers: Vec<f64> = (1..100).map(|i| 1.0 / f64::from(i)).collect();
        let (want, lanes) = InstructionSet::Portable.run(Horner(&numbers));
        assert_eq!(lanes, 1);
        assert_eq!(run_scalar(Horner(&numbers)), (want, 1));
        for set in [InstructionSet::Avx512, InstructionSet::Avx2, InstructionSet::Neon, InstructionSet::Portable] {
            let (bits, lanes) = set.run(Horner(&numbers));
            assert_eq!(bits, want, "{set:?}");
            let here = InstructionSet::available().any(|s| s == set);
            let want = match set {
                InstructionSet::Avx512 if here => 16,
                InstructionSet::Avx2 if here => 8,
                InstructionSet::Neon if here => 4,
                _ => 1,
            };
            assert_eq!(lanes, want, "{set:?}");
        }
    }
}
