//! Standard output and the files a command writes: checked before anything is computed, whole or not there at all.

use crate::failure::{Failure, of_file, say};
use carom_report::plot::ImageFormat;
use carom_report::{Format, Plot, ReportError, Table};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

/// Prints a text. A closed pipe ends the command quietly.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|e| Failure::from_output(&e))
}

/// Prints a value as JSON. NaN and infinity, which JSON lacks, are null.
pub fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|e| Failure::Other(format!("JSON: {e}")))?;
    print(&format!("{text}\n"))
}

/// Whether a file named by the user is standard output.
fn is_stdout(path: &Path) -> bool {
    path == Path::new("-") || path == Path::new("/dev/stdout")
}

/// The files a command is asked to write.
pub struct Files<'a> {
    table: Option<&'a Path>,
    plot: Option<&'a Path>,
}

impl<'a> Files<'a> {
    /// Refuses, before anything is computed, what could not be written.
    pub fn check(table: Option<&'a PathBuf>, plot: Option<&'a PathBuf>) -> Result<Self, Failure> {
        if let Some(path) = table.filter(|path| !is_stdout(path)) {
            Format::from_path(path)?;
            check_folder(path)?;
        }
        if let Some(path) = plot {
            ImageFormat::from_path(path)?;
            check_folder(path)?;
        }
        if table.is_some() && table == plot {
            return Err(Failure::input("the table and the plot go to one file; name two"));
        }
        Ok(Self { table: table.map(PathBuf::as_path), plot: plot.map(PathBuf::as_path) })
    }

    /// Is any file wanted?
    pub fn any(&self) -> bool {
        self.table.is_some() || self.plot.is_some()
    }

    /// Is the table printed as CSV?
    pub fn to_stdout(&self) -> bool {
        self.table.is_some_and(is_stdout)
    }

    /// These files beside an answer that is JSON or not: two do not go to standard output.
    pub fn beside(self, json: bool) -> Result<Self, Failure> {
        if json && self.to_stdout() {
            return Err(Failure::input("--json and --out - both go to standard output; keep one"));
        }
        Ok(self)
    }

    /// Is the table's file JSON?
    pub fn is_json(&self) -> bool {
        self.table.is_some_and(|path| Format::from_path(path).is_ok_and(|format| format == Format::Json))
    }

    /// Writes them and says so on standard error. If the second fails, the first is taken away again.
    pub fn write(
        &self,
        table: impl FnOnce() -> Result<Table, Failure>,
        plot: impl FnOnce() -> Plot,
    ) -> Result<(), Failure> {
        let plot = self.drawn(plot)?;
        self.write_drawn(table, |path| plot.map_or(Ok(()), |plot| plot.write(path)))
    }

    /// The plot, if a file for it is named; one that would be an empty frame is refused.
    pub fn drawn(&self, plot: impl FnOnce() -> Plot) -> Result<Option<Plot>, Failure> {
        let Some(path) = self.plot else { return Ok(None) };
        let plot = plot();
        if plot.is_empty() {
            return Err(Failure::input(format!(
                "{}: not written, for it would be empty: no point has a value that its axes can show. What is captured has \
                 no rebound, head-on impacts have no tangential restitution or impulse ratio (give --angle or --spin), and 0 has \
                 no place on a logarithmic axis",
                path.display()
            )));
        }
        Ok(Some(plot))
    }

    /// Likewise, with what draws the picture.
    pub fn write_drawn(
        &self,
        table: impl FnOnce() -> Result<Table, Failure>,
        draw: impl FnOnce(&Path) -> Result<(), ReportError>,
    ) -> Result<(), Failure> {
        match self.table {
            Some(path) if is_stdout(path) => print(&table()?.headed()?.to_csv()?)?,
            Some(path) if Format::from_path(path)? == Format::Csv => table()?.headed()?.write(path)?,
            Some(path) => table()?.write(path)?,
            None => {}
        }
        if let Some(path) = self.plot {
            draw(path).map_err(|e| {
                if let Some(written) = self.table.filter(|path| !is_stdout(path)) {
                    let _ = std::fs::remove_file(written);
                }
                Failure::from(e)
            })?;
        }
        for path in [self.table.filter(|path| !is_stdout(path)), self.plot].into_iter().flatten() {
            say(&format!("wrote {}", path.display()));
        }
        Ok(())
    }
}

/// Refuses a file that could not be written: a folder, or a file in none.
pub fn check_folder(path: &Path) -> Result<(), Failure> {
    if path.is_dir() {
        return Err(Failure::input(format!("{}: a folder; name a file", path.display())));
    }
    match path.parent().filter(|p| !p.as_os_str().is_empty()) {
        Some(folder) if !folder.is_dir() => {
            Err(Failure::input(format!("{}: there is no folder {}", path.display(), folder.display())))
        }
        _ => Ok(()),
    }
}

/// Writes a text, whole or not at all.
pub fn write(path: &Path, text: &str) -> Result<(), Failure> {
    Ok(carom_report::write_text(path, text)?)
}

/// Largest text file read, bytes: far beyond any law or material file.
const LARGEST: u64 = 64 << 20;

/// The text of a file named by the user.
pub fn read(path: &Path) -> Result<String, Failure> {
    String::from_utf8(bytes(path)?).map_err(|_| Failure::input(format!("{}: not a text in UTF-8", path.display())))
}

/// The text of a file of measured points, in whatever encoding a spreadsheet chose.
pub fn read_points(path: &Path) -> Result<String, Failure> {
    let text = carom_lab::points::text(&bytes(path)?);
    text.map_err(|e| Failure::input(format!("{}: {e}", path.display())))
}

fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    carom_report::read_regular(path, LARGEST).map_err(|e| of_file(&path.display().to_string(), &e))
}
