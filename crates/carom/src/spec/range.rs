//! Where a number may lie, and the words for it.

/// A range of a key or a property, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Lower end.
    pub low: f64,
    /// Whether the lower end belongs to it.
    pub low_included: bool,
    /// Upper end; infinity leaves it open.
    pub high: f64,
    /// Whether the upper end belongs to it.
    pub high_included: bool,
    /// A value inside that it leaves out.
    pub but: Option<f64>,
    /// What would be right, in words.
    pub right: &'static str,
}

impl Range {
    /// Any number.
    pub(crate) const ANY: Self = Self {
        low: f64::NEG_INFINITY,
        low_included: true,
        high: f64::INFINITY,
        high_included: true,
        but: None,
        right: "a number is wanted",
    };

    /// From `low` on, `low` included; finite.
    pub(crate) const fn from(low: f64, right: &'static str) -> Self {
        Self { low, low_included: true, high: f64::INFINITY, high_included: false, but: None, right }
    }

    /// Above `low`; finite.
    pub(crate) const fn above(low: f64, right: &'static str) -> Self {
        Self { low, low_included: false, high: f64::INFINITY, high_included: false, but: None, right }
    }

    /// Between both ends, the ends included.
    pub(crate) const fn within(low: f64, high: f64, right: &'static str) -> Self {
        Self { low, low_included: true, high, high_included: true, but: None, right }
    }

    /// Between both ends, the ends left out.
    pub(crate) const fn between(low: f64, high: f64, right: &'static str) -> Self {
        Self { low, low_included: false, high, high_included: false, but: None, right }
    }

    /// Any number but `value`, infinities included.
    pub(crate) const fn all_but(value: f64, right: &'static str) -> Self {
        Self { but: Some(value), right, ..Self::ANY }
    }

    /// Above `low` and up to `high`.
    pub(crate) const fn above_to(low: f64, high: f64, right: &'static str) -> Self {
        Self { low, low_included: false, high, high_included: true, but: None, right }
    }

    /// Does the number lie in it? NaN lies nowhere.
    pub fn contains(&self, value: f64) -> bool {
        let above = value > self.low || (self.low_included && value == self.low);
        let below = value < self.high || (self.high_included && value == self.high);
        above && below && self.but != Some(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_belong_to_a_range_or_do_not() {
        let c_r = Range::above_to(0.0, 1.0, "");
        assert!(c_r.contains(1.0) && c_r.contains(1e-300) && !c_r.contains(0.0) && !c_r.contains(f64::NAN));
        let length = Range::from(0.0, "");
        assert!(length.contains(0.0) && length.contains(-0.0) && !length.contains(f64::INFINITY));
        let radius = Range::all_but(0.0, "");
        assert!(radius.contains(f64::INFINITY) && radius.contains(-1.0) && !radius.contains(-0.0));
        assert!(!radius.contains(f64::NAN) && !Range::between(0.5, 3.0, "").contains(3.0));
    }
}
