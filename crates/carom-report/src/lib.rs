//! Plots and reports for carom's fronts.
//!
//! - [`plot`]: declarative plots ([`Plot`], [`HeatMap`]) drawn as SVG or PNG, with the font they
//!   need inside the crate and the same bytes for the same input.
//! - [`html`]: self-contained HTML reports of text, figures and tables.
//! - Tables and their files are those of `carom-table`, told again here.
//!
//! Values are SI everywhere; a plot's [`Axis::scaled`] shows them in another unit.
//! The font is DejaVu Sans (Bitstream Vera licence), from the `dejavu` crate.
//! Every file is written beside its target under a temporary name and renamed when it is whole,
//! so an error leaves no half-written file.
//!
//! # How do I ...
//!
//! | ... | look at |
//! |---|---|
//! | draw lines, points with error bars, bands, histograms | [`Plot`], [`Series`] |
//! | colour cells by value | [`HeatMap`] |
//! | show a body of triangles, coloured by value | [`Body`] |
//! | mark a value, or draw walls and paths to scale | [`plot::Reference`], [`Plot::wall`], [`Plot::equal_aspect`] |
//! | put figures and tables into one HTML file | [`Report`] |
//!
//! # Features
//!
//! | feature | default | what it brings |
//! |---|---|---|
//! | `png` | yes | plots as pixels (`tiny-skia`); without it `.png` is refused by name |
//! | `parquet` | yes | tables as Parquet, by `carom-table`'s feature |

mod error;
pub mod html;
pub mod plot;

pub use carom_table::file::{read_regular, write_text};
pub use carom_table::{
    Cell, Column, Field, Format, Kind, Row, RowReader, Schema, Table, TableError, TableReader, TableWriter, Values,
    significant,
};
pub use error::ReportError;
pub use html::Report;
pub use plot::{Axis, Body, Color, HeatMap, Plot, Series};
