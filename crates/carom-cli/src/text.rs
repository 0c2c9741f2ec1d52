//! Numbers and paragraphs as a person reads them.

use carom_report::significant;

/// A number to five significant digits.
pub fn number(value: f64) -> String {
    significant(value, 5)
}

/// A quantity with its unit.
pub fn quantity(value: f64, unit: &str) -> String {
    format!("{} {unit}", number(value))
}

/// A quantity in the prefix that leaves one to three digits before the point: 9e-5 m is 90 um.
pub fn scaled(value: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 7] =
        [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "u"), (1e-9, "n")];
    // a hair of slack, so that 1e-6 m, which may sit a bit below its prefix, is 1 um
    let fits = |factor: f64| value.abs() >= factor * (1.0 - 1e-12);
    let (factor, prefix) = PREFIXES.into_iter().find(|(f, _)| fits(*f)).unwrap_or((1.0, ""));
    format!("{} {prefix}{unit}", number(value / factor))
}

/// As [`scaled`], with the letter µ, for plots.
pub fn plotted(value: f64, unit: &str) -> String {
    scaled(value, unit).replace(&format!(" u{unit}"), &format!(" µ{unit}"))
}

/// A fraction as a percentage.
pub fn percent(fraction: f64) -> String {
    format!("{} %", significant(100.0 * fraction, 4))
}

/// Words in lines of at most `width` characters, all but the first indented.
pub fn wrapped(text: &str, width: usize, indent: usize) -> String {
    let mut out = String::new();
    let mut used = indent;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if used > indent && used + 1 + length > width {
            out.push('\n');
            out.extend(std::iter::repeat_n(' ', indent));
            used = indent;
        } else if used > indent {
            out.push(' ');
            used += 1;
        }
        out.push_str(word);
        used += length;
    }
    out
}

/// Lines of a label and a value, the values aligned.
#[derive(Default)]
pub struct Lines(Vec<(String, String)>);

impl Lines {
    /// Adds a line.
    pub fn add(&mut self, label: impl Into<String>, value: impl Into<String>) {
        self.0.push((label.into(), value.into()));
    }
}

impl std::fmt::Display for Lines {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let width = self.0.iter().map(|(label, _)| label.chars().count()).max().unwrap_or(0) + 2;
        for (label, value) in &self.0 {
            writeln!(f, "{label:width$}{}", wrapped(value, 100, width))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_take_their_prefix() {
        assert_eq!(scaled(9e-5, "m"), "90 um");
        assert_eq!(scaled(1e-6, "m"), "1 um");
        assert_eq!(scaled(0.005, "m"), "5 mm");
        assert_eq!(scaled(127.8e9, "Pa"), "127.8 GPa");
        assert_eq!(scaled(0.0, "Pa"), "0 Pa");
    }

    #[test]
    fn words_wrap_within_the_width() {
        assert_eq!(wrapped("one two three", 9, 2), "one two\n  three");
        assert_eq!(wrapped("", 9, 2), "");
    }
}
