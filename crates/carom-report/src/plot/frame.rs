//! The rectangle that data are drawn in, with its axes, labels and title.

use super::canvas::{Anchor, Canvas, Label, Point, Stroke};
use super::clip::Rect;
use super::scaled::Scaled;
use super::ticks::Tick;
use super::{Axis, Color, font};

pub(super) const TITLE: f64 = 18.0;
pub(super) const LABEL: f64 = 15.0;
pub(super) const TICK: f64 = 13.0;

const EDGE: Color = Color(70, 70, 70);
const GRID: Color = Color(222, 222, 226);
const FINE_GRID: Color = Color(240, 240, 243);

/// Where everything goes.
pub(super) struct Frame {
    pub size: (u32, u32),
    pub rect: Rect,
    pub x: Scaled,
    pub y: Scaled,
    x_ticks: Vec<(f64, Tick)>,
    y_ticks: Vec<(f64, Tick)>,
}

/// The widest label of some divisions.
pub(super) fn widest(ticks: &[(f64, Tick)]) -> f64 {
    ticks.iter().filter_map(|(_, t)| t.label.as_deref()).map(|l| font::width(l, TICK)).fold(0.0, f64::max)
}

/// Divisions that fit a height.
pub(super) fn vertical_ticks(scaled: &Scaled, height: f64) -> Vec<(f64, Tick)> {
    scaled.ticks((height / 55.0).clamp(2.0, 10.0) as usize)
}

/// Divisions whose labels fit a width side by side.
fn horizontal_ticks(scaled: &Scaled, width: f64) -> Vec<(f64, Tick)> {
    let mut count = (width / 75.0).clamp(2.0, 12.0) as usize;
    loop {
        let ticks = scaled.ticks(count);
        let named = ticks.iter().filter(|(_, t)| t.label.is_some()).count();
        if count <= 2 || named as f64 * (widest(&ticks) + 18.0) < width {
            return ticks;
        }
        count -= 1;
    }
}

impl Frame {
    /// Lays a picture out, `right` pixels at its right side left free for a legend or colour bar.
    pub(super) fn new(
        title: &str,
        axes: (&Axis, &Axis),
        scaled: (Scaled, Scaled),
        size: (u32, u32),
        right: f64,
    ) -> Self {
        let (x, y) = scaled;
        let (width, height) = (f64::from(size.0), f64::from(size.1));
        let top = if title.is_empty() { 20.0 } else { 52.0 };
        let below = if axes.0.heading().is_empty() { 36.0 } else { 62.0 };
        let bottom = (height - below).max(top + 20.0);
        let y_ticks = vertical_ticks(&y, bottom - top);
        let beside = if axes.1.heading().is_empty() { 18.0 } else { 46.0 };
        let left = beside + widest(&y_ticks);
        let side = right.max(24.0);
        let right = (width - side).max(left + 20.0);
        let x_ticks = horizontal_ticks(&x, right - left);
        Self { size, rect: Rect { left, top, right, bottom }, x, y, x_ticks, y_ticks }
    }

    /// Makes lengths equal along both axes by taking height or width from the frame and the picture; an axis that
    /// would then be too short to read is widened instead.
    pub(super) fn equalize(&mut self, title: &str) {
        const LEAST: f64 = 110.0;
        let (width, height) = (self.rect.width(), self.rect.height());
        let pixels = (width / self.x.span()).min(height / self.y.span());
        let least_width = LEAST.max(font::width(title, TITLE) - self.rect.left);
        let new =
            ((self.x.span() * pixels).max(least_width.min(width)), (self.y.span() * pixels).max(LEAST.min(height)));
        self.x.widen_to(new.0 / pixels);
        self.y.widen_to(new.1 / pixels);
        self.rect.right = self.rect.left + new.0;
        self.rect.bottom = self.rect.top + new.1;
        self.size.0 -= ((width - new.0).floor() as u32).min(self.size.0);
        self.size.1 -= ((height - new.1).floor() as u32).min(self.size.1);
        self.x_ticks = horizontal_ticks(&self.x, new.0);
        self.y_ticks = vertical_ticks(&self.y, new.1);
    }

    /// Place of a data point; none where an axis has no place for it.
    pub(super) fn point(&self, x: f64, y: f64) -> Option<Point> {
        Some(self.place(self.x.share(x)?, self.y.share(y)?))
    }

    /// Place of shares along the axes.
    pub(super) fn place(&self, x: f64, y: f64) -> Point {
        [self.rect.left + x * self.rect.width(), self.rect.bottom - y * self.rect.height()]
    }

    pub(super) fn grid(&self, canvas: &mut Canvas) {
        // All the fine lines first, so that none crosses over a stronger one.
        for strong in [false, true] {
            let (color, width) = if strong { (GRID, 1.0) } else { (FINE_GRID, 0.8) };
            let stroke = Stroke::new(color, width);
            for (share, _) in self.x_ticks.iter().filter(|(_, t)| t.label.is_some() == strong) {
                canvas.line(&[self.place(*share, 0.0), self.place(*share, 1.0)], stroke);
            }
            for (share, _) in self.y_ticks.iter().filter(|(_, t)| t.label.is_some() == strong) {
                canvas.line(&[self.place(0.0, *share), self.place(1.0, *share)], stroke);
            }
        }
    }

    /// Edges, divisions, numbers, labels and title.
    pub(super) fn axes(&self, canvas: &mut Canvas, title: &str, x: &Axis, y: &Axis) {
        let Rect { left, top, right, bottom } = self.rect;
        let stroke = Stroke::new(EDGE, 1.0);
        canvas.line(&[[left, top], [left, bottom], [right, bottom], [right, top], [left, top]], stroke);
        for (share, tick) in &self.x_ticks {
            let [at, _] = self.place(*share, 0.0);
            let length = if tick.label.is_some() { 5.0 } else { 3.0 };
            canvas.line(&[[at, bottom], [at, bottom + length]], stroke);
            if let Some(text) = &tick.label {
                canvas.text([at, bottom + 20.0], Label::new(text, TICK, Anchor::Middle));
            }
        }
        for (share, tick) in &self.y_ticks {
            let [_, at] = self.place(0.0, *share);
            let length = if tick.label.is_some() { 5.0 } else { 3.0 };
            canvas.line(&[[left - length, at], [left, at]], stroke);
            if let Some(text) = &tick.label {
                canvas.text([left - 9.0, at + 0.36 * TICK], Label::new(text, TICK, Anchor::End));
            }
        }
        let middle = self.place(0.5, 0.5);
        canvas.text([middle[0], bottom + 46.0], Label::new(&x.heading(), LABEL, Anchor::Middle));
        let heading = y.heading();
        canvas.text([22.0, middle[1]], Label { upright: true, ..Label::new(&heading, LABEL, Anchor::Middle) });
        // Over the frame's middle where that fits, else within the picture.
        let half = 0.5 * font::width(title, TITLE) + 8.0;
        let at = middle[0].min(f64::from(self.size.0) - half).max(half);
        canvas.text([at, 32.0], Label::new(title, TITLE, Anchor::Middle));
    }
}
