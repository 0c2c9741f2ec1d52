//! What can be asked of a key: its name and back, its range, what stands in its way.

use super::keys::{Key, LawSpec};
use super::range::Range;
use super::uses::{Choice, IDLE_BESIDE, ONE_OF};
use crate::error::{LawError, Problem};
#[cfg(not(feature = "std"))]
use crate::math::Plainly as _;
use alloc::borrow::ToOwned;
use alloc::string::ToString;

impl Key {
    /// As written in a law's text.
    pub const fn name(self) -> &'static str {
        self.info().name
    }

    pub(crate) const fn noun(self) -> &'static str {
        self.info().noun
    }

    pub(crate) const fn example(self) -> &'static str {
        self.info().example
    }

    /// The key of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|k| k.name() == name)
    }

    /// Whether it takes a number.
    pub fn is_number(self) -> bool {
        LawSpec::default().set_number(self, 1.0) && !matches!(self, Self::Restitution | Self::TangentialRestitution)
    }

    /// The number, if it lies in the key's range.
    ///
    /// # Errors
    /// Out of range, with what would be right.
    pub fn check(self, value: f64) -> Result<f64, LawError> {
        let range = &self.info().range;
        if range.contains(value) { Ok(value) } else { Err(out_of_range(self.name(), value, self.info().unit, range)) }
    }
}

impl Key {
    /// Both ends of what may be drawn or fitted; ends that do not belong to the range are left out.
    pub fn ends(self) -> (f64, f64) {
        let Range { low, low_included, high, high_included, .. } = self.info().range;
        let low = if low_included { low } else { low.next_up() };
        let high = if high_included || high.is_infinite() { high } else { high.next_down() };
        (self.info().search.map_or(low, |s| low.max(s.least)), high)
    }
}

impl core::fmt::Display for Key {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.name())
    }
}

/// By name (`-` counts as `_`) or symbol.
impl core::str::FromStr for Key {
    type Err = LawError;
    fn from_str(text: &str) -> Result<Self, LawError> {
        let wanted = text.trim().replace('-', "_");
        let by_symbol = || Self::ALL.iter().copied().find(|k| !k.info().symbol.is_empty() && k.info().symbol == wanted);
        Self::by_name(&wanted).or_else(by_symbol).ok_or_else(|| super::values::unknown_name("key", text, Self::NAMES))
    }
}

impl LawSpec {
    /// Takes out what `key` would take the place of, such as the roughness where C_R is given.
    pub fn make_room(&mut self, key: Key) {
        let both_ways = ONE_OF.into_iter().flat_map(|(one, other)| [(one, other), (other, one)]);
        for (_, put_aside) in both_ways.chain(IDLE_BESIDE).filter(|(given, _)| *given == key) {
            self.remove(put_aside);
            for idle in Key::ALL.iter().copied().filter(|k| Choice::only_beside(*k, put_aside)) {
                self.remove(idle);
            }
        }
    }
}

/// A number that lies outside its range.
pub(crate) fn out_of_range(key: &str, value: f64, unit: &'static str, range: &Range) -> LawError {
    // an angle is refused in degrees, as it is thought of
    let (value, unit) = if unit == "rad" { ((value.to_degrees() * 1e6).round() / 1e6, "deg") } else { (value, unit) };
    Problem::OutOfRange { key: key.to_owned(), value: value.to_string(), unit, right: range.right.to_owned() }.into()
}
