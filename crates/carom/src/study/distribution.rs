//! Distributions of a quantity, truncated to what it can be, and their text form: `lognormal(50um, 1.3)` where a value stands else.

use crate::math::normal::{normal_probability, normal_quantile};
use crate::math::{exp, ln};
use crate::units::{Number, Quantity, UnitError};
use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::string::ToString;
use core::fmt;

/// A value, known exactly or as a distribution; SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Given {
    /// One value.
    One(f64),
    /// A distribution.
    Drawn(Distribution),
}

impl Given {
    /// The value, if it is one.
    #[must_use]
    pub fn one(&self) -> Option<f64> {
        match self {
            Self::One(value) => Some(*value),
            Self::Drawn(_) => None,
        }
    }

    /// The distribution, if it is one.
    #[must_use]
    pub fn distribution(&self) -> Option<&Distribution> {
        match self {
            Self::One(_) => None,
            Self::Drawn(d) => Some(d),
        }
    }

    /// The value, or the distribution's at a probability in (0, 1).
    #[must_use]
    pub fn at(&self, probability: f64) -> f64 {
        match self {
            Self::One(value) => *value,
            Self::Drawn(d) => d.quantile(probability),
        }
    }
}

/// A distribution, truncated to a range and renormalised.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// As written; empty for one that was not read from a text.
    text: String,
    kind: Kind,
    /// What the quantity can be.
    range: (f64, f64),
    /// The probabilities there.
    within: (f64, f64),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Lognormal { median: f64, ln_gsd: f64 },
    Normal { mean: f64, deviation: f64 },
    Uniform { from: f64, to: f64 },
}

/// What is wrong with a distribution.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// The median of a lognormal distribution is not positive.
    Median,
    /// A geometric standard deviation is not above 1.
    GeometricDeviation,
    /// A standard deviation is not positive.
    Deviation,
    /// The ends of a uniform distribution do not rise.
    NotRising,
    /// An end of a uniform distribution is out of the quantity's range.
    EndOutOfRange((f64, f64)),
    /// Less than half of the distribution lies in the quantity's range.
    MostlyOutOfRange((f64, f64)),
    /// No distribution of that name; the nearest known one, if one is near.
    UnknownName(String, Option<String>),
    /// The text is not of the form NAME(VALUE, VALUE).
    Form(&'static str),
    /// One of the values cannot be read.
    Value(String),
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let must_lie = |f: &mut fmt::Formatter<'_>, start: &str, (low, high): (f64, f64)| {
            if high < f64::INFINITY {
                write!(f, "{start}the value must lie between {low:e} and {high}")
            } else {
                write!(f, "{start}the value must not be negative")
            }
        };
        match self {
            Self::Median => f.write_str("the median must be positive"),
            Self::GeometricDeviation => f.write_str("a geometric standard deviation lies above 1"),
            Self::Deviation => f.write_str("the standard deviation must be positive"),
            Self::NotRising => f.write_str("the range does not rise"),
            Self::EndOutOfRange(range) => must_lie(f, "", *range),
            Self::MostlyOutOfRange(range) => must_lie(f, "most of it is out of range: ", *range),
            Self::UnknownName(name, near) => {
                write!(f, "no distribution '{name}'")?;
                near.as_ref().map_or(Ok(()), |near| write!(f, ", {near}"))
            }
            Self::Form(message) => f.write_str(message),
            Self::Value(message) => f.write_str(message),
        }
    }
}

/// A distribution that cannot be read, or is none.
#[derive(Clone, Debug, PartialEq)]
pub struct DistributionError {
    /// As written.
    pub text: String,
    /// The character of the text at fault, from 1.
    pub character: usize,
    /// What is wrong there.
    pub problem: Problem,
}

const FORMS: &str = "lognormal(MEDIAN, GSD), normal(MEAN, DEVIATION) and uniform(FROM, TO) are known";

impl fmt::Display for DistributionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\"{}\": {} (character {}); {FORMS}", self.text, self.problem, self.character)
    }
}

impl core::error::Error for DistributionError {}

/// Which of the two values is at fault.
type Fault = (usize, Problem);

impl Kind {
    const NAMES: [&str; 3] = ["lognormal", "normal", "uniform"];

    fn new(name: &str, a: f64, b: f64, range: (f64, f64)) -> Result<Self, Fault> {
        match name {
            "lognormal" if a <= 0.0 => Err((0, Problem::Median)),
            "lognormal" if b <= 1.0 => Err((1, Problem::GeometricDeviation)),
            "lognormal" => Ok(Self::Lognormal { median: a, ln_gsd: ln(b) }),
            "normal" if b <= 0.0 => Err((1, Problem::Deviation)),
            "normal" => Ok(Self::Normal { mean: a, deviation: b }),
            _ if a >= b => Err((1, Problem::NotRising)),
            _ if a < range.0 => Err((0, Problem::EndOutOfRange(range))),
            _ if b > range.1 => Err((1, Problem::EndOutOfRange(range))),
            _ => Ok(Self::Uniform { from: a, to: b }),
        }
    }

    fn probability(self, x: f64) -> f64 {
        match self {
            Self::Lognormal { .. } if x <= 0.0 => 0.0,
            Self::Lognormal { median, ln_gsd } => normal_probability(ln(x / median) / ln_gsd),
            Self::Normal { mean, deviation } => normal_probability((x - mean) / deviation),
            Self::Uniform { from, to } => ((x - from) / (to - from)).clamp(0.0, 1.0),
        }
    }

    fn quantile(self, p: f64) -> f64 {
        match self {
            Self::Lognormal { median, ln_gsd } => median * exp(ln_gsd * normal_quantile(p)),
            Self::Normal { mean, deviation } => mean + deviation * normal_quantile(p),
            Self::Uniform { from, to } => from + p * (to - from),
        }
    }
}

impl Distribution {
    /// Lognormal, by its median and geometric standard deviation, within `range`.
    ///
    /// # Errors
    /// A median that is not positive, a deviation not above 1, less than half of it in the range.
    pub fn lognormal(median: f64, gsd: f64, range: (f64, f64)) -> Result<Self, Problem> {
        Self::named("lognormal", median, gsd, range).map_err(|fault| fault.1)
    }

    /// Normal, by its mean and standard deviation, within `range`.
    ///
    /// # Errors
    /// A deviation that is not positive, less than half of it in the range.
    pub fn normal(mean: f64, deviation: f64, range: (f64, f64)) -> Result<Self, Problem> {
        Self::named("normal", mean, deviation, range).map_err(|fault| fault.1)
    }

    /// Uniform between two values, both in `range`.
    ///
    /// # Errors
    /// Values that do not rise or are out of range.
    pub fn uniform(from: f64, to: f64, range: (f64, f64)) -> Result<Self, Problem> {
        Self::named("uniform", from, to, range).map_err(|fault| fault.1)
    }

    fn named(name: &str, a: f64, b: f64, range: (f64, f64)) -> Result<Self, Fault> {
        let kind = Kind::new(name, a, b, range)?;
        let within = (kind.probability(range.0), kind.probability(range.1));
        if within.1 - within.0 >= 0.5 {
            Ok(Self { text: String::new(), kind, range, within })
        } else {
            Err((0, Problem::MostlyOutOfRange(range)))
        }
    }

    /// The value below which the share `probability` in (0, 1) lies.
    #[must_use]
    pub fn quantile(&self, probability: f64) -> f64 {
        let p = self.within.0 + probability * (self.within.1 - self.within.0);
        self.kind.quantile(p.clamp(1e-300, 1.0 - 1e-16)).clamp(self.range.0, self.range.1)
    }
}

impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind {
            _ if !self.text.is_empty() => f.write_str(&self.text),
            Kind::Lognormal { median, ln_gsd } => write!(f, "lognormal({median}, {})", exp(ln_gsd)),
            Kind::Normal { mean, deviation } => write!(f, "normal({mean}, {deviation})"),
            Kind::Uniform { from, to } => write!(f, "uniform({from}, {to})"),
        }
    }
}

/// Reads one value of a quantity, or a distribution of it within a range.
///
/// # Errors
/// What is wrong with the text, and where.
pub fn read<Q: Quantity>(text: &str, range: (f64, f64)) -> Result<Given, String> {
    if !text.contains('(') {
        return text.parse::<Q>().map(|v| Given::One(v.si())).map_err(|e| e.to_string());
    }
    read_distribution(text, &number::<Q>, range).map(Given::Drawn).map_err(|e| e.to_string())
}

/// A part of the brackets as a number in SI units; else the character where reading stopped, and why.
type Part<'a> = &'a dyn Fn(&str) -> Result<f64, (usize, String)>;

fn number<Q: Quantity>(text: &str) -> Result<f64, (usize, String)> {
    text.parse::<Q>().map(Q::si).map_err(|e: UnitError| (e.at, e.message))
}

/// Reads a distribution within a range; `part` reads one of its values into SI units, or answers with the character (from 0) at which
/// reading stopped, and why.
///
/// # Errors
/// What is wrong with the text, and where.
pub fn read_distribution(text: &str, part: Part, range: (f64, f64)) -> Result<Distribution, DistributionError> {
    let wrong = |byte: usize, problem: Problem| DistributionError {
        text: text.to_owned(),
        character: text.get(..byte).map_or(0, |t| t.chars().count()) + 1,
        problem,
    };
    let open = text.find('(').unwrap_or(text.len());
    let name = text[..open].trim();
    if !Kind::NAMES.contains(&name) {
        let near = crate::error::did_you_mean(name, Kind::NAMES);
        return Err(wrong(0, Problem::UnknownName(name.to_owned(), near)));
    }
    let inside = text.get(open + 1..).unwrap_or_default();
    let close = inside.find(')').ok_or_else(|| wrong(text.len(), Problem::Form("the bracket is not closed")))?;
    if let Some(extra) = inside[close + 1..].find(|c: char| !c.is_whitespace()) {
        return Err(wrong(open + 2 + close + extra, Problem::Form("nothing is wanted behind the bracket")));
    }
    let two = Problem::Form("two values are wanted");
    let comma = inside[..close].find(',').ok_or_else(|| wrong(open + 1 + close, two.clone()))?;
    if let Some(third) = inside[comma + 1..close].find(',') {
        return Err(wrong(open + 2 + comma + third, two));
    }
    let parts = [(&inside[..comma], open + 1), (&inside[comma + 1..close], open + 2 + comma)];
    let value = |(written, at): (&str, usize), part: Part| {
        part(written).map_err(|(character, message)| {
            let bytes: usize = written.chars().take(character).map(char::len_utf8).sum();
            wrong(at + bytes, Problem::Value(message))
        })
    };
    let a = value(parts[0], part)?;
    let b = value(parts[1], if name == "lognormal" { &number::<Number> } else { part })?;
    let made = Distribution::named(name, a, b, range);
    let made = made.map_err(|(place, problem)| wrong(begin(parts[place]), problem))?;
    Ok(Distribution { text: text.trim().to_owned(), ..made })
}

/// Where a part begins, past its spaces.
fn begin((part, at): (&str, usize)) -> usize {
    at + part.len() - part.trim_start().len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Length;

    fn length(text: &str) -> Result<Given, String> {
        read::<Length>(text, (1e-10, 10.0))
    }

    fn factor(text: &str) -> Result<Given, String> {
        read::<Number>(text, (1e-9, 1.0))
    }

    fn close(got: f64, want: f64) {
        assert!((got / want - 1.0).abs() < 1e-12, "{got} {want}");
    }

    #[test]
    fn quantiles_are_the_distributions() {
        assert_eq!(length("90um"), Ok(Given::One(90e-6)));
        let d = length("lognormal(50 um, 1.3)").expect("a distribution");
        close(d.at(0.5), 50e-6);
        close(d.at(normal_probability(1.0)), 65e-6);
        let d = length("uniform(10um, 20um)").expect("a distribution");
        close(d.at(0.25), 12.5e-6);
        let d = length("normal(50um, 5um)").expect("a distribution");
        close(d.at(normal_probability(-2.0)), 40e-6);
    }

    #[test]
    fn a_distribution_ends_where_its_flag_does() {
        // 2.275 % of it lie above 1 and are left out
        let d = factor("normal(0.8, 0.1)").expect("a distribution");
        let below = normal_probability(2.0);
        close(d.at(0.5), 0.8 + 0.1 * normal_quantile(0.5 * below));
        assert!(d.at(1.0 - 1e-12) <= 1.0 && d.at(1.0 - 1e-12) > 0.999_999);
    }

    #[test]
    fn mistakes_are_shown_at_their_character() {
        for (text, part) in [
            ("lognormal(50um, x)", "no number here (character 17)"),
            ("lognormal(50kg, 1.3)", "(character 13)"),
            ("lognromal(50um, 1.3)", "no distribution 'lognromal', did you mean lognormal? (character 1)"),
            ("lognormal(50um, 1.3", "not closed (character 20)"),
            ("lognormal(50um)", "two values are wanted (character 15)"),
            ("lognormal(50um, 1.3, 2)", "two values are wanted (character 20)"),
            ("lognormal(50um, 1.3) m", "behind the bracket (character 22)"),
            ("lognormal(50um, 0.9)", "above 1 (character 17)"),
            ("lognormal(-1um, 1.5)", "must be positive (character 11)"),
            ("normal(50um, 0um)", "must be positive (character 14)"),
            ("uniform(20um, 10um)", "does not rise (character 15)"),
            ("uniform(20um, 20m)", "must lie between 1e-10 and 10 (character 15)"),
        ] {
            let error = length(text).expect_err(text);
            assert!(error.contains(part) && error.contains(FORMS), "{error}");
        }
        assert!(factor("normal(3, 0.5)").expect_err("beyond 1").contains("most of it is out of range"));
    }
}
