//! Tables of numbers as programs and people write them: the one place that knows of separators, decimal commas, headers and units.
//!
//! Read are text tables whose first lines may be comments (`#`, `%`), `sep=;`, CFD-Post's `[Name]` and `[Data]`, or whatever else
//! comes before the line that names the columns; that line is the one whose names the caller knows. Columns are parted by commas,
//! semicolons, tabs or blanks, and a unit stands in brackets behind a name, after a solidus, or in a line of its own. Text is UTF-8,
//! UTF-16 with its mark, or Latin-1.
//!
//! The `csv` crate stands behind what carom writes; here fields keep their places in the text for messages, and blanks may part
//! them, neither of which it offers.
//!
//! ```
//! use carom_table::Sheet;
//!
//! let text = "sep=;\nSpeed [m/s];Restitution\n0,5;0,952\n";
//! let sheet = Sheet::read(text.as_bytes(), &|name| matches!(name, "speed" | "restitution"))?;
//! assert_eq!((sheet.headings()[0].name.as_str(), sheet.headings()[0].unit.as_deref()), ("speed", Some("m/s")));
//! let mut rows = sheet.rows();
//! let line = rows.next_row()?.map(|row| row.line);
//! assert_eq!((line, rows.number(0)?, rows.number(1)?), (Some(3), Some(0.5), Some(0.952)));
//! # Ok::<(), carom_table::SheetError>(())
//! ```

mod decode;
mod head;
mod heading;
mod scan;

pub use decode::text;
pub use heading::Heading;
pub use scan::Field;

use crate::text::quoted;
use head::Head;
use scan::Separator;
use std::borrow::Cow;
use std::ops::Range;

/// A table of numbers in a text: its columns, and its rows one after another.
#[derive(Debug)]
pub struct Sheet<'a> {
    text: Cow<'a, str>,
    head: Head,
}

/// What is wrong with a table, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct SheetError {
    /// The line, from 1.
    pub line: u64,
    /// The bytes of [`Sheet::text`] it is about.
    pub place: Range<usize>,
    /// What is wrong there.
    pub problem: SheetProblem,
}

/// What can be wrong with a table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SheetProblem {
    /// Not a text table, but something known.
    #[error("{0}")]
    Other(&'static str),
    /// No line of names before the numbers.
    #[error("a line that names the columns is wanted before the numbers")]
    NoNames,
    /// Nothing in it.
    #[error("nothing in it")]
    Empty,
    /// A row with more or fewer fields than there are columns.
    #[error("{found} values under {wanted} columns{}", hint(*.found, *.wanted))]
    Fields {
        /// Fields of the row.
        found: usize,
        /// Columns.
        wanted: usize,
    },
    /// A field that is not a finite number.
    #[error("column \"{column}\": {} is not a finite number", quoted(.text))]
    Number {
        /// The column's name, as written.
        column: String,
        /// The field.
        text: String,
    },
    /// Decimal commas and decimal points in one table.
    #[error("column \"{column}\": {} has a decimal {}, but line {first} has a decimal {}", quoted(.text), mark(*.comma), mark(!*.comma))]
    Mixed {
        /// The column's name, as written.
        column: String,
        /// The field.
        text: String,
        /// Whether the field has a comma.
        comma: bool,
        /// The line with the other mark.
        first: u64,
    },
    /// A comma that may part thousands as well as decimals.
    #[error(
        "column \"{column}\": the comma in {} may part thousands or decimals: write it with a decimal point",
        quoted(.text)
    )]
    Thousands {
        /// The column's name, as written.
        column: String,
        /// The field.
        text: String,
    },
    /// A quote without its end.
    #[error("a quote that does not end")]
    Quote,
    /// A second table behind the first.
    #[error("a second table begins here: one is read; export one")]
    Second,
}

fn mark(comma: bool) -> &'static str {
    if comma { "comma" } else { "point" }
}

fn hint(found: usize, wanted: usize) -> &'static str {
    if found == 2 * wanted { ": are these decimal commas? Then part the columns by semicolons" } else { "" }
}

impl<'a> Sheet<'a> {
    /// Reads the lines before the numbers. `knows` says whether it knows a column of that name, in lower case with `_` for what
    /// is neither letter nor digit.
    ///
    /// # Errors
    /// What is wrong, and where.
    pub fn read(bytes: &'a [u8], knows: &dyn Fn(&str) -> bool) -> Result<Self, SheetError> {
        let text = decode::text(bytes).map_err(|what| SheetError {
            line: 1,
            place: 0..0,
            problem: SheetProblem::Other(what),
        })?;
        let head = Head::find(&text, knows)?;
        Ok(Self { text, head })
    }

    /// The text that places are of.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The columns.
    pub fn headings(&self) -> &[Heading] {
        &self.head.headings
    }

    /// The line of the columns' names, from 1.
    pub fn line(&self) -> u64 {
        self.head.line
    }

    /// What the comments say, the line of names aside.
    pub fn comments(&self) -> impl Iterator<Item = &str> {
        let names = self.head.place.clone();
        head::lines(&self.text, 0).filter(move |l| l.0 != names.start).filter_map(|(at, line)| {
            let said = head::comment(line)?;
            (!(at >= self.head.body && self.is_row(line))).then_some(said.trim())
        })
    }

    /// What a comment such as `% Length unit: mm` says of a key, in lower case.
    pub fn remark(&self, key: &str) -> Option<&str> {
        let found = self.comments().find_map(|c| c.split_once(':').filter(|(k, _)| k.trim().eq_ignore_ascii_case(key)));
        found.map(|(_, value)| value.trim())
    }

    /// Whether a line that begins like a comment is a row that begins with a spreadsheet's error, such as `#N/A`.
    fn is_row(&self, line: &str) -> bool {
        let first = line.split([',', ';', '\t', ' ']).next().unwrap_or_default().trim_matches('"');
        let error = first.strip_prefix('#').is_some_and(|e| {
            e.starts_with(|c: char| c.is_ascii_uppercase())
                && e.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || "/!?".contains(c))
                && (e.ends_with(['!', '?']) || matches!(e, "N/A" | "NV" | "NA"))
        });
        error && scan::record(line, 0, self.head.separator).is_ok_and(|r| r.fields.len() >= self.head.headings.len())
    }

    /// The rows.
    pub fn rows(&self) -> Rows<'_> {
        Rows {
            sheet: self,
            at: self.head.body,
            line: self.head.body_line,
            row: Row::default(),
            comma: None,
            point: None,
        }
    }
}

/// A line of values.
#[derive(Debug, Default)]
pub struct Row<'a> {
    /// The line, from 1.
    pub line: u64,
    /// Its bytes in [`Sheet::text`].
    pub place: Range<usize>,
    /// One for each column.
    pub fields: Vec<Field<'a>>,
}

/// The rows of a sheet, one after another.
#[derive(Debug)]
pub struct Rows<'a> {
    sheet: &'a Sheet<'a>,
    at: usize,
    line: u64,
    row: Row<'a>,
    /// The first lines with a decimal comma, and with a point.
    comma: Option<u64>,
    point: Option<u64>,
}

impl<'a> Rows<'a> {
    /// The next row that is neither empty nor a comment.
    ///
    /// # Errors
    /// A row that does not fit the columns, with its line.
    pub fn next_row(&mut self) -> Result<Option<&Row<'a>>, SheetError> {
        let (text, head) = (self.sheet.text.as_ref(), &self.sheet.head);
        while let Some((at, line)) = head::lines(text, self.at).next() {
            let bare = line.trim();
            let number = self.line;
            let aside = bare.is_empty() || head::comment(line).is_some() && !self.sheet.is_row(bare);
            if aside {
                self.pass(at, line.len(), 1);
                continue;
            }
            let wrong = |place: Range<usize>, problem| SheetError { line: number, place, problem };
            let place = at..at + line.trim_end().len();
            if let Some(section) = head::section(bare).filter(|_| head.sections) {
                let another = matches!(section, "name" | "data");
                return if another { Err(wrong(place, SheetProblem::Second)) } else { Ok(None) };
            }
            let record = scan::record(text, at, head.separator).map_err(|p| wrong(place.clone(), p))?;
            let mut fields = record.fields;
            self.at = record.end;
            self.line += record.lines;
            if fields.iter().all(|f| f.text.is_empty()) {
                continue;
            }
            let wanted = head.headings.len();
            while fields.len() > wanted && fields.last().is_some_and(|f| f.text.is_empty()) {
                fields.pop();
            }
            if fields.len() != wanted {
                return Err(wrong(place, SheetProblem::Fields { found: fields.len(), wanted }));
            }
            self.row = Row { line: number, place, fields };
            return Ok(Some(&self.row));
        }
        Ok(None)
    }

    fn pass(&mut self, at: usize, length: usize, lines: u64) {
        self.at = scan::after(&self.sheet.text, at + length);
        self.line += lines;
    }

    /// The row read last.
    pub fn row(&self) -> &Row<'a> {
        &self.row
    }

    /// The number in a column of the row read last; none where nothing stands there.
    ///
    /// # Errors
    /// What is not a finite number, with its line.
    pub fn number(&mut self, column: usize) -> Result<Option<f64>, SheetError> {
        let Some(field) = self.row.fields.get(column) else { return Ok(None) };
        let written: &str = &field.text;
        if written.is_empty() {
            return Ok(None);
        }
        let line = self.row.line;
        let name = || self.sheet.head.headings.get(column).map_or(String::new(), |h| quoted_inside(&h.written));
        let wrong = |problem| Err(SheetError { line, place: field.place.clone(), problem });
        let comma = written.contains(',');
        if comma && self.sheet.head.separator == Separator::Comma && thousands(written) {
            return wrong(SheetProblem::Thousands { column: name(), text: written.to_owned() });
        }
        let Some(value) = number(written) else {
            return wrong(SheetProblem::Number { column: name(), text: written.to_owned() });
        };
        let (seen, other) = if comma {
            (&mut self.comma, self.point)
        } else if written.contains('.') {
            (&mut self.point, self.comma)
        } else {
            return Ok(Some(value));
        };
        seen.get_or_insert(line);
        match other {
            Some(first) => wrong(SheetProblem::Mixed { column: name(), text: written.to_owned(), comma, first }),
            None => Ok(Some(value)),
        }
    }
}

fn quoted_inside(text: &str) -> String {
    crate::text::clipped(text).into_owned()
}

/// A finite number with a decimal point or comma; Fortran's `1.0D+00` too.
fn number(text: &str) -> Option<f64> {
    let direct = text.parse::<f64>().ok();
    let value = direct.or_else(|| {
        let comma = text.bytes().filter(|b| *b == b',').count() == 1;
        let other = comma && !text.contains('.') && !text.ends_with(',');
        let fortran = text.contains(['d', 'D']) && text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
        (other || fortran).then(|| text.replace(',', ".").replace(['d', 'D'], "e").parse().ok()).flatten()
    });
    value.filter(|v| v.is_finite())
}

/// Digits in threes parted by commas, as in 1,234.
fn thousands(text: &str) -> bool {
    let mut parts = text.trim_start_matches(['+', '-']).split(',');
    let digits = |p: &str| p.bytes().all(|b| b.is_ascii_digit());
    parts.next().is_some_and(|p| (1..=3).contains(&p.len()) && digits(p) && p != "0")
        && parts.all(|p| p.len() == 3 && digits(p))
}

#[cfg(test)]
mod tests;
