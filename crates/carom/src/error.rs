//! The one error of everything that is read from text: what, where, and what would be right.

use std::fmt;
use std::ops::Range;

/// What is wrong in a law, a material or a parameter, where (bytes of the text, if it came from one), and the remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct SpecError {
    /// What is wrong, naming the value.
    pub message: String,
    /// Byte range in the text it was read from.
    pub span: Option<Range<usize>>,
    /// What would be right.
    pub help: Option<String>,
}

impl fmt::Display for SpecError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        self.help.as_ref().map_or(Ok(()), |help| write!(f, "; {help}"))
    }
}

impl SpecError {
    /// An error with no place yet.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), span: None, help: None }
    }

    /// Adds what would be right.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds the place, unless a more precise one is known.
    #[must_use]
    pub fn at(mut self, span: Option<Range<usize>>) -> Self {
        self.span = self.span.or(span);
        self
    }

    /// Line and column (both from 1) of the error in the text it came from.
    pub fn line_column(&self, text: &str) -> Option<(usize, usize)> {
        let start = self.span.as_ref()?.start.min(text.len());
        let before = text.get(..start)?;
        let column = before.rsplit('\n').next().map_or(0, |line| line.chars().count());
        Some((before.matches('\n').count() + 1, column + 1))
    }

    /// The message on one line with its place: `name:line:column: message; help`.
    pub fn located(&self, name: &str, text: &str) -> String {
        match self.line_column(text) {
            Some((line, column)) => format!("{name}:{line}:{column}: {self}"),
            None => format!("{name}: {self}"),
        }
    }

    /// As [`Self::located`], with the line itself below and a mark under the place, in plain text.
    pub fn shown(&self, name: &str, text: &str) -> String {
        let located = self.located(name, text);
        let (Some((row, column)), Some(span)) = (self.line_column(text), &self.span) else { return located };
        let line = text.lines().nth(row - 1).unwrap_or_default();
        let length = text.get(span.clone()).and_then(|s| s.lines().next()).map_or(1, |s| s.chars().count().max(1));
        // tabs stay, so that the mark stands under its place however wide they are
        let blank: String = line.chars().take(column - 1).map(|c| if c == '\t' { c } else { ' ' }).collect();
        format!("{located}\n  {row} | {line}\n  {:1$} | {blank}{2}", "", row.to_string().len(), "^".repeat(length))
    }
}

impl From<toml::de::Error> for SpecError {
    fn from(e: toml::de::Error) -> Self {
        let message = e.message().trim().replace('\n', ", ");
        Self { span: e.span(), ..unknown_key(&message).unwrap_or_else(|| Self::new(message)) }
    }
}

/// serde's "unknown field `a`, expected one of `b`, `c`", said as everything else here is.
fn unknown_key(message: &str) -> Option<SpecError> {
    let (wrong, expected) = message.strip_prefix("unknown field `")?.split_once('`')?;
    let known: Vec<&str> = expected.split('`').skip(1).step_by(2).collect();
    let near = did_you_mean(wrong, known.iter().copied()).map_or(String::new(), |n| format!("{n} "));
    Some(SpecError::new(format!("unknown key '{wrong}'")).help(format!("{near}known are {}", known.join(", "))))
}

/// The candidate nearest to what was written, if one is near: "did you mean ...?".
pub fn did_you_mean<'a>(wrong: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let lower = wrong.to_lowercase();
    candidates
        .into_iter()
        .map(|c| (strsim::damerau_levenshtein(&lower, &c.to_lowercase()), c))
        .filter(|&(distance, c)| distance <= 1 + c.len().min(lower.len()) / 4)
        .min()
        .map(|(_, c)| format!("did you mean {c}?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggestions_are_near_or_absent() {
        let names = ["copper", "nickel", "gold"];
        assert_eq!(did_you_mean("coper", names), Some("did you mean copper?".into()));
        assert_eq!(did_you_mean("Coppre", names), Some("did you mean copper?".into()));
        assert_eq!(did_you_mean("unobtainium", names), None);
    }

    #[test]
    fn unknown_keys_have_neighbours() {
        let text = "normal = \"ea\"\nfrictoin = 0.2\n";
        let error = crate::spec::parse_law(text).expect_err("a misspelt key");
        assert_eq!(error.message, "unknown key 'frictoin'");
        assert!(error.help.is_some_and(|h| h.starts_with("did you mean friction? known are sphere,")));
    }

    #[test]
    fn place_is_line_and_column() {
        let e = SpecError::new("bad").at(Some(6..9)).help("be good");
        assert_eq!(e.located("law.toml", "a = 1\nb = x\n"), "law.toml:2:1: bad; be good");
    }

    #[test]
    fn the_line_is_shown_with_its_place() {
        let text = "a = 1\n\tµ = xyz\n";
        let e = SpecError::new("bad").at(Some(12..15));
        assert_eq!(e.shown("law.toml", text), "law.toml:2:6: bad\n  2 | \tµ = xyz\n    | \t    ^^^");
        assert_eq!(SpecError::new("bad").shown("law.toml", text), "law.toml: bad");
        // a whole table is marked on its first line only, and a place at the end of the text has no line
        assert!(SpecError::new("bad").at(Some(0..15)).shown("t", text).ends_with("  1 | a = 1\n    | ^^^^^"));
        assert!(SpecError::new("bad").at(Some(16..16)).shown("t", text).ends_with("  3 | \n    | ^"));
    }
}
