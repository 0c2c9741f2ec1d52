//! The one error of what describes a wall law: materials, keys, texts. Data first: kind, key, value, place; each front words it for its
//! own users.
//!
//! ```
//! use carom::{WallLaw, error::ErrorKind, spec::NormalKind};
//! let error = WallLaw::builder().normal(NormalKind::Tabor).yield_velocity(0.09).build().unwrap_err();
//! assert_eq!((error.kind(), error.key()), (ErrorKind::MissingKey, Some("meyer_index")));
//! assert_eq!(error.to_string(), "normal = \"tabor\" needs Meyer's index; give meyer_index = 2.29");
//! ```

mod problem;
mod wording;

use alloc::boxed::Box;
use alloc::string::String;
use alloc::string::ToString;
pub(crate) use problem::{Problem, read_with};
pub use wording::{Keys, Wording};

use crate::spec::Key;
use core::fmt;
use core::ops::Range;

/// What kind of mistake it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A text that cannot be read, or a mistake that only a reader of files can make.
    Text,
    /// A key that there is not.
    UnknownKey,
    /// A name that a key does not take: of a law, a loss, a curve.
    UnknownName,
    /// A material that the library does not have.
    UnknownMaterial,
    /// A key that the law needs.
    MissingKey,
    /// A sphere or a surface that the law needs.
    MissingMaterial,
    /// A property of a material that the law needs.
    MissingProperty,
    /// A value that cannot be, or is not plausible.
    OutOfRange,
    /// A quantity whose text cannot be read, or whose unit does not fit.
    WrongUnit,
    /// A text where a number is wanted, and the like.
    WrongType,
    /// A key that this law does not read.
    IdleKey,
    /// Keys, losses or forms that exclude each other.
    Conflict,
}

/// What is wrong in a law, a material or a parameter, where (bytes of the text, if it came from one), and the remedy.
///
/// Its `Display` speaks of keys; [`LawError::message_in`] and [`LawError::help_in`] take the words of another front.
#[derive(Clone, Debug, PartialEq)]
pub struct LawError {
    problem: Box<Problem>,
    /// What the mistake is part of, such as a material.
    within: Option<String>,
    /// The law's key that it is laid on, where that is not the problem's own.
    blamed: Option<Key>,
    /// Byte range in the text it was read from.
    pub span: Option<Range<usize>>,
}

impl From<Problem> for LawError {
    fn from(problem: Problem) -> Self {
        Self { problem: Box::new(problem), within: None, blamed: None, span: None }
    }
}

impl core::error::Error for LawError {}

impl fmt::Display for LawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message())?;
        self.remedy().map_or(Ok(()), |help| write!(f, "; {help}"))
    }
}

impl LawError {
    /// An error in a reader's own words, with no place yet.
    pub fn new(message: impl Into<String>) -> Self {
        Problem::Text { message: message.into(), help: None }.into()
    }

    /// Adds what would be right, to an error in a reader's own words.
    #[must_use]
    pub fn help(mut self, text: impl Into<String>) -> Self {
        if let Problem::Text { help, .. } = &mut *self.problem {
            *help = Some(text.into());
        }
        self
    }

    /// Adds the place, unless a more precise one is known.
    #[must_use]
    pub fn at(mut self, span: Option<Range<usize>>) -> Self {
        self.span = self.span.or(span);
        self
    }

    /// Without its place: of a value that stands alone.
    pub(crate) fn without_place(self) -> Self {
        Self { span: None, ..self }
    }

    /// Adds what the mistake is part of: `material glass`.
    #[must_use]
    pub fn within(mut self, what: impl Into<String>) -> Self {
        self.within = Some(what.into());
        self
    }

    /// Its kind.
    pub fn kind(&self) -> ErrorKind {
        self.problem.kind()
    }

    /// The key or property it is about.
    pub fn key(&self) -> Option<&str> {
        self.problem.key()
    }

    /// The value as given.
    pub fn value(&self) -> Option<&str> {
        self.problem.value()
    }

    /// The character and the reason where the text of a quantity cannot be read.
    pub fn unit_error(&self) -> Option<&crate::units::UnitError> {
        match &*self.problem {
            Problem::WrongUnit { error, .. } => Some(error),
            _ => None,
        }
    }

    /// The law's key whose value is to be marked in a text.
    pub(crate) fn blames(&self) -> Option<Key> {
        self.blamed.or_else(|| self.problem.blames())
    }

    /// Lays it on a key of the law, unless it is on one already.
    pub(crate) fn blame(mut self, key: Key) -> Self {
        self.blamed = self.blames().or(Some(key));
        self
    }

    /// What is wrong, in the words of a law's text.
    pub fn message(&self) -> String {
        self.message_in(&Keys)
    }

    /// What would be right, in the words of a law's text.
    pub fn remedy(&self) -> Option<String> {
        self.help_in(&Keys)
    }

    /// What is wrong, in the words of a front.
    pub fn message_in(&self, words: &dyn Wording) -> String {
        let message = shortened(self.problem.message(words));
        self.within.as_ref().map_or(message.clone(), |within| format!("{within}: {message}"))
    }

    /// What would be right, in the words of a front.
    pub fn help_in(&self, words: &dyn Wording) -> Option<String> {
        self.problem.help(words).map(shortened)
    }

    /// Message and remedy in a line, in the words of a front.
    pub fn said_in(&self, words: &dyn Wording) -> String {
        let message = self.message_in(words);
        self.help_in(words).map_or(message.clone(), |help| format!("{message}; {help}"))
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

#[cfg(feature = "toml")]
impl From<toml::de::Error> for LawError {
    fn from(e: toml::de::Error) -> Self {
        let message = e.message().trim().replace('\n', ", ");
        unknown_key(&message).or_else(|| plain::said(&message)).unwrap_or_else(|| Self::new(message)).at(e.span())
    }
}

#[cfg(feature = "toml")]
mod plain;

/// serde's "unknown field `a`, expected one of `b`, `c`", said as everything else here is.
#[cfg(feature = "toml")]
fn unknown_key(message: &str) -> Option<LawError> {
    let (wrong, expected) = message.strip_prefix("unknown field `")?.split_once('`')?;
    let known: Vec<&str> = expected.split('`').skip(1).step_by(2).collect();
    let near = did_you_mean(wrong, known.iter().copied()).map_or(String::new(), |n| format!("{n} "));
    Some(LawError::new(format!("unknown key '{wrong}'")).help(format!("{near}known are {}", known.join(", "))))
}

/// The candidate nearest to what was written, if one is near: "did you mean ...?".
pub fn did_you_mean<'a>(wrong: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(wrong, candidates).map(|c| format!("did you mean {c}?"))
}

/// Characters of what was written that a message repeats, where nothing parts them.
const LONG: usize = 60;
/// Characters of a message.
const LONGEST: usize = 2000;

/// A message in which what somebody wrote without end is cut.
fn shortened(message: String) -> String {
    if message.len() <= LONG {
        return message;
    }
    let mut short = String::with_capacity(message.len().min(LONGEST));
    for (i, word) in message.split(' ').enumerate() {
        if short.len() > LONGEST {
            short.push('…');
            break;
        }
        if i > 0 {
            short.push(' ');
        }
        match word.char_indices().nth(LONG) {
            // what is a little longer is left whole, such as a path
            Some((end, _)) if word.chars().nth(LONG + LONG / 2).is_some() => {
                short.push_str(&word[..end]);
                short.push('…');
                short.extend(word.chars().next_back().filter(|c| matches!(c, '\'' | '"' | ':' | ';' | ',')));
            }
            _ => short.push_str(word),
        }
    }
    short
}

/// The candidate nearest to what was written, if one is near.
#[cfg(feature = "std")]
pub(crate) fn nearest<'a>(wrong: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // what is as long as that is no slip of the pen
    if wrong.len() > 100 {
        return None;
    }
    let lower = wrong.to_lowercase();
    candidates
        .into_iter()
        .map(|c| (strsim::damerau_levenshtein(&lower, &c.to_lowercase()), c))
        .filter(|&(distance, c)| distance <= slips(c.chars().count().min(lower.chars().count())))
        .min()
        .map(|(_, c)| c)
}

/// Slips of the hand that leave a word of that length recognisable: more would make it another word.
#[cfg(feature = "std")]
fn slips(length: usize) -> usize {
    if length < 6 { 1 } else { 2 }
}

/// The candidate, if no more than so many slips lie between.
#[cfg(feature = "std")]
pub(crate) fn nearest_within<'a>(wrong: &str, candidate: &'a str, slips: usize) -> Option<&'a str> {
    (strsim::damerau_levenshtein(&wrong.to_lowercase(), &candidate.to_lowercase()) <= slips).then_some(candidate)
}

#[cfg(not(feature = "std"))]
pub(crate) fn nearest_within<'a>(_: &str, _: &'a str, _: usize) -> Option<&'a str> {
    None
}

#[cfg(not(feature = "std"))]
pub(crate) fn nearest<'a>(_: &str, _: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    None
}

#[cfg(test)]
mod tests;
