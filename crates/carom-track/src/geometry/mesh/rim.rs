//! Contact with the edges and corners that stick out.
//!
//! The distance from a line or a point is the root of a polynomial of degree ten, whose last digits drown where the path is
//! long against the clearance: pieces of the path that come near are halved until they are short enough.

use super::super::Bernstein;
use super::super::contact::{misses, overlapping_contact};
use super::piece::Piece;
use crate::vector::{Vec3, add, dot, norm, scale, sub, unit};

/// Lengths of a piece, over the clearance, at which the polynomial keeps enough digits.
const LONGEST: f64 = 500.0;
/// Pieces looked at beside one edge or corner; with more (a path all along an edge, very near) the polynomial has to do.
const MOST: u32 = 2000;

/// What must be close for contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    /// Distance of the centre at contact, m.
    pub clearance: f64,
    /// The distance that counts as touching, m.
    pub slack: f64,
}

impl Reach {
    /// Sine of the angle by which a direction must lead away from a triangle to belong to its edge; nearer ones are the
    /// face's, which reaches as far beyond its edges.
    pub fn tilt(&self) -> f64 {
        0.1 * self.beside() / self.clearance
    }

    /// How far beyond its edges a face still counts, m.
    pub fn beside(&self) -> f64 {
        self.slack.max(2e-9 * self.clearance)
    }
}

/// The unit vector from the line through two points to a third, across the line; none if that is on it.
pub(super) fn across(a: Vec3, b: Vec3, c: Vec3) -> Option<Vec3> {
    let e = unit(sub(b, a))?;
    let r = sub(c, a);
    unit(sub(r, scale(e, dot(e, r))))
}

/// The first θ on a piece at which it comes within reach of the edge from `a` to `b`, at a place that `accept` takes, given
/// the centre and the nearest point of the edge.
pub(super) fn edge(
    a: Vec3,
    b: Vec3,
    piece: &Piece,
    reach: Reach,
    accept: &mut dyn FnMut(Vec3, Vec3) -> bool,
) -> Option<f64> {
    near_edge(a, b, piece, reach, accept, &mut { MOST })
}

fn near_edge(
    a: Vec3,
    b: Vec3,
    piece: &Piece,
    reach: Reach,
    accept: &mut dyn FnMut(Vec3, Vec3) -> bool,
    rest: &mut u32,
) -> Option<f64> {
    let path = &piece.path;
    let bend = norm(piece.bend());
    if between(path.start, path.points[4], a, sub(b, a)) > reach.clearance + reach.slack + bend {
        return None;
    }
    if norm(path.points[4]) + bend > LONGEST * reach.clearance && *rest > 0 {
        *rest -= 1;
        let (first, second) = piece.halves();
        return near_edge(a, b, &first, reach, accept, rest).or_else(|| near_edge(a, b, &second, reach, accept, rest));
    }
    let along = sub(b, a);
    let length = norm(along);
    let e = unit(along)?;
    let across = |x: Vec3| sub(x, scale(e, dot(x, e)));
    let (gap, change) = square(across(sub(path.start, a)), &path.points.map(across), reach.clearance);
    let theta = overlapping_contact(gap, &change, 2.0 * reach.clearance * reach.slack, |theta| {
        let x = path.at(theta);
        let s = dot(e, sub(x, a));
        // a corner's share begins where the edge ends: both count there
        let beside = reach.beside();
        s >= -beside && s <= length + beside && accept(x, add(a, scale(e, s.clamp(0.0, length))))
    })?;
    Some(piece.theta(theta))
}

/// Likewise of a corner.
pub(super) fn corner(a: Vec3, piece: &Piece, reach: Reach, accept: &mut dyn FnMut(Vec3, Vec3) -> bool) -> Option<f64> {
    near_corner(a, piece, reach, accept, &mut { MOST })
}

fn near_corner(
    a: Vec3,
    piece: &Piece,
    reach: Reach,
    accept: &mut dyn FnMut(Vec3, Vec3) -> bool,
    rest: &mut u32,
) -> Option<f64> {
    let path = &piece.path;
    let bend = norm(piece.bend());
    if beside(path.start, path.points[4], a) > reach.clearance + reach.slack + bend {
        return None;
    }
    if norm(path.points[4]) + bend > LONGEST * reach.clearance && *rest > 0 {
        *rest -= 1;
        let (first, second) = piece.halves();
        return near_corner(a, &first, reach, accept, rest).or_else(|| near_corner(a, &second, reach, accept, rest));
    }
    let r0 = sub(path.start, a);
    // a corner is passed at a distance far more often than met
    let rho = norm(r0);
    let lowest = path.points.iter().map(|p| dot(r0, *p) / rho).fold(f64::INFINITY, f64::min);
    if misses(rho - reach.clearance, lowest, reach.slack) {
        return None;
    }
    let (gap, change) = square(r0, &path.points, reach.clearance);
    let theta =
        overlapping_contact(gap, &change, 2.0 * reach.clearance * reach.slack, |theta| accept(path.at(theta), a))?;
    Some(piece.theta(theta))
}

/// |r₀ + p(θ)|² − c² at the start, and how it changes.
fn square(r0: Vec3, points: &[Vec3; 5], clearance: f64) -> (f64, Bernstein<11>) {
    let rho = norm(r0);
    let mut change = Bernstein([0.0; 11]);
    for c in 0..3 {
        let p = Bernstein([0.0, points[0][c], points[1][c], points[2][c], points[3][c], points[4][c]]);
        change = change.plus(&p.times(&p.scaled(1.0, 2.0 * r0[c])));
    }
    ((rho - clearance) * (rho + clearance), change)
}

/// Distance of a point from the stretch that goes from `p` along `d`.
fn beside(p: Vec3, d: Vec3, x: Vec3) -> f64 {
    let r = sub(x, p);
    let s = (dot(r, d) / dot(d, d)).clamp(0.0, 1.0);
    // a stretch of no length divides nothing by nothing
    norm(sub(r, scale(d, if s.is_nan() { 0.0 } else { s })))
}

/// A lower bound, close to rounding, of the distance between the stretch from `p` along `d` and the one from `q` along `e`
/// (Ericson 2005, *Real-Time Collision Detection*, section 5.1.9).
fn between(p: Vec3, d: Vec3, q: Vec3, e: Vec3) -> f64 {
    let r = sub(p, q);
    let (dd, ee, de) = (dot(d, d), dot(e, e), dot(d, e));
    let (dr, er) = (dot(d, r), dot(e, r));
    let square = dd * ee - de * de;
    // parallel ones are as near at the start as anywhere
    let s = if square > 1e-12 * dd * ee { ((de * er - dr * ee) / square).clamp(0.0, 1.0) } else { 0.0 };
    let t = (de * s + er) / ee;
    let (s, t) = if t < 0.0 {
        ((-dr / dd).clamp(0.0, 1.0), 0.0)
    } else if t > 1.0 {
        (((de - dr) / dd).clamp(0.0, 1.0), 1.0)
    } else {
        (s, t)
    };
    let s = if s.is_nan() { 0.0 } else { s };
    let gap = norm(sub(add(r, scale(d, s)), scale(e, t)));
    if square > 1e-6 * dd * ee {
        return gap;
    }
    // nearly parallel: what they come closer between their ends is no more than the shorter one turns away from the other
    let sine = (square.max(0.0) / (dd * ee)).sqrt() + 1e-8;
    let turned = sine * dd.min(ee).sqrt();
    gap.min(ends(p, d, q, e)) - if turned.is_nan() { 0.0 } else { turned }
}

/// The least distance from the ends of one of two stretches to the other.
fn ends(p: Vec3, d: Vec3, q: Vec3, e: Vec3) -> f64 {
    let first = beside(q, e, p).min(beside(q, e, add(p, d)));
    first.min(beside(p, d, q)).min(beside(p, d, add(q, e)))
}
