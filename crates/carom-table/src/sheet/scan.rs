//! A record apart into its fields.

use super::SheetProblem;
use std::borrow::Cow;
use std::ops::Range;

/// What parts the columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    Tab,
    Semicolon,
    Comma,
    Blanks,
}

impl Separator {
    pub const ALL: [Self; 4] = [Self::Tab, Self::Semicolon, Self::Comma, Self::Blanks];

    fn is(self, byte: u8) -> bool {
        match self {
            Self::Tab => byte == b'\t',
            Self::Semicolon => byte == b';',
            Self::Comma => byte == b',',
            Self::Blanks => byte == b' ' || byte == b'\t',
        }
    }
}

/// A field, without the blanks and quotes around it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field<'a> {
    /// What it says.
    pub text: Cow<'a, str>,
    /// Its bytes in the text.
    pub place: Range<usize>,
}

pub(super) struct Record<'a> {
    pub fields: Vec<Field<'a>>,
    /// Where the next line begins.
    pub end: usize,
    /// Lines it takes.
    pub lines: u64,
}

/// Behind the end of a line that ends at `at`.
pub(super) fn after(text: &str, at: usize) -> usize {
    let rest = &text.as_bytes()[at.min(text.len())..];
    at + match rest {
        [b'\r', b'\n', ..] => 2,
        [b'\r' | b'\n', ..] => 1,
        _ => 0,
    }
}

fn ends(byte: u8) -> bool {
    byte == b'\n' || byte == b'\r'
}

/// The record that begins at `start`.
pub(super) fn record(text: &str, start: usize, separator: Separator) -> Result<Record<'_>, SheetProblem> {
    let bytes = text.as_bytes();
    let (mut fields, mut at, mut lines) = (Vec::new(), start, 1);
    loop {
        while at < bytes.len() && (bytes[at] == b' ' || separator == Separator::Blanks && separator.is(bytes[at])) {
            at += 1;
        }
        let over = at >= bytes.len() || ends(bytes[at]);
        if over && (separator == Separator::Blanks || fields.is_empty()) {
            break;
        }
        if bytes.get(at) == Some(&b'"') {
            let (field, end, broken) = within_quotes(text, at)?;
            lines += broken;
            fields.push(field);
            at = end;
            // what follows a quote's end belongs to no field
            while at < bytes.len() && !separator.is(bytes[at]) && !ends(bytes[at]) {
                at += 1;
            }
        } else {
            let end = bytes[at..].iter().position(|b| separator.is(*b) || ends(*b)).map_or(bytes.len(), |n| at + n);
            let trimmed = text[at..end].trim_end();
            fields.push(Field { text: Cow::Borrowed(trimmed), place: at..at + trimmed.len() });
            at = end;
        }
        match bytes.get(at) {
            Some(b) if separator.is(*b) => at += 1,
            _ => break,
        }
        // a separator at the end opens one more field, which is empty
        if separator != Separator::Blanks && bytes.get(at).is_none_or(|b| ends(*b)) {
            fields.push(Field { text: Cow::Borrowed(""), place: at..at });
            break;
        }
    }
    Ok(Record { fields, end: after(text, at), lines })
}

/// A field in quotes, where it ends, and the line breaks in it.
fn within_quotes(text: &str, open: usize) -> Result<(Field<'_>, usize, u64), SheetProblem> {
    let bytes = text.as_bytes();
    let (mut at, mut doubled) = (open + 1, false);
    loop {
        let next = bytes.get(at..).and_then(|rest| rest.iter().position(|b| *b == b'"')).ok_or(SheetProblem::Quote)?;
        at += next;
        if bytes.get(at + 1) != Some(&b'"') {
            break;
        }
        doubled = true;
        at += 2;
    }
    let inner = &text[open + 1..at];
    let said =
        if doubled { Cow::Owned(inner.replace("\"\"", "\"").trim().to_owned()) } else { Cow::Borrowed(inner.trim()) };
    let breaks = inner.bytes().filter(|b| *b == b'\n').count() as u64;
    Ok((Field { text: said, place: open + 1..at }, at + 1, breaks))
}
