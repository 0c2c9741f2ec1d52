//! Sums without rounding, so that masses add up to the same bits in any order and any grouping.
//!
//! A fixed-point number wide enough for every double, in digits of 32 bits (Kulisch's long accumulator; see Neal 2015,
//! arXiv:1505.05571). Only what is ≥ 0 and finite can be added.

use carom::math::powi;

/// Digits of 32 bits from 2⁻¹⁰⁷⁴ up: 2098 bits and room for carries.
const DIGITS: usize = 68;
const LOWEST: i32 = -1074;

/// An exact sum of doubles ≥ 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactSum {
    digits: [u64; DIGITS],
    /// Additions since digits were last carried.
    pending: u32,
}

impl Default for ExactSum {
    fn default() -> Self {
        Self { digits: [0; DIGITS], pending: 0 }
    }
}

impl ExactSum {
    /// Adds a number; what is negative or not finite is left out.
    pub fn add(&mut self, x: f64) {
        if !(x > 0.0 && x.is_finite()) {
            return;
        }
        let bits = x.to_bits();
        let exponent = (bits >> 52) as i32;
        let fraction = bits & ((1 << 52) - 1);
        let (mantissa, shift) = if exponent == 0 { (fraction, 0) } else { (fraction | 1 << 52, exponent - 1) };
        let (digit, offset) = ((shift / 32) as usize, shift % 32);
        let wide = u128::from(mantissa) << offset;
        for i in 0..3 {
            if let Some(d) = self.digits.get_mut(digit + i) {
                *d += (wide >> (32 * i)) as u64 & 0xFFFF_FFFF;
            }
        }
        self.pending += 1;
        if self.pending == 1 << 30 {
            self.carry();
        }
    }

    /// Adds another sum.
    pub fn merge(&mut self, other: &Self) {
        let mut other = other.clone();
        self.carry();
        other.carry();
        for (d, o) in self.digits.iter_mut().zip(other.digits) {
            *d += o;
        }
        self.carry();
    }

    fn carry(&mut self) {
        let mut over = 0;
        for d in &mut self.digits {
            let sum = *d + over;
            *d = sum & 0xFFFF_FFFF;
            over = sum >> 32;
        }
        self.pending = 0;
    }

    /// The nearest double, ties to even.
    pub fn value(&self) -> f64 {
        let mut sum = self.clone();
        sum.carry();
        let Some(top) = sum.digits.iter().rposition(|d| *d != 0) else { return 0.0 };
        // 128 bits from the top, the rest as one sticky bit: more than enough to round once
        let low = top.saturating_sub(3);
        let mut head: u128 = 0;
        for d in sum.digits[low..=top].iter().rev() {
            head = head << 32 | u128::from(*d);
        }
        if sum.digits[..low].iter().any(|d| *d != 0) {
            head |= 1;
        }
        // the conversion rounds to nearest even; the scale is a power of two, applied in two halves without loss
        let exponent = LOWEST + 32 * low as i32;
        let half = exponent / 2;
        head as f64 * powi(2.0, half) * powi(2.0, exponent - half)
    }

    /// The digits that are not zero, for a file.
    pub fn to_digits(&self) -> Vec<(usize, u64)> {
        let mut sum = self.clone();
        sum.carry();
        sum.digits.iter().copied().enumerate().filter(|(_, d)| *d != 0).collect()
    }

    /// From [`ExactSum::to_digits`].
    pub fn from_digits(digits: &[(usize, u64)]) -> Self {
        let mut sum = Self::default();
        for (i, d) in digits {
            if let Some(place) = sum.digits.get_mut(*i) {
                *place = *d;
            }
        }
        sum
    }
}

impl serde::Serialize for ExactSum {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.to_digits().serialize(serializer)
    }
}

impl<'de> serde::Deserialize<'de> for ExactSum {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Vec::deserialize(deserializer).map(|digits: Vec<_>| Self::from_digits(&digits))
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
            parts.merge(&ExactSum::from_digits(&sum(a).to_digits()));
            prop_assert_eq!(sum(&values).value().to_bits(), sum(&reversed).value().to_bits());
            prop_assert_eq!(sum(&values).value().to_bits(), parts.value().to_bits());
            let plain: f64 = values.iter().sum();
            prop_assert!((sum(&values).value() - plain).abs() <= 1e-14 * plain);
        }
    }
}
