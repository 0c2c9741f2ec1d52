//! Plots: say what is to be seen, get SVG or PNG.
//!
//! ```
//! use carom_report::plot::{Axis, Plot, Reference, Series};
//!
//! let speed = [0.1, 0.3, 1.0, 3.0, 10.0];
//! let restitution = [f64::NAN, 0.78, 0.94, 0.97, 0.93]; // NaN: no rebound, the line has a gap
//! let svg = Plot::new("Copper on glass", Axis::new("speed", "m/s").log(), Axis::new("restitution", "").range(0.0, 1.0))
//!     .with(Series::line("model", speed, restitution))
//!     .with(Series::points("measured", [0.3, 3.0], [0.80, 0.96]).deviation([0.05, 0.02]))
//!     .with(Series::band("5–95 %", speed, [0.0, 0.7, 0.9, 0.95, 0.9], [0.0, 0.85, 0.96, 0.99, 0.96]))
//!     .reference(Reference::vertical(0.18, "capture velocity"))
//!     .svg()?;
//! assert!(svg.contains("speed (m/s)"));
//! # Ok::<(), carom_report::ReportError>(())
//! ```
//!
//! A plot is laid out once, with the widths of DejaVu Sans from inside the crate, and written as SVG or, with feature `png`, as pixels
//! with letters of that font, so neither depends on what fonts a machine has. The same plot gives the same bytes.

use std::path::Path;

use crate::ReportError;
use canvas::Canvas;
use carom_table::{TableError, file};

mod apart;
mod axis;
mod body;
mod canvas;
mod clip;
mod color;
mod draw;
mod font;
mod frame;
mod heat_map;
mod legend;
mod occupied;
#[cfg(feature = "png")]
mod png;
mod reference;
mod scaled;
mod series;
mod svg;
mod ticks;

pub use axis::{Axis, Scale};
pub use body::{Body, Triangle};
pub use color::{Color, ColorMap};
pub use heat_map::HeatMap;
pub use reference::Reference;
pub use series::{Dash, Marker, Series, Shape};

/// Width and height of a plot where nothing else is said, in CSS pixels.
pub const SIZE: (u32, u32) = (900, 560);

/// Where the legend goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Legend {
    /// A corner free of data, else outside at the right.
    #[default]
    Auto,
    /// Inside, upper left.
    UpperLeft,
    /// Inside, upper right.
    UpperRight,
    /// Inside, lower left.
    LowerLeft,
    /// Inside, lower right.
    LowerRight,
    /// Outside, at the right.
    Outside,
    /// No legend.
    Hidden,
}

/// A plot of series over two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Title above the plot; may be empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What is drawn, the first lowest.
    pub series: Vec<Series>,
    /// Lines at values that matter.
    pub references: Vec<Reference>,
    /// Wall lines, each from one point to another, drawn thick.
    pub walls: Vec<[[f64; 2]; 2]>,
    /// Where the legend goes.
    pub legend: Legend,
    /// Whether a length is as long on screen along x as along y (trajectories).
    pub equal_aspect: bool,
    /// Width and height in CSS pixels.
    pub size: (u32, u32),
}

impl Plot {
    /// An empty plot.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            series: Vec::new(),
            references: Vec::new(),
            walls: Vec::new(),
            legend: Legend::Auto,
            equal_aspect: false,
            size: SIZE,
        }
    }

    /// Adds a series.
    #[must_use]
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds a reference line.
    #[must_use]
    pub fn reference(mut self, reference: Reference) -> Self {
        self.references.push(reference);
        self
    }

    /// Adds a wall line.
    #[must_use]
    pub fn wall(mut self, from: [f64; 2], to: [f64; 2]) -> Self {
        self.walls.push([from, to]);
        self
    }

    /// Places the legend.
    #[must_use]
    pub fn legend(mut self, legend: Legend) -> Self {
        self.legend = legend;
        self
    }

    /// Draws a length as long along x as along y. Takes effect where both axes are linear.
    #[must_use]
    pub fn equal_aspect(mut self) -> Self {
        self.equal_aspect = true;
        self
    }

    /// Whether no series has a value that can be drawn: only a frame would be seen.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        let [x, y] = [&self.x, &self.y].map(|axis| axis.scale == Scale::Log);
        !self.series.iter().any(|series| series.has_data(x, y))
    }

    /// The plot as an SVG document.
    ///
    /// # Errors
    /// [`TableError::Mismatch`] where a series' arrays differ in length.
    pub fn svg(&self) -> Result<String, ReportError> {
        Ok(svg::document(&draw::plot(self)?))
    }

    /// The plot as PNG bytes, two pixels for each CSS pixel.
    ///
    /// # Errors
    /// As for [`Plot::svg`].
    #[cfg(feature = "png")]
    pub fn png(&self) -> Result<Vec<u8>, ReportError> {
        png::encode(&draw::plot(self)?)
    }

    /// Writes the plot to `path` as SVG or PNG, told by its extension.
    ///
    /// # Errors
    /// [`TableError::UnknownExtension`], what the file system says, or as for [`Plot::svg`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), ReportError> {
        let path = path.as_ref();
        let format = ImageFormat::from_path(path)?;
        write_image(path, format, &draw::plot(self)?)
    }
}

/// An image format for plots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageFormat {
    /// Vector, with text as text.
    Svg,
    /// Pixels, two for each CSS pixel.
    Png,
}

impl ImageFormat {
    /// The format told by a path's extension: `.svg` or `.png`; lets a command refuse a path before it computes.
    ///
    /// # Errors
    /// [`TableError::UnknownExtension`], naming the known ones; [`TableError::Feature`] where this build writes no PNG.
    pub fn from_path(path: impl AsRef<Path>) -> Result<Self, ReportError> {
        let given = || path.as_ref().to_path_buf();
        match file::extension(path.as_ref()).as_str() {
            "svg" => Ok(Self::Svg),
            "png" if cfg!(feature = "png") => Ok(Self::Png),
            "png" => Err(TableError::Feature { path: given(), format: "PNG", feature: "png" }.into()),
            _ => Err(TableError::UnknownExtension { path: given(), known: ".svg and .png" }.into()),
        }
    }
}

fn write_image(path: &Path, format: ImageFormat, canvas: &Canvas) -> Result<(), ReportError> {
    match format {
        ImageFormat::Svg => Ok(file::write_whole(path, svg::document(canvas).as_bytes())?),
        #[cfg(feature = "png")]
        ImageFormat::Png => Ok(file::write_whole(path, &png::encode(canvas)?)?),
        #[cfg(not(feature = "png"))]
        ImageFormat::Png => Err(TableError::Feature { path: path.to_path_buf(), format: "PNG", feature: "png" }.into()),
    }
}
