//! Lines that stay apart: past the palette's end they are broken too, and of two that lie on each other the upper one
//! lets the lower show through its gaps.

use super::canvas::Point;
use super::draw::outline;
use super::frame::Frame;
use super::{Color, Dash, Series, Shape};

/// Lines closer than this are one to the eye, CSS pixels.
const CLOSE: f64 = 1.0;
/// Lines looked at for lying on each other; more are not told apart anyhow.
const MOST: usize = 60;
const STYLES: [Dash; 3] = [Dash::Solid, Dash::Dashed, Dash::Dotted];

/// The series as drawn. A line that was given a dash or is one of many thin ones stays as it is.
pub(super) fn styled(series: &[Series], frame: &Frame) -> Vec<Series> {
    let mut styled = series.to_vec();
    for (number, series) in styled.iter_mut().filter(|s| s.color.is_none()).enumerate() {
        let round = number / Color::PALETTE.len();
        if let Shape::Line { dash, .. } = &mut series.shape
            && *dash == Dash::Solid
        {
            *dash = STYLES[round % STYLES.len()];
        }
    }
    let lines: Vec<usize> = (0..styled.len()).filter(|i| is_line(&styled[*i])).collect();
    if lines.len() > MOST {
        return styled;
    }
    let outlines: Vec<Vec<Option<Point>>> = styled.iter().map(|s| line(s, frame)).collect();
    for (place, upper) in lines.iter().enumerate() {
        let below =
            lines[..place].iter().filter(|lower| lies_on(&outlines[*upper], &outlines[**lower], frame.rect.bottom));
        let taken: Vec<Dash> = below.filter_map(|lower| dash(&styled[*lower])).collect();
        let free = STYLES.into_iter().find(|style| !taken.contains(style));
        if let (Shape::Line { dash, .. }, Some(free)) = (&mut styled[*upper].shape, free)
            && taken.contains(dash)
        {
            *dash = free;
        }
    }
    styled
}

fn is_line(series: &Series) -> bool {
    !series.thin && matches!(series.shape, Shape::Line { .. })
}

fn dash(series: &Series) -> Option<Dash> {
    if let Shape::Line { dash, .. } = &series.shape { Some(*dash) } else { None }
}

fn line(series: &Series, frame: &Frame) -> Vec<Option<Point>> {
    if let Shape::Line { x, y, .. } = &series.shape { outline(frame, x, y) } else { Vec::new() }
}

/// Whether most of a line lies on another, both running from left to right; what lies on the foot of the frame, where lines of
/// zeros are, does not count.
fn lies_on(upper: &[Option<Point>], lower: &[Option<Point>], foot: f64) -> bool {
    let rising = |points: &[Option<Point>]| points.iter().flatten().is_sorted_by(|a, b| a[0] <= b[0]);
    if !rising(upper) || !rising(lower) {
        return false;
    }
    let (mut seen, mut hidden) = (0_usize, 0_usize);
    let lower: Vec<Point> = lower.iter().copied().flatten().collect();
    for [x, y] in upper.iter().flatten().filter(|p| (p[1] - foot).abs() > CLOSE) {
        seen += 1;
        let next = lower.partition_point(|p| p[0] < *x);
        let mut here = lower[next..].iter().take_while(|p| p[0] - x < 1e-9).peekable();
        let on = match (next.checked_sub(1).and_then(|i| lower.get(i)), lower.get(next)) {
            // a step has several points at one place
            _ if here.peek().is_some() => here.any(|p| (p[1] - y).abs() < CLOSE),
            (Some(a), Some(b)) => {
                let share = (x - a[0]) / (b[0] - a[0]);
                (a[1] + share * (b[1] - a[1]) - y).abs() < CLOSE
            }
            _ => false,
        };
        hidden += usize::from(on);
    }
    seen > 1 && 2 * hidden > seen
}
