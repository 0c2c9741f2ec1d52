//! The contact equation resolved in time, `resolved`: adhesion, Hertz force and both dampings while the surfaces touch.
//!
//! Kim & Dunn (2007), Eqs 4 and 8–12 (with C_R), J. Aerosol Sci. 38, 532–549, <https://doi.org/10.1016/j.jaerosci.2007.03.006>. With
//! overlap x ≥ 0, contact radius a = √(rx), ẋ > 0 approaching:
//!
//! m ẍ = −√r K x^{3/2}(1 + C_H ẋ) + 2πa f₀C_R(1 − C_A ẋ)
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | m, r | sphere mass, effective radius | kg, m |
//! | K, f₀ | Hertzian stiffness, tension of the adhesion force | Pa, N/m |
//! | C_A, C_H | damping coefficients | s/m |
//!
//! **Two readings of the adhesion.** As printed it acts on approach and separation alike (`reversible`): conservative, so without
//! damping e = 1 at every speed. The algebraic EA form follows when it acts only while the surfaces separate (`separation-only`, the
//! default): undamped, both give the same e, an identity that checks the integrator and validates nothing. With damping they differ
//! to first order, since the algebraic form is a quadrature (see [`crate::normal::damping`]).
//!
//! Rebound is the first return to x = 0; capture is a turning point with x > 0 during separation. Friction (Eqs 26–28): Coulomb's law on
//! the Hertz force until the slip ends, then none, so the effective friction is f · J_Hertz/J_n, larger than f near capture.
//!
//! **How it is solved.** In units of the Hertz contact (L^{5/2} = mv²/(√rK), time L/v) three numbers remain: A = Ψ_A/((4/3)(5/4)^{3/5}),
//! C_A v, C_H v. With x = s² and dt = 2s dσ the square roots vanish and the equation is a polynomial system, smooth from the first touch
//! to the last. It is followed by Dormand and Prince's pair of order 8 (Hairer, Nørsett & Wanner 1993) at relative tolerance 2e-9; the
//! turning point and the end are reached exactly by running the last step in the speed or the depth (Hénon 1982, Physica D 5, 412–414,
//! <https://doi.org/10.1016/0167-2789(82)90034-3>).
//!
//! ```
//! use carom::resolved::{AdhesionMode, Damping, Resolved};
//! use carom::normal::{Size, adhesion::Work};
//! // 70 µm stainless steel on silicon, Kim & Dunn (2007), Fig. 8
//! let work = Work::new(127.8e9, 3.03, 0.15, 8000.0);
//! let contact = Resolved::new(work, Damping { adhesion: 1.3, hertz: 0.007 }, AdhesionMode::SeparationOnly);
//! assert!((contact.restitution(1.0, &Size::flat(35e-6)) - 0.94184).abs() < 1e-4);
//! ```

mod coefficients;
mod history;
mod motion;

pub use history::{Moment, Scales};

use crate::instructions::{self, InstructionSet};
use crate::math::{self, Fma};
use crate::normal::adhesion::{AdhesionDamping, Work};
use crate::normal::damping::HertzDamping;
use crate::normal::{Losses, NormalResponse, Size, Term, Window};
use crate::validity::Validity;
use motion::{Equation, Motion};

/// When adhesion acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum AdhesionMode {
    /// While the surfaces separate (the hysteresis behind the algebraic form).
    #[default]
    SeparationOnly,
    /// On approach and separation alike, as Eq. 4 is printed.
    Reversible,
}

/// Damping coefficients, s/m; zero for none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Damping {
    /// C_A.
    pub adhesion: f64,
    /// C_H.
    pub hertz: f64,
}

impl Damping {
    fn is_none(&self) -> bool {
        self.adhesion == 0.0 && self.hertz == 0.0
    }
}

/// The resolved law of one pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolved {
    work: Work,
    damping: Damping,
    mode: AdhesionMode,
}

/// Ψ_A over A: (4/3)(5/4)^{3/5}.
const PSI_OVER_A: f64 = 1.524_350_173_091_087_8;

impl Resolved {
    /// From the constants of Ψ_A, the damping coefficients and the reading of adhesion.
    pub fn new(work: Work, damping: Damping, mode: AdhesionMode) -> Self {
        Self { work, damping, mode }
    }

    /// The greatest energy with which adhesion holds a captured sphere, over half the sphere's mass, m²/s²; the algebraic law's.
    pub(crate) fn hold_squared(&self, size: &Size) -> f64 {
        let v = self.work.capture_velocity(size);
        v * v
    }

    /// The same adhesion and damping as losses of the algebraic law.
    pub(crate) fn as_losses(&self) -> [Term; 3] {
        [
            Term::AdhesionWork(self.work),
            Term::AdhesionDamping(AdhesionDamping::new(self.work, self.damping.adhesion)),
            Term::HertzDamping(HertzDamping { coefficient: self.damping.hertz }),
        ]
    }

    #[inline(always)]
    fn contact<F: Fma>(&self, f: F, v: f64, size: &Size) -> Equation {
        Equation {
            adhesion: self.work.fraction_on(f, v, size) / PSI_OVER_A,
            adhesion_damping: self.damping.adhesion * v,
            hertz_damping: self.damping.hertz * v,
            reversible: self.mode == AdhesionMode::Reversible,
        }
    }

    /// e at approach speed `v` (m/s), 0 for a capture.
    pub fn restitution(&self, v: f64, size: &Size) -> f64 {
        self.respond(v, size).e
    }

    /// Not inlined: the series need a large stack frame, which the other laws should not pay for.
    #[inline(never)]
    pub(crate) fn respond(&self, v: f64, size: &Size) -> NormalResponse {
        InstructionSet::best().run(Respond { law: self, v, size })
    }

    #[inline(always)]
    fn respond_body<F: Fma>(&self, f: F, v: f64, size: &Size) -> NormalResponse {
        let contact = self.contact(f, v, size);
        let motion = contact.solve(f, f64::INFINITY, &mut |_, _| ());
        response(&contact, &motion)
    }

    /// Warnings that belong to this law.
    #[inline(always)]
    pub(crate) fn warnings(&self, v: f64) -> Validity {
        let repelling = self.mode == AdhesionMode::Reversible && self.damping.adhesion * v > 1.0;
        Validity::REPELLING_ADHESION.when(repelling).with(Validity::PULLING_HERTZ.when(self.damping.hertz * v > 1.0))
    }

    /// The window of rebound: the capture velocity by bisection (there is no upper end: damping forces fade with the speed).
    pub fn window(&self, size: &Size) -> Option<Window> {
        let open = |v: f64| self.restitution(v, size) > 0.0;
        let mut high = self.work.capture_velocity(size);
        if high == 0.0 || (self.mode == AdhesionMode::Reversible && self.damping.is_none()) {
            return Some(Window::ALL);
        }
        let mut low = high;
        for _ in 0..60 {
            if open(high) {
                break;
            }
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..60 {
            if !open(low) {
                break;
            }
            (high, low) = (low, 0.5 * low);
        }
        if !open(high) || open(low) {
            return open(high).then_some(Window::ALL);
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if open(middle) { high = middle } else { low = middle }
        }
        Some(Window { capture_velocity: low, exhausted_velocity: f64::INFINITY })
    }
}

struct Respond<'a> {
    law: &'a Resolved,
    v: f64,
    size: &'a Size,
}

impl instructions::Work for Respond<'_> {
    type Output = NormalResponse;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, f: F) -> NormalResponse {
        self.law.respond_body(f, self.v, self.size)
    }
}

/// Energy fractions from the work done along the way; e from what they leave.
#[inline(always)]
fn response(contact: &Equation, motion: &Motion) -> NormalResponse {
    let adhesion = if contact.reversible {
        0.0
    } else {
        4.0 / 3.0 * contact.adhesion * motion.deepest * motion.deepest * motion.deepest
    };
    let mut losses = Losses {
        adhesion,
        adhesion_damping: 2.0 * motion.end.rides.adhesion_work,
        hertz_damping: 2.0 * motion.end.rides.hertz_work,
        ..Losses::default()
    };
    if motion.captured {
        // what is not dissipated yet holds the sphere: the adhesion's
        let dissipated = losses.adhesion_damping + losses.hertz_damping;
        losses.adhesion = losses.adhesion.max(1.0 - dissipated);
        return NormalResponse { e: 0.0, losses, friction_share: 1.0 };
    }
    let left = 1.0 - losses.total();
    let e = if left > 0.0 { math::sqrt(left) } else { 0.0 };
    NormalResponse { e, losses, friction_share: motion.end.rides.impulse / (1.0 + e) }
}

#[cfg(test)]
mod tests;
