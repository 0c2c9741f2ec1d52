//! Choices between lanes without branches.

use crate::integrate::Lanes;

/// All bits set for lanes that something is true of, none for the others: what vectors choose by.
pub type Mask<const W: usize> = [u64; W];

/// One lane's bits.
#[inline(always)]
pub(crate) fn mask(is_true: bool) -> u64 {
    u64::from(is_true).wrapping_neg()
}

/// Takes the new values where they are wanted.
#[inline(always)]
pub(crate) fn choose<const W: usize>(old: &mut Lanes<W>, new: &Lanes<W>, wanted: &Mask<W>) {
    for l in 0..W {
        old[l] = f64::from_bits((new[l].to_bits() & wanted[l]) | (old[l].to_bits() & !wanted[l]));
    }
}

/// The lanes of a mask as the bits of a number: lane 0 is the lowest.
#[inline(always)]
pub(crate) fn bits<const W: usize>(mask: &Mask<W>) -> u64 {
    mask.iter().enumerate().fold(0, |bits, (l, mask)| bits | (mask & (1 << l)))
}

/// Takes the lowest lane out of the bits of [`bits`].
#[inline(always)]
pub(crate) fn take_lowest(bits: &mut u64) -> Option<usize> {
    let lane = bits.trailing_zeros() as usize;
    let some = *bits != 0;
    *bits &= bits.wrapping_sub(1);
    some.then_some(lane)
}
