//! Sums without rounding, so that masses add up to the same bits in any order and any grouping.
//!
//! A fixed-point number wide enough for every double (Kulisch's long accumulator; see Neal 2015, arXiv:1505.05571), of which
//! only a window of four limbs of 64 bits is kept, laid where the run's own values are: the window follows what is added.
//! Four limbs hold 2⁵³ values whose sizes differ by a factor of up to 2⁸⁶; a sum of more unlike values keeps all limbs, on
//! the heap. Only what is ≥ 0 and finite can be added.

/// Limbs of 64 bits from 2⁻¹⁰⁷⁴ up: 2098 bits and room for carries.
const LIMBS: usize = 34;
/// Limbs of the window.
const WINDOW: usize = 4;
const LOWEST: i32 = -1074;

/// An exact sum of doubles ≥ 0.
#[derive(Clone, Debug, Default)]
pub struct ExactSum {
    /// Index of the window's lowest limb.
    low: u8,
    window: [u64; WINDOW],
    /// All limbs, where the window does not hold the sum.
    wide: Option<Box<[u64; LIMBS]>>,
}

/// Adds three limbs at `place` and carries on; `false` where the sum does not fit, and what it then holds is of no use.
fn add_at(limbs: &mut [u64], place: usize, parts: &[u64]) -> bool {
    let mut carry = false;
    for (i, part) in parts.iter().copied().chain(std::iter::repeat(0)).enumerate() {
        if i >= parts.len() && !carry {
            return true;
        }
        let Some(limb) = limbs.get_mut(place + i) else {
            return part == 0 && !carry && parts[i..].iter().all(|p| *p == 0);
        };
        let (sum, over) = limb.overflowing_add(part);
        let (sum, over_again) = sum.overflowing_add(u64::from(carry));
        (*limb, carry) = (sum, over | over_again);
    }
    true
}

impl ExactSum {
    /// Adds a number; what is negative or not finite is left out.
    pub fn add(&mut self, x: f64) {
        if !(x > 0.0 && x.is_finite()) {
            return;
        }
        let bits = x.to_bits();
        let exponent = (bits >> 52) as u32;
        let fraction = bits & ((1 << 52) - 1);
        let (mantissa, shift) = if exponent == 0 { (fraction, 0) } else { (fraction | 1 << 52, exponent - 1) };
        let wide = u128::from(mantissa) << (shift % 64);
        self.add_limbs((shift / 64) as usize, &[wide as u64, (wide >> 64) as u64]);
    }

    /// Adds limbs of which the lowest has that index.
    fn add_limbs(&mut self, place: usize, parts: &[u64]) {
        if self.wide.is_none() {
            if self.window == [0; WINDOW] {
                self.low = place as u8;
            }
            let before = (self.low, self.window);
            if self.reach_down(place) && add_at(&mut self.window, place - usize::from(self.low), parts) {
                return;
            }
            // from the top down there may be room yet
            (self.low, self.window) = before;
            if self.reach_up(place, parts) {
                return;
            }
            (self.low, self.window) = before;
            self.wide = Some(Box::new(self.limbs()));
        }
        if let Some(wide) = &mut self.wide {
            let fits = add_at(wide.as_mut_slice(), place, parts);
            debug_assert!(fits, "2^53 of the largest doubles fit");
        }
    }

    /// Moves the window down to a limb, if nothing falls off its top.
    fn reach_down(&mut self, place: usize) -> bool {
        let low = usize::from(self.low);
        if place >= low {
            return true;
        }
        let by = low - place;
        if by >= WINDOW || self.window[WINDOW - by..].iter().any(|limb| *limb != 0) {
            return false;
        }
        self.window.rotate_right(by);
        self.low = place as u8;
        true
    }

    /// Adds limbs after moving the window up over the empty limbs at its bottom.
    fn reach_up(&mut self, place: usize, parts: &[u64]) -> bool {
        let empty = self.window.iter().take_while(|limb| **limb == 0).count();
        let by = empty.min(place.saturating_sub(usize::from(self.low)));
        if by == 0 {
            return false;
        }
        self.window.rotate_left(by);
        self.low += by as u8;
        add_at(&mut self.window, place - usize::from(self.low), parts)
    }

    /// Adds another sum.
    pub fn merge(&mut self, other: &Self) {
        match &other.wide {
            Some(wide) => wide.iter().enumerate().for_each(|(i, limb)| self.add_one(i, *limb)),
            None => {
                let low = usize::from(other.low);
                other.window.iter().enumerate().for_each(|(i, limb)| self.add_one(low + i, *limb));
            }
        }
    }

    fn add_one(&mut self, place: usize, limb: u64) {
        if limb != 0 {
            self.add_limbs(place, &[limb]);
        }
    }

    /// All limbs.
    fn limbs(&self) -> [u64; LIMBS] {
        if let Some(wide) = &self.wide {
            return **wide;
        }
        let mut all = [0; LIMBS];
        for (limb, part) in all.iter_mut().skip(usize::from(self.low)).zip(self.window) {
            *limb = part;
        }
        all
    }

    /// The nearest double, ties to even.
    pub fn value(&self) -> f64 {
        let limbs = self.limbs();
        let Some(top) = limbs.iter().rposition(|limb| *limb != 0) else { return 0.0 };
        // at least 65 bits from the top, the rest as one sticky bit: enough to round once
        let low = top.saturating_sub(1);
        let mut head = u128::from(limbs[top]) << 64 | u128::from(limbs[low]);
        if top == 0 {
            head = u128::from(limbs[0]);
        }
        if limbs[..low].iter().any(|limb| *limb != 0) {
            head |= 1;
        }
        // the conversion rounds to nearest even; the scale is a power of two, applied in two halves without loss
        let exponent = LOWEST + 64 * low as i32;
        let half = exponent / 2;
        head as f64 * power_of_two(half) * power_of_two(exponent - half)
    }

    /// The digits of 32 bits that are not zero, with their places, for a file.
    pub fn to_digits(&self) -> Vec<(usize, u64)> {
        let limbs = self.limbs();
        let digits = limbs.iter().flat_map(|limb| [limb & 0xFFFF_FFFF, limb >> 32]);
        digits.enumerate().filter(|(_, digit)| *digit != 0).collect()
    }

    /// From [`ExactSum::to_digits`]; `None` where a digit is out of its range.
    pub fn from_digits(digits: &[(usize, u64)]) -> Option<Self> {
        let mut sum = Self::default();
        for (place, digit) in digits {
            if place / 2 >= LIMBS || *digit > 0xFFFF_FFFF {
                return None;
            }
            sum.add_one(place / 2, digit << (32 * (place % 2)));
        }
        Some(sum)
    }
}

/// 2ⁿ where that is a normal double.
fn power_of_two(n: i32) -> f64 {
    debug_assert!((-1022..=1023).contains(&n));
    f64::from_bits(((n + 1023) as u64) << 52)
}

impl PartialEq for ExactSum {
    fn eq(&self, other: &Self) -> bool {
        self.limbs() == other.limbs()
    }
}

impl Eq for ExactSum {}

impl serde::Serialize for ExactSum {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.to_digits().serialize(serializer)
    }
}

impl<'de> serde::Deserialize<'de> for ExactSum {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let digits = Vec::<(usize, u64)>::deserialize(deserializer)?;
        Self::from_digits(&digits).ok_or_else(|| serde::de::Error::custom("a sum with a digit out of its range"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sum(values: &[f64]) -> ExactSum {
        let mut s = ExactSum::default();
        values.iter().for_each(|v| s.add(*v));
        s
    }

    #[test]
    fn exact_where_plain_sums_are_not() {
        assert_eq!(sum(&[1e16, 1.0, 1.0]).value(), 1e16 + 2.0);
        assert_eq!(sum(&[0.1; 10]).value(), 1.0);
        assert_eq!(sum(&[f64::MAX, f64::MIN_POSITIVE]).value(), f64::MAX);
        assert_eq!(sum(&[f64::MIN_POSITIVE]).value(), f64::MIN_POSITIVE);
        assert_eq!(sum(&[3.0, f64::NAN, -1.0]).value(), 3.0);
        assert_eq!(sum(&[]).value(), 0.0);
    }

    proptest! {
        #[test]
        fn any_order_and_grouping_gives_the_same_bits(values in prop::collection::vec(0.0f64..1e-9, 1..60), cut in 0usize..60) {
            let mut reversed = values.clone();
            reversed.reverse();
            let (a, b) = values.split_at(cut.min(values.len()));
            let mut parts = sum(b);
            parts.merge(&ExactSum::from_digits(&sum(a).to_digits()).expect("its own digits"));
            prop_assert_eq!(sum(&values).value().to_bits(), sum(&reversed).value().to_bits());
            prop_assert_eq!(sum(&values).value().to_bits(), parts.value().to_bits());
            let plain: f64 = values.iter().sum();
            prop_assert!((sum(&values).value() - plain).abs() <= 1e-14 * plain);
        }
    }

    /// All limbs in one long accumulator: what the window must agree with.
    fn long(values: &[f64]) -> Vec<(usize, u64)> {
        let mut digits = [0u64; 2 * LIMBS];
        for x in values {
            let (bits, exponent) = (x.to_bits(), (x.to_bits() >> 52) as usize);
            let fraction = bits & ((1 << 52) - 1);
            let (mantissa, shift) = if exponent == 0 { (fraction, 0) } else { (fraction | 1 << 52, exponent - 1) };
            for bit in (0..53).filter(|b| mantissa >> b & 1 == 1) {
                digits[(shift + bit) / 32] += 1 << ((shift + bit) % 32);
            }
        }
        let mut over = 0;
        for d in &mut digits {
            let sum = *d + over;
            (*d, over) = (sum & 0xFFFF_FFFF, sum >> 32);
        }
        digits.into_iter().enumerate().filter(|(_, d)| *d != 0).collect()
    }

    #[test]
    fn it_is_small_and_stays_off_the_heap_for_what_one_run_weighs() {
        assert!(size_of::<ExactSum>() <= 48);
        // spheres of 1 nm and of 1 m, in one run
        let mut s = sum(&[1e-24; 100]);
        (0..100).for_each(|_| s.add(1e4));
        assert!(s.wide.is_none());
    }

    proptest! {
        #[test]
        fn the_window_holds_what_a_long_accumulator_holds(
            values in prop::collection::vec((0u64..0x7FE, 0u64..1 << 52), 1..40),
            near in any::<bool>(),
        ) {
            let span = |e: u64| if near { 900 + e % 150 } else { e };
            let values: Vec<f64> = values.iter().map(|(e, m)| f64::from_bits(span(*e) << 52 | m)).collect();
            prop_assert_eq!(sum(&values).to_digits(), long(&values));
            let mut parts = ExactSum::default();
            values.iter().rev().for_each(|v| parts.merge(&sum(&[*v])));
            prop_assert_eq!(&parts, &sum(&values));
            let largest = values.iter().fold(0.0f64, |a, b| a.max(*b));
            prop_assert!(parts.value() >= largest && parts.value() <= largest * values.len() as f64 * (1.0 + 1e-15));
        }
    }
}
