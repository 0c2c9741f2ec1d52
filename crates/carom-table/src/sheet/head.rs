//! The line that names the columns, and what stands before it.

use super::heading::{Heading, is_unit, unit};
use super::scan::{Separator, after, record};
use super::{SheetError, SheetProblem, number};
use std::ops::Range;

/// What is known of a table once its columns are.
#[derive(Debug)]
pub(super) struct Head {
    pub separator: Separator,
    pub headings: Vec<Heading>,
    /// The line of names, from 1, and its bytes.
    pub line: u64,
    pub place: Range<usize>,
    /// Where rows begin, and in which line.
    pub body: usize,
    pub body_line: u64,
    /// Whether the table is a section, as CFD-Post writes them.
    pub sections: bool,
}

/// Lines that may come before the numbers.
const MOST: usize = 2000;

/// The lines from a place on, each with its place.
pub(super) fn lines(text: &str, from: usize) -> impl Iterator<Item = (usize, &str)> {
    let mut at = from;
    std::iter::from_fn(move || {
        let rest = text.get(at..).filter(|r| !r.is_empty())?;
        let end = rest.find(['\n', '\r']).unwrap_or(rest.len());
        let start = at;
        at = after(text, start + end);
        Some((start, &rest[..end]))
    })
}

/// What a comment says.
pub(super) fn comment(line: &str) -> Option<&str> {
    let bare = line.trim_start();
    let bare = bare.strip_prefix('"').unwrap_or(bare);
    bare.strip_prefix(['#', '%']).or_else(|| bare.strip_prefix("//")).map(|said| said.trim_start_matches(['#', '%']))
}

/// The name of a section, in lower case: `[Data]`.
pub(super) fn section(line: &str) -> Option<&'static str> {
    const SECTIONS: [&str; 6] = ["name", "data", "faces", "lines", "spatial fields", "parameters"];
    let inside = line.trim().trim_end_matches([',', ';']).strip_prefix('[')?.strip_suffix(']')?.trim();
    SECTIONS.into_iter().find(|s| s.eq_ignore_ascii_case(inside))
}

/// A line that may hold the names.
struct Candidate {
    at: usize,
    line: u64,
    /// What may be names: a comment's mark is left out.
    from: usize,
    end: usize,
}

impl Head {
    pub fn find(text: &str, knows: &dyn Fn(&str) -> bool) -> Result<Self, SheetError> {
        let (mut candidates, mut given, mut sections, mut named) = (Vec::new(), None, false, false);
        let mut first_row = None;
        let mut met = false;
        for (index, (at, line)) in lines(text, 0).take(MOST).enumerate() {
            let number = index as u64 + 1;
            let bare = line.trim();
            if std::mem::take(&mut named) || bare.is_empty() {
                named = bare.is_empty() && named;
                continue;
            }
            if let Some(separator) = announced(bare) {
                given = Some(separator);
                continue;
            }
            if let Some(section) = section(bare) {
                (sections, named) = (true, section == "name");
                candidates.clear();
                continue;
            }
            let said = comment(line);
            if said.is_none() && is_row(line, given) {
                // numbers before any name that is known are not yet the table's
                if met || first_row.is_none() {
                    first_row = Some((at, number));
                }
                if met {
                    break;
                }
                continue;
            }
            let (from, end) = match said {
                Some(said) => (at + line.len() - said.len(), at + line.trim_end().len()),
                None => (at, at + line.trim_end().len()),
            };
            met |= Separator::ALL
                .into_iter()
                .any(|s| headings(&text[..end], from, s).is_ok_and(|names| names.iter().any(|h| knows(&h.name))));
            candidates.push(Candidate { at, line: number, from, end });
        }
        let row = first_row.map(|(at, _)| at);
        let Some((best, separator)) = choose(text, &candidates, row, given, knows) else {
            let (line, problem) = first_row.map_or((1, SheetProblem::Empty), |(_, line)| (line, SheetProblem::NoNames));
            let at = row.unwrap_or(0);
            return Err(SheetError { line, place: at..at, problem });
        };
        let found = record(text, best.from, separator).map_err(|problem| SheetError {
            line: best.line,
            place: best.at..best.end,
            problem,
        })?;
        let mut headings = headings(&text[..best.end], best.from, separator)?;
        let (mut body, mut body_line) = (found.end, best.line + found.lines);
        if let Some((units, at, line)) = line_of_units(text, body, body_line, separator, headings.len()) {
            for (heading, unit) in headings.iter_mut().zip(units) {
                heading.unit = heading.unit.take().or(unit);
            }
            (body, body_line) = (at, line);
        }
        Ok(Self { separator, headings, line: best.line, place: best.at..best.end, body, body_line, sections })
    }
}

/// `sep=;`
fn announced(line: &str) -> Option<Separator> {
    let line = line.trim_matches('"');
    let mark = line.get(..4).filter(|m| m.eq_ignore_ascii_case("sep="))?;
    match line[mark.len()..].trim_matches('"').chars().next() {
        Some(';') => Some(Separator::Semicolon),
        Some(',') => Some(Separator::Comma),
        Some('\t') | None => Some(Separator::Tab),
        Some(' ') => Some(Separator::Blanks),
        Some(_) => None,
    }
}

/// Whether a line is one of values: at least half of its fields are numbers.
fn is_row(line: &str, given: Option<Separator>) -> bool {
    let separators = given.map_or(Separator::ALL.to_vec(), |s| vec![s]);
    separators.into_iter().any(|s| {
        let Ok(record) = record(line, 0, s) else { return false };
        let filled = record.fields.iter().filter(|f| !f.text.is_empty());
        let (count, numbers) = filled.fold((0, 0), |(n, m), f| (n + 1, m + usize::from(number(&f.text).is_some())));
        numbers > 0 && 2 * numbers >= count
    })
}

/// The columns of a line; nameless ones at its end are left out.
fn headings(text: &str, from: usize, separator: Separator) -> Result<Vec<Heading>, SheetError> {
    let record =
        record(text, from, separator).map_err(|problem| SheetError { line: 1, place: from..text.len(), problem })?;
    let mut headings: Vec<Heading> = Vec::with_capacity(record.fields.len());
    let mut open: Option<usize> = None;
    for field in record.fields {
        let begins = field.text.starts_with(['(', '[']);
        // between blanks, a unit in brackets is not a column of its own
        let first = if separator == Separator::Blanks && (begins || open.is_some()) {
            open.take().or_else(|| headings.len().checked_sub(1))
        } else {
            None
        };
        if let Some(last) = first.and_then(|i| headings.get_mut(i)) {
            let place = last.place.start..field.place.end;
            *last = Heading::new(text.get(place.clone()).unwrap_or_default(), place);
            open = (!field.text.ends_with([')', ']'])).then(|| headings.len() - 1);
        } else {
            headings.push(Heading::new(&field.text, field.place));
        }
    }
    while headings.last().is_some_and(|h| h.written.is_empty()) {
        headings.pop();
    }
    Ok(headings)
}

/// The line and separator with most names that are known; without any, the line before the numbers.
fn choose<'c>(
    text: &str,
    candidates: &'c [Candidate],
    row: Option<usize>,
    given: Option<Separator>,
    knows: &dyn Fn(&str) -> bool,
) -> Option<(&'c Candidate, Separator)> {
    let mut best: Option<((usize, bool, usize), &Candidate, Separator)> = None;
    for candidate in candidates {
        for separator in Separator::ALL.into_iter().filter(|s| given.is_none_or(|g| g == *s)) {
            let Ok(headings) = headings(&text[..candidate.end], candidate.from, separator) else { continue };
            let known = headings.iter().filter(|h| knows(&h.name)).count();
            let fields = row.and_then(|at| record(text, at, separator).ok()).map_or(0, |r| r.fields.len());
            let fits = fields == headings.len();
            let score = (known, fits, if fits { fields } else { 0 });
            // of lines that are as good, the later
            if best.as_ref().is_none_or(|(s, line, _)| score > *s || score == *s && line.line < candidate.line) {
                best = Some((score, candidate, separator));
            }
        }
    }
    best.map(|(_, candidate, separator)| (candidate, separator))
}

/// A line of units below the names, and where it ends.
type Units = (Vec<Option<String>>, usize, u64);

fn line_of_units(text: &str, body: usize, body_line: u64, separator: Separator, columns: usize) -> Option<Units> {
    let (number, (at, line)) = (body_line..).zip(lines(text, body)).find(|(_, (_, line))| !line.trim().is_empty())?;
    let from = at + line.len() - comment(line).map_or(line.len(), str::len);
    let record = record(text, from, separator).ok()?;
    let fields: Vec<&str> = record.fields.iter().map(|f| f.text.as_ref()).collect();
    let blank = |f: &str| matches!(f, "" | "-" | "–" | "[-]" | "(-)" | "[ ]" | "1");
    let fits =
        fields.len() >= columns && fields.iter().all(|f| blank(f) || is_unit(f)) && fields.iter().any(|f| is_unit(f));
    fits.then(|| (fields.into_iter().map(unit).collect(), record.end, number + record.lines))
}
