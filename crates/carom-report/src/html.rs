//! Self-contained HTML reports: text, figures and tables in one file that asks for nothing else.
//!
//! ```
//! use carom_report::{Axis, Column, Plot, Report, Series, Table};
//!
//! let plot = Plot::new("", Axis::new("speed", "m/s"), Axis::new("restitution", ""))
//!     .with(Series::line("", [1.0, 2.0], [0.9, 0.8]));
//! let table = Table::new([Column::float("speed", "m/s", [1.0, 2.0])])?;
//! let mut report = Report::new("Copper & glass");
//! report
//!     .section("Restitution")
//!     .paragraph("Model against measurement.")
//!     .figure(&plot.svg()?, "Restitution over speed.")
//!     .table(&table, "The speeds.");
//! assert!(report.html().contains("<h1>Copper &amp; glass</h1>"));
//! # Ok::<(), carom_report::ReportError>(())
//! ```
//!
//! No template engine: a report is a sequence of blocks that its caller chooses, so a template would hold only
//! the frame, and what an engine gives beyond that is the escaping of four characters.

use std::fmt::Write as _;
use std::path::Path;

use crate::ReportError;
use carom_table::{Table, TableError, Values, column_cells, file};

const STYLE: &str = include_str!("html/style.css");

/// An HTML report under construction; blocks appear in the order in which they are added.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    title: String,
    body: String,
}

impl Report {
    /// A report with a title and nothing else yet.
    pub fn new(title: impl Into<String>) -> Self {
        Self { title: title.into(), body: String::new() }
    }

    fn block(&mut self, tag: &str, text: &str) -> &mut Self {
        let _ = writeln!(self.body, "<{tag}>{}</{tag}>", escape(text));
        self
    }

    /// Starts a section.
    pub fn section(&mut self, heading: &str) -> &mut Self {
        self.block("h2", heading)
    }

    /// Starts a section within a section.
    pub fn subsection(&mut self, heading: &str) -> &mut Self {
        self.block("h3", heading)
    }

    /// A paragraph of plain text.
    pub fn paragraph(&mut self, text: &str) -> &mut Self {
        self.block("p", text)
    }

    /// A small line of how and when the report was made, in plain text.
    pub fn made(&mut self, text: &str) -> &mut Self {
        let _ = writeln!(self.body, "<p class=\"made\">{}</p>", escape(text));
        self
    }

    /// Text shown as it is, in a fixed-width font: a law or case file.
    pub fn preformatted(&mut self, text: &str) -> &mut Self {
        self.block("pre", text)
    }

    /// A bulleted list of plain texts.
    pub fn list<T: AsRef<str>>(&mut self, items: impl IntoIterator<Item = T>) -> &mut Self {
        self.body.push_str("<ul>\n");
        for item in items {
            self.block("li", item.as_ref());
        }
        self.body.push_str("</ul>\n");
        self
    }

    /// A figure: an SVG document as made by [`Plot::svg`](crate::Plot::svg) or
    /// [`HeatMap::svg`](crate::HeatMap::svg), put in as it is, and its caption.
    pub fn figure(&mut self, svg: &str, caption: &str) -> &mut Self {
        let caption = escape(caption);
        let _ = writeln!(
            self.body,
            "<figure>\n<div class=\"plot\" role=\"img\" aria-label=\"{caption}\">\n{svg}</div>\n\
             <figcaption>{caption}</figcaption>\n</figure>"
        );
        self
    }

    /// A table with all its rows, headings with units, numbers to six digits.
    pub fn table(&mut self, table: &Table, caption: &str) -> &mut Self {
        let cells: Vec<_> = table.columns().iter().map(column_cells).collect();
        let _ = writeln!(self.body, "<div class=\"wide\"><table>\n<caption>{}</caption>\n<thead>", escape(caption));
        for row in 0..=table.rows() {
            self.body.push_str("<tr>");
            for (column, cells) in table.columns().iter().zip(&cells) {
                let tag = if row == 0 { "th" } else { "td" };
                let class = if matches!(column.values, Values::Text(_)) { " class=\"text\"" } else { "" };
                let _ = write!(self.body, "<{tag}{class}>{}</{tag}>", escape(&cells[row]));
            }
            self.body.push_str(if row == 0 { "</tr></thead>\n<tbody>\n" } else { "</tr>\n" });
        }
        self.body.push_str("</tbody>\n</table></div>\n");
        self
    }

    /// Shares of a whole as bars: what, its share of one, and the amount as text.
    pub fn shares<'a>(&mut self, rows: impl IntoIterator<Item = (&'a str, f64, String)>, caption: &str) -> &mut Self {
        let _ = writeln!(self.body, "<table class=\"shares\">\n<caption>{}</caption>\n<tbody>", escape(caption));
        for (what, share, amount) in rows {
            let percent = 100.0 * share.clamp(0.0, 1.0);
            let _ = writeln!(
                self.body,
                "<tr><td class=\"text\">{}</td><td class=\"bar\"><div style=\"width:{percent:.2}%\"></div></td>\
                 <td>{percent:.2} %</td><td>{}</td></tr>",
                escape(what),
                escape(&amount)
            );
        }
        self.body.push_str("</tbody>\n</table>\n");
        self
    }

    /// The whole document.
    #[must_use]
    pub fn html(&self) -> String {
        let title = escape(&self.title);
        format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n{}</body>\n</html>\n",
            self.body
        )
    }

    /// Writes the document to `path`, which ends in `.html`.
    ///
    /// # Errors
    /// [`TableError::UnknownExtension`], or what the file system says.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), ReportError> {
        let path = path.as_ref();
        if file::extension(path) != "html" {
            return Err(TableError::UnknownExtension { path: path.to_path_buf(), known: ".html" }.into());
        }
        Ok(file::write_whole(path, self.html().as_bytes())?)
    }
}

/// Text made safe for HTML content and quoted attributes.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            _ => out.push(c),
        }
    }
    out
}
