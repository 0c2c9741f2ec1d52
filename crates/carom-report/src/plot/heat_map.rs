//! Heat maps: a value over two axes.

use std::path::Path;

use super::canvas::{Anchor, Canvas, Label, Stroke};
use super::font;
use super::frame::{Frame, LABEL, TICK, vertical_ticks, widest};
#[cfg(feature = "png")]
use super::png;
use super::scaled::{Margin, Scaled};
use super::ticks::Tick;
use super::{Axis, Color, ColorMap, ImageFormat, SIZE, svg, write_image};
use crate::ReportError;

/// Colour of a cell without a value.
pub(super) const MISSING: Color = Color(225, 225, 225);
pub(super) const BAR_WIDTH: f64 = 20.0;

/// A map of a value over cells between edges, with a colour bar.
///
/// ```
/// use carom_report::{Axis, HeatMap};
///
/// let map = HeatMap::new("Deposit", Axis::new("x", "m"), Axis::new("z", "m"), Axis::scaled("mass", "mg", 1e6))
///     .cells([0.0, 0.1, 0.2], [0.0, 0.05, 0.1], [1e-6, 2e-6, f64::NAN, 4e-6]); // rows of x, one for each z
/// assert!(map.svg()?.contains("mass (mg)"));
/// # Ok::<(), carom_report::ReportError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct HeatMap {
    /// Title above the map; may be empty.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// The value: its name, unit, scale and range, shown beside the colour bar.
    pub value: Axis,
    /// Edges of the cells along x.
    pub x_edges: Vec<f64>,
    /// Edges of the cells along y.
    pub y_edges: Vec<f64>,
    /// Values row after row, x running fastest; NaN is a cell without value (grey).
    pub values: Vec<f64>,
    /// Colours.
    pub colors: ColorMap,
    /// Names of the values 0, 1, 2, ...: a legend stands beside the map in place of the colour bar.
    pub classes: Vec<String>,
    /// Width and height in CSS pixels.
    pub size: (u32, u32),
}

impl HeatMap {
    /// A map without cells.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis, value: Axis) -> Self {
        let none = Vec::new;
        let title = title.into();
        Self {
            title,
            x,
            y,
            value,
            x_edges: none(),
            y_edges: none(),
            values: none(),
            colors: ColorMap::Viridis,
            classes: Vec::new(),
            size: SIZE,
        }
    }

    /// Sets the cells: edges along both axes and the values, row after row with x running fastest.
    #[must_use]
    pub fn cells(
        mut self,
        x_edges: impl IntoIterator<Item = f64>,
        y_edges: impl IntoIterator<Item = f64>,
        values: impl IntoIterator<Item = f64>,
    ) -> Self {
        self.x_edges = x_edges.into_iter().collect();
        self.y_edges = y_edges.into_iter().collect();
        self.values = values.into_iter().collect();
        self
    }

    /// Chooses the colours.
    #[must_use]
    pub fn colors(mut self, colors: ColorMap) -> Self {
        self.colors = colors;
        self
    }

    /// Names the values 0, 1, 2, ... of a map of kinds instead of amounts.
    #[must_use]
    pub fn classes<T: Into<String>>(mut self, names: impl IntoIterator<Item = T>) -> Self {
        self.classes = names.into_iter().map(Into::into).collect();
        self.value = self.value.range(0.0, self.classes.len().saturating_sub(1).max(1) as f64);
        self
    }

    /// The map as an SVG document.
    ///
    /// # Errors
    /// [`TableError::Mismatch`](carom_table::TableError::Mismatch) where the number of values does not fit the edges.
    pub fn svg(&self) -> Result<String, ReportError> {
        Ok(svg::document(&self.drawn()?))
    }

    fn drawn(&self) -> Result<Canvas, ReportError> {
        let (columns, rows) = (self.x_edges.len().saturating_sub(1), self.y_edges.len().saturating_sub(1));
        if self.values.len() != columns * rows {
            let got = self.values.len();
            return Err(carom_table::TableError::Mismatch(format!(
                "heat map \"{}\": {got} values for {columns} × {rows} cells",
                self.title
            ))
            .into());
        }
        let margin = if self.colors == ColorMap::Diverging { Margin::Symmetric } else { Margin::None };
        let value = Scaled::new(&self.value, self.values.iter().copied(), margin);
        let x = Scaled::new(&self.x, self.x_edges.iter().copied(), Margin::None);
        let y = Scaled::new(&self.y, self.y_edges.iter().copied(), Margin::None);
        let ticks = vertical_ticks(&value, f64::from(self.size.1) - 110.0);
        let names = self.classes.iter().map(|name| font::width(name, TICK)).fold(0.0, f64::max);
        let beside = 18.0
            + BAR_WIDTH
            + 9.0
            + match (self.classes.is_empty(), self.value.heading().is_empty()) {
                (false, _) => names + 14.0,
                (true, true) => widest(&ticks) + 14.0,
                (true, false) => widest(&ticks) + 38.0,
            };
        let frame = Frame::new(&self.title, (&self.x, &self.y), (x, y), self.size, beside);
        let mut canvas = Canvas::new(frame.size);
        self.draw_cells(&mut canvas, &frame, &value);
        if self.classes.is_empty() {
            self.draw_bar(&mut canvas, &frame, &ticks);
        } else {
            self.draw_legend(&mut canvas, &frame, &value);
        }
        frame.axes(&mut canvas, &self.title, &self.x, &self.y);
        Ok(canvas)
    }

    fn draw_cells(&self, canvas: &mut Canvas, frame: &Frame, value: &Scaled) {
        let columns = self.x_edges.len().saturating_sub(1);
        for (row, y) in self.y_edges.windows(2).enumerate() {
            for (column, x) in self.x_edges.windows(2).enumerate() {
                let (Some(from), Some(to)) = (frame.point(x[0], y[0]), frame.point(x[1], y[1])) else {
                    continue;
                };
                let data = self.values[row * columns + column];
                let color = match value.share_or_low(data) {
                    Some(share) => self.colors.at(share),
                    None if data == f64::INFINITY => self.colors.at(1.0),
                    None if data == f64::NEG_INFINITY => self.colors.at(0.0),
                    None => MISSING,
                };
                // A pixel on into the neighbours drawn next, so that no seam shows where a page scales the picture.
                let further = [0, 1].map(|i| to[i] + (to[i] - from[i]).signum());
                let [from, to] = [from, further].map(|p| frame.rect.clamp(p));
                canvas.rectangle(from, to, color, 1.0);
            }
        }
    }

    /// A square of its colour and its name for each class, the last on top.
    fn draw_legend(&self, canvas: &mut Canvas, frame: &Frame, value: &Scaled) {
        const STEP: f64 = BAR_WIDTH + 10.0;
        let (left, right) = (frame.rect.right + 18.0, frame.rect.right + 18.0 + BAR_WIDTH);
        let middle = 0.5 * (frame.rect.top + frame.rect.bottom);
        let first = middle + 0.5 * STEP * self.classes.len() as f64 - STEP;
        for (number, name) in self.classes.iter().enumerate() {
            let top = first - STEP * number as f64;
            let color = value.share_or_low(number as f64).map_or(MISSING, |share| self.colors.at(share));
            canvas.rectangle([left, top], [right, top + BAR_WIDTH], color, 1.0);
            let at = [right + 9.0, top + 0.5 * BAR_WIDTH + 0.36 * TICK];
            canvas.text(at, Label::new(name, TICK, Anchor::Start));
        }
    }

    fn draw_bar(&self, canvas: &mut Canvas, frame: &Frame, ticks: &[(f64, Tick)]) {
        let place = [frame.rect.right + 18.0, frame.rect.top, frame.rect.bottom];
        color_bar(canvas, place, self.colors, ticks, &self.value.heading());
    }

    /// The map as PNG bytes, two pixels for each CSS pixel.
    ///
    /// # Errors
    /// As for [`HeatMap::svg`].
    #[cfg(feature = "png")]
    pub fn png(&self) -> Result<Vec<u8>, ReportError> {
        png::encode(&self.drawn()?)
    }

    /// Writes the map to `path` as SVG or PNG, told by its extension.
    ///
    /// # Errors
    /// [`TableError::UnknownExtension`](carom_table::TableError::UnknownExtension), what the file system says, or as for [`HeatMap::svg`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), ReportError> {
        let path = path.as_ref();
        let format = ImageFormat::from_path(path)?;
        write_image(path, format, &self.drawn()?)
    }
}

/// A bar of colours with its divisions and heading, by its left edge, top and bottom.
pub(super) fn color_bar(
    canvas: &mut Canvas,
    [left, top, bottom]: [f64; 3],
    colors: ColorMap,
    ticks: &[(f64, Tick)],
    heading: &str,
) {
    let (right, height) = (left + BAR_WIDTH, bottom - top);
    let steps = height.round().max(1.0) as u32;
    for step in 0..steps {
        let at = |i: f64| (bottom - height * i / f64::from(steps)).max(top);
        let (foot, head) = (at(f64::from(step)), at(f64::from(step) + 2.0));
        let share = (f64::from(step) + 0.5) / f64::from(steps);
        canvas.rectangle([left, foot], [right, head], colors.at(share), 1.0);
    }
    let stroke = Stroke::new(Color(70, 70, 70), 1.0);
    canvas.line(&[[left, top], [right, top], [right, bottom], [left, bottom], [left, top]], stroke);
    for (share, tick) in ticks {
        let at = bottom - share * height;
        let length = if tick.label.is_some() { 5.0 } else { 3.0 };
        canvas.line(&[[right, at], [right + length, at]], stroke);
        if let Some(text) = &tick.label {
            canvas.text([right + 9.0, at + 0.36 * TICK], Label::new(text, TICK, Anchor::Start));
        }
    }
    let at = [right + 9.0 + widest(ticks) + 24.0, 0.5 * (top + bottom)];
    canvas.text(at, Label { upright: true, ..Label::new(heading, LABEL, Anchor::Middle) });
}
