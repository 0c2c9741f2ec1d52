//! A picture as an SVG document.
//!
//! Coordinates are whole numbers on a grid of [`FINE`] steps a CSS pixel, which the document's `viewBox` scales back: shorter than
//! decimals, and no curve is visibly ragged.

use std::fmt::{self, Write as _};

use super::Color;
use super::canvas::{Anchor, Canvas, Element, Fill, Point};
use super::font;

/// Grid steps a CSS pixel.
const FINE: f64 = 10.0;

/// A length on the grid.
struct Fine(f64);

impl fmt::Display for Fine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // `as` saturates, and callers have clipped to the picture.
        write!(f, "{}", (self.0 * FINE).round() as i32)
    }
}

struct Points<'p>(&'p [Point]);

impl fmt::Display for Points<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|[x, y]| write!(f, "{},{} ", Fine(*x), Fine(*y)))
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(red, green, blue) = self;
        write!(f, "#{red:02X}{green:02X}{blue:02X}")
    }
}

impl fmt::Display for Fill {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.opacity != 1.0 {
            write!(f, "opacity=\"{}\" ", self.opacity)?;
        }
        write!(f, "fill=\"{}\"", self.color)
    }
}

struct Escaped<'t>(&'t str);

impl fmt::Display for Escaped<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.chars().try_for_each(|c| match c {
            '<' => f.write_str("&lt;"),
            '>' => f.write_str("&gt;"),
            '&' => f.write_str("&amp;"),
            '"' => f.write_str("&quot;"),
            '\'' => f.write_str("&apos;"),
            // XML knows no other control characters
            c if c.is_control() && !matches!(c, '\t' | '\n' | '\r') => f.write_char('\u{fffd}'),
            c => f.write_char(c),
        })
    }
}

pub(super) fn document(canvas: &Canvas) -> String {
    let (width, height) = canvas.size;
    let (across, down) = (Fine(width.into()), Fine(height.into()));
    let mut svg = format!(
        "<svg width=\"{width}\" height=\"{height}\" stroke-linejoin=\"round\" stroke-linecap=\"round\" \
         viewBox=\"0 0 {across} {down}\" xmlns=\"http://www.w3.org/2000/svg\">\n"
    );
    for element in &canvas.elements {
        // a string takes all that is written
        let _ = write(&mut svg, element);
    }
    svg.push_str("</svg>\n");
    svg
}

fn write(svg: &mut String, element: &Element) -> fmt::Result {
    match element {
        Element::Line { points, stroke, dashes } => {
            let (color, width) = (stroke.color, Fine(stroke.width));
            write!(svg, "<polyline fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"")?;
            if let Some([dash, gap]) = dashes {
                write!(svg, " stroke-dasharray=\"{} {}\"", Fine(*dash), Fine(*gap))?;
            }
            writeln!(svg, " points=\"{}\"/>", Points(points))
        }
        Element::Polygon { points, fill } => writeln!(svg, "<polygon {fill} points=\"{}\"/>", Points(points)),
        Element::Rectangle { from, to, fill } => {
            let [left, top, right, bottom] = [from[0], from[1], to[0], to[1]].map(|p| (p * FINE).round() as i32);
            let (width, height) = (right.saturating_sub(left), bottom.saturating_sub(top));
            writeln!(svg, "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" {fill}/>")
        }
        Element::Disc { center: [x, y], radius, color } => {
            let (x, y, radius) = (Fine(*x), Fine(*y), Fine(*radius));
            writeln!(svg, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{color}\"/>")
        }
        Element::Text { at, text, size, color, anchor, upright } => {
            let (x, y, size) = (Fine(at[0]), Fine(at[1]), Fine(*size));
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            write!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" font-family=\"{}\"", font::FAMILY)?;
            write!(svg, " font-size=\"{size}\" fill=\"{color}\"")?;
            if *upright {
                write!(svg, " transform=\"rotate(270, {x}, {y})\"")?;
            }
            writeln!(svg, ">\n{}\n</text>", Escaped(text))
        }
    }
}
