//! Tables, plots and reports for carom's fronts.
//!
//! - [`table`]: named columns with units, written as CSV, Parquet or JSON, whole ([`Table::write`])
//!   or as a stream in flat memory ([`TableWriter`]), and as aligned text for a terminal.
//! - [`plot`]: declarative plots ([`Plot`], [`HeatMap`]) drawn as SVG or PNG, with the font they
//!   need inside the crate and the same bytes for the same input.
//! - [`html`]: self-contained HTML reports of text, figures and tables.
//!
//! Values are SI everywhere; a plot's [`Axis::scaled`] shows them in another unit.
//! The font is DejaVu Sans (Bitstream Vera licence), from the `dejavu` crate.
//! Every file is written beside its target under a temporary name and renamed when it is whole,
//! so an error leaves no half-written file.

mod error;
mod file;
pub use file::write_text;
pub mod html;
mod number;
pub use number::significant;
pub mod plot;
pub mod table;

pub use error::ReportError;
pub use html::Report;
pub use plot::{Axis, Color, HeatMap, Plot, Series};
pub use table::{Cell, Column, Field, Format, Kind, Row, RowReader, Schema, Table, TableReader, TableWriter, Values};
