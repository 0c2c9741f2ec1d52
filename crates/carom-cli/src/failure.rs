//! What can go wrong, how it is shown, and the exit code: 2 for the user's input, 1 for anything else.

use crate::law::Words;
use carom::LawError;
use carom::error::{Keys, Wording};
use carom_lab::LabError;
use carom_report::{ReportError, TableError};
use clap::error::ErrorKind;
use miette::{LabeledSpan, MietteDiagnostic, NamedSource};
use std::io::{self, Write as _};
use std::process::ExitCode;

/// Why the command stops.
#[derive(Debug)]
pub enum Failure {
    /// The user's input is wrong: what, where, what would be right.
    Input(String),
    /// The same in a file, with the place.
    InFile(Box<miette::Report>),
    /// Anything else.
    Other(String),
    /// Nobody reads the output any more (`carom sweep ... | head`): not an error.
    BrokenPipe,
}

impl Failure {
    /// The user's mistake, in a line.
    pub fn input(message: impl Into<String>) -> Self {
        Self::Input(message.into())
    }

    /// A mistake in the text of a file; without a place it is shown in a line.
    pub fn in_file(error: LawError, name: &str, text: &str) -> Self {
        let Some(span) = error.span.clone() else { return Self::Input(format!("{name}: {error}")) };
        if !can_be_shown(&span, text) {
            return Self::Input(error.located(name, text));
        }
        let mut diagnostic =
            MietteDiagnostic::new(error.message()).with_label(LabeledSpan::underline(first_line(span, text)));
        if let Some(help) = error.help_in(&InFile) {
            diagnostic = diagnostic.with_help(help);
        }
        let source = NamedSource::new(name, text.to_owned());
        Self::InFile(Box::new(miette::Report::new(diagnostic).with_source_code(source)))
    }

    /// Shows it on standard error and gives the exit code.
    pub fn report(self) -> ExitCode {
        match self {
            Self::Input(message) => {
                show(&message);
                ExitCode::from(2)
            }
            Self::InFile(report) => {
                say(&format!("{report:?}"));
                ExitCode::from(2)
            }
            Self::Other(message) => {
                show(&message);
                ExitCode::FAILURE
            }
            Self::BrokenPipe => ExitCode::SUCCESS,
        }
    }
}

/// Whether the lines about a place are short enough to be shown.
fn can_be_shown(span: &std::ops::Range<usize>, text: &str) -> bool {
    const MOST: usize = 500;
    let at = span.start.min(text.len());
    let before = text.as_bytes()[..at].iter().rev().scan(0, |lines, b| {
        *lines += usize::from(*b == b'\n');
        (*lines < 2).then_some(())
    });
    let after = text.as_bytes()[at..].iter().scan(0, |lines, b| {
        *lines += usize::from(*b == b'\n');
        (*lines < 2).then_some(())
    });
    before.take(MOST + 1).count() + after.take(MOST + 1).count() <= MOST
}

/// The words of a file's keys, on a command line that can list materials.
struct InFile;

impl Wording for InFile {
    fn key(&self, key: &str) -> String {
        Keys.key(key)
    }
    fn value(&self, value: &str) -> String {
        Keys.value(value)
    }
    fn setting(&self, key: &str, value: &str) -> String {
        Keys.setting(key, value)
    }
    fn loss(&self, name: &str) -> String {
        Keys.loss(name)
    }
    fn materials(&self) -> Option<String> {
        Words.materials()
    }
}

/// A line on standard error, its first word coloured where that is a terminal; when it is closed too, nothing is left to do.
pub fn say(line: &str) {
    use clap::builder::styling::{AnsiColor, Style};
    let color = |color: AnsiColor| Style::new().bold().fg_color(Some(color.into()));
    let marked = [("note:", color(AnsiColor::Cyan)), ("wrote", color(AnsiColor::Green))];
    let mut to = anstream::stderr();
    let _ = match marked.into_iter().find_map(|(word, style)| Some((word, style, line.strip_prefix(word)?))) {
        Some((word, style, rest)) => writeln!(to, "{style}{word}{style:#}{rest}"),
        None => writeln!(to, "{line}"),
    };
}

/// Through clap, so that all errors in a line look alike and know whether the terminal takes colours.
fn show(message: &str) {
    let _ = clap::Error::raw(ErrorKind::ValueValidation, format!("{message}\n")).print();
}

/// A span that runs over several lines is cut to its first: a place is wanted, not the whole table.
fn first_line(span: std::ops::Range<usize>, text: &str) -> std::ops::Range<usize> {
    let start = span.start.min(text.len());
    let end = span.end.clamp(start, text.len());
    let line = text.get(start..end).and_then(|s| s.find('\n')).map_or(end, |n| start + n);
    start..line
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Table(error) => error.into(),
            other => Self::Other(other.to_string()),
        }
    }
}

impl From<TableError> for Failure {
    fn from(error: TableError) -> Self {
        match &error {
            TableError::UnknownExtension { .. } | TableError::Feature { .. } => Self::Input(error.to_string()),
            TableError::File { path, source } => of_file(&path.display().to_string(), source),
            TableError::Stream(source) => Self::from_output(source),
            _ => Self::Other(error.to_string()),
        }
    }
}

impl From<LabError> for Failure {
    fn from(error: LabError) -> Self {
        match error {
            LabError::Experiment { name, text, error } => Self::in_file(error, &name, &text),
            LabError::Data { name, text, error } => Self::in_file(*error, &name, &text),
            LabError::File { path, source } => of_file(&path.display().to_string(), &source),
            LabError::Report(error) => error.into(),
            LabError::Table(error) => error.into(),
            LabError::Points(message) => Self::Input(message),
            LabError::Fit(error) => Self::Input(error.to_string()),
            other => Self::Other(other.to_string()),
        }
    }
}

impl Failure {
    /// Writing to standard output failed.
    pub fn from_output(error: &io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            Self::BrokenPipe
        } else {
            Self::Other(format!("standard output: {error}"))
        }
    }
}

/// A file that cannot be read or written: the user's mistake where another path would do.
pub fn of_file(name: &str, error: &io::Error) -> Failure {
    use io::ErrorKind as K;
    let text = error.to_string();
    // the number says nothing to the reader
    let message = format!("{name}: {}", text.split(" (os error").next().unwrap_or(&text));
    match error.kind() {
        K::NotFound
        | K::PermissionDenied
        | K::NotADirectory
        | K::IsADirectory
        | K::InvalidData
        | K::InvalidInput
        | K::InvalidFilename
        | K::ReadOnlyFilesystem => Failure::Input(message),
        _ => Failure::Other(message),
    }
}
