//! What is drawn on a plot.

use super::Color;
use crate::ReportError;

/// How a line is broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dash {
    /// Unbroken.
    #[default]
    Solid,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
}

/// The mark at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Marker {
    /// A disc.
    #[default]
    Circle,
    /// A square.
    Square,
    /// A triangle.
    Triangle,
    /// A diagonal cross.
    Cross,
}

/// The data of a series and how they are drawn. NaN is a missing value: it breaks a line or band, and has no mark or bar.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A line through points.
    Line {
        /// Abscissas.
        x: Vec<f64>,
        /// Ordinates.
        y: Vec<f64>,
        /// How it is broken.
        dash: Dash,
    },
    /// A mark at each point, with an error bar where an interval is given.
    Points {
        /// Abscissas.
        x: Vec<f64>,
        /// Ordinates.
        y: Vec<f64>,
        /// Lower and upper ends of the vertical error bars; empty for none.
        interval: Vec<(f64, f64)>,
        /// The mark.
        marker: Marker,
    },
    /// The area between two curves.
    Band {
        /// Abscissas.
        x: Vec<f64>,
        /// Lower curve.
        low: Vec<f64>,
        /// Upper curve.
        high: Vec<f64>,
    },
    /// Bars from zero: a histogram.
    Bars {
        /// Edges of the bars, one more than there are heights.
        edges: Vec<f64>,
        /// Heights.
        heights: Vec<f64>,
    },
}

/// One entry of a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend; a series without one is not in it.
    pub label: String,
    /// Its data and look.
    pub shape: Shape,
    /// Its colour; the palette's next when absent.
    pub color: Option<Color>,
    /// Whether its line is thin, as one among many.
    pub thin: bool,
}

fn collect(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    values.into_iter().collect()
}

impl Series {
    fn new(label: impl Into<String>, shape: Shape) -> Self {
        Self { label: label.into(), shape, color: None, thin: false }
    }

    /// A line.
    pub fn line(label: impl Into<String>, x: impl IntoIterator<Item = f64>, y: impl IntoIterator<Item = f64>) -> Self {
        Self::new(label, Shape::Line { x: collect(x), y: collect(y), dash: Dash::Solid })
    }

    /// Marks at points.
    pub fn points(
        label: impl Into<String>,
        x: impl IntoIterator<Item = f64>,
        y: impl IntoIterator<Item = f64>,
    ) -> Self {
        let (x, y) = (collect(x), collect(y));
        Self::new(label, Shape::Points { x, y, interval: Vec::new(), marker: Marker::Circle })
    }

    /// The area between `low` and `high`.
    pub fn band(
        label: impl Into<String>,
        x: impl IntoIterator<Item = f64>,
        low: impl IntoIterator<Item = f64>,
        high: impl IntoIterator<Item = f64>,
    ) -> Self {
        Self::new(label, Shape::Band { x: collect(x), low: collect(low), high: collect(high) })
    }

    /// Bars of `heights` between `edges`, which are one more.
    pub fn bars(
        label: impl Into<String>,
        edges: impl IntoIterator<Item = f64>,
        heights: impl IntoIterator<Item = f64>,
    ) -> Self {
        Self::new(label, Shape::Bars { edges: collect(edges), heights: collect(heights) })
    }

    /// Gives the series a colour of its own.
    #[must_use]
    pub fn color(mut self, color: Color) -> Self {
        self.color = Some(color);
        self
    }

    /// Draws the line thin: one of many paths.
    #[must_use]
    pub fn thin(mut self) -> Self {
        self.thin = true;
        self
    }

    /// Breaks the line into dashes or dots; on any other shape nothing changes.
    #[must_use]
    pub fn dash(mut self, style: Dash) -> Self {
        if let Shape::Line { dash, .. } = &mut self.shape {
            *dash = style;
        }
        self
    }

    /// [`Series::dash`] with [`Dash::Dashed`].
    #[must_use]
    pub fn dashed(self) -> Self {
        self.dash(Dash::Dashed)
    }

    /// [`Series::dash`] with [`Dash::Dotted`].
    #[must_use]
    pub fn dotted(self) -> Self {
        self.dash(Dash::Dotted)
    }

    /// Chooses the mark; on any shape but points nothing changes.
    #[must_use]
    pub fn marker(mut self, mark: Marker) -> Self {
        if let Shape::Points { marker, .. } = &mut self.shape {
            *marker = mark;
        }
        self
    }

    /// Error bars from `low` to `high` (a 5–95 % interval); on any shape but points nothing changes.
    #[must_use]
    pub fn interval(mut self, low: impl IntoIterator<Item = f64>, high: impl IntoIterator<Item = f64>) -> Self {
        if let Shape::Points { interval, .. } = &mut self.shape {
            *interval = low.into_iter().zip(high).collect();
        }
        self
    }

    /// Error bars of ± `deviation` about the points; on any shape but points nothing changes.
    #[must_use]
    pub fn deviation(mut self, deviation: impl IntoIterator<Item = f64>) -> Self {
        if let Shape::Points { y, interval, .. } = &mut self.shape {
            *interval = y.iter().zip(deviation).map(|(y, d)| (y - d, y + d)).collect();
        }
        self
    }

    /// Whether anything of it can be seen: a value that is a number.
    pub(super) fn has_data(&self, log_x: bool, log_y: bool) -> bool {
        let here = |v: f64, log: bool| v.is_finite() && (v > 0.0 || !log);
        let both = |(x, y): (&f64, &f64)| here(*x, log_x) && here(*y, log_y);
        let any = |x: &[f64], y: &[f64]| x.iter().zip(y).any(both);
        match &self.shape {
            Shape::Line { x, y, .. } => x.windows(2).zip(y.windows(2)).any(|(x, y)| x.iter().zip(y).all(both)),
            Shape::Points { x, y, .. } => any(x, y),
            Shape::Band { x, low, high } => any(x, low) || any(x, high),
            Shape::Bars { heights, .. } => heights.iter().any(|h| h.is_finite()),
        }
    }

    /// Width of its line in CSS pixels.
    pub(super) fn line_width(&self) -> f64 {
        if self.thin { 0.9 } else { 2.0 }
    }

    /// Fails where arrays that belong together differ in length.
    pub(super) fn check(&self) -> Result<(), ReportError> {
        let (what, want, got) = match &self.shape {
            Shape::Line { x, y, .. } => ("ordinates", x.len(), y.len()),
            Shape::Points { x, y, interval, .. } if interval.is_empty() => ("ordinates", x.len(), y.len()),
            Shape::Points { x, y, interval, .. } if x.len() == y.len() => ("error bars", x.len(), interval.len()),
            Shape::Points { x, y, .. } => ("ordinates", x.len(), y.len()),
            Shape::Band { x, low, high } if x.len() == low.len() => ("upper ordinates", x.len(), high.len()),
            Shape::Band { x, low, .. } => ("lower ordinates", x.len(), low.len()),
            Shape::Bars { edges, heights } => ("heights", edges.len().saturating_sub(1), heights.len()),
        };
        if want == got {
            return Ok(());
        }
        Err(carom_table::TableError::Mismatch(format!(
            "series \"{}\": {got} {what} where {want} fit its abscissas",
            self.label
        ))
        .into())
    }
}
