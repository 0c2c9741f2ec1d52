//! Values that are not known exactly: `lognormal(50um, 1.3)` where a flag takes `50um`.

use carom::math::normal::{normal_probability, normal_quantile};
use carom::math::{exp, ln};
use carom::units::{Number, Quantity, UnitError};

/// The value of a flag, SI units.
#[derive(Clone, Debug, PartialEq)]
pub enum Given {
    /// One value.
    One(f64),
    /// A distribution.
    Drawn(Distribution),
}

impl Given {
    /// The value, if it is one.
    pub fn one(&self) -> Option<f64> {
        match self {
            Self::One(value) => Some(*value),
            Self::Drawn(_) => None,
        }
    }

    /// The distribution, if it is one.
    pub fn distribution(&self) -> Option<&Distribution> {
        match self {
            Self::One(_) => None,
            Self::Drawn(d) => Some(d),
        }
    }

    /// The value, or the distribution's at a probability in (0, 1).
    pub fn at(&self, probability: f64) -> f64 {
        match self {
            Self::One(value) => *value,
            Self::Drawn(d) => d.quantile(probability),
        }
    }
}

/// A distribution, cut where its flag ends: what lies beyond is left out, and the rest counts as the whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// As written.
    text: String,
    kind: Kind,
    /// What the flag can be.
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

impl Kind {
    const NAMES: [&str; 3] = ["lognormal", "normal", "uniform"];

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
    /// The value below which the share `probability` in (0, 1) lies.
    pub fn quantile(&self, probability: f64) -> f64 {
        let p = self.within.0 + probability * (self.within.1 - self.within.0);
        self.kind.quantile(p.clamp(1e-300, 1.0 - 1e-16)).clamp(self.range.0, self.range.1)
    }
}

impl std::fmt::Display for Distribution {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

/// Reads one value of a quantity, or a distribution of it within a range.
pub fn read<Q: Quantity>(text: &str, range: (f64, f64)) -> Result<Given, String> {
    if !text.contains('(') {
        return text.parse::<Q>().map(|v| Given::One(v.si())).map_err(|e| e.to_string());
    }
    distribution(text, &number::<Q>, range).map(Given::Drawn)
}

/// A part of the brackets as a number in SI units; else the character where reading stopped, and why.
type Part<'a> = &'a dyn Fn(&str) -> Result<f64, (usize, String)>;

fn number<Q: Quantity>(text: &str) -> Result<f64, (usize, String)> {
    text.parse::<Q>().map(Q::si).map_err(|e: UnitError| (e.at, e.message))
}

const FORMS: &str = "lognormal(MEDIAN, GSD), normal(MEAN, DEVIATION) and uniform(FROM, TO) are known";

/// An error at a byte of the text.
fn wrong(text: &str, byte: usize, message: &str) -> String {
    let character = text.get(..byte).map_or(0, |t| t.chars().count()) + 1;
    format!("\"{text}\": {message} (character {character}); {FORMS}")
}

/// Reads a distribution within a range; `part` reads one of its values.
pub fn distribution(text: &str, part: Part, range: (f64, f64)) -> Result<Distribution, String> {
    let open = text.find('(').unwrap_or(text.len());
    let name = text[..open].trim();
    if !Kind::NAMES.contains(&name) {
        let near = carom::error::did_you_mean(name, Kind::NAMES).map_or(String::new(), |n| format!(", {n}"));
        return Err(wrong(text, 0, &format!("no distribution '{name}'{near}")));
    }
    let inside = text.get(open + 1..).unwrap_or_default();
    let close = inside.find(')').ok_or_else(|| wrong(text, text.len(), "the bracket is not closed"))?;
    if let Some(extra) = inside[close + 1..].find(|c: char| !c.is_whitespace()) {
        return Err(wrong(text, open + 2 + close + extra, "nothing is wanted behind the bracket"));
    }
    let comma = inside[..close].find(',').ok_or_else(|| wrong(text, open + 1 + close, "two values are wanted"))?;
    if let Some(second) = inside[comma + 1..close].find(',') {
        return Err(wrong(text, open + 2 + comma + second, "two values are wanted"));
    }
    let (first, second) = ((&inside[..comma], open + 1), (&inside[comma + 1..close], open + 2 + comma));
    let quantity = |(written, at): (&str, usize)| value(text, written, at, part);
    let refuse = |part: (&str, usize), message: &str| Err(wrong(text, begin(part), message));
    let a = quantity(first)?;
    let kind = match name {
        "lognormal" => {
            let gsd = value(text, second.0, second.1, &number::<Number>)?;
            if a <= 0.0 {
                return refuse(first, "the median must be positive");
            }
            if gsd <= 1.0 {
                return refuse(second, "a geometric standard deviation lies above 1");
            }
            Kind::Lognormal { median: a, ln_gsd: ln(gsd) }
        }
        "normal" => {
            let deviation = quantity(second)?;
            if deviation <= 0.0 {
                return refuse(second, "the standard deviation must be positive");
            }
            Kind::Normal { mean: a, deviation }
        }
        _ => {
            let to = quantity(second)?;
            if a >= to {
                return refuse(second, "the range does not rise");
            }
            if a < range.0 || to > range.1 {
                return refuse(if a < range.0 { first } else { second }, &format!("the value {}", must_lie(range)));
            }
            Kind::Uniform { from: a, to }
        }
    };
    let within = (kind.probability(range.0), kind.probability(range.1));
    if within.1 - within.0 < 0.5 {
        return refuse(first, &format!("most of it is out of range: the value {}", must_lie(range)));
    }
    Ok(Distribution { text: text.trim().to_owned(), kind, range, within })
}

/// Where a part begins, past its spaces.
fn begin((part, at): (&str, usize)) -> usize {
    at + part.len() - part.trim_start().len()
}

fn must_lie(range: (f64, f64)) -> String {
    if range.1 < f64::INFINITY {
        format!("must lie between {:e} and {}", range.0, range.1)
    } else {
        "must not be negative".to_owned()
    }
}

/// One part of the brackets; an error points at its character in the whole.
fn value(text: &str, written: &str, at: usize, part: Part) -> Result<f64, String> {
    part(written).map_err(|(character, message)| {
        let bytes: usize = written.chars().take(character).map(char::len_utf8).sum();
        wrong(text, at + bytes, &message)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use carom::units::Length;

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
