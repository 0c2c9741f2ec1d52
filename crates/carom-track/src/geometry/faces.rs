//! The flat walls of a domain as one list of faces, looked at for `W` paths side by side.
//!
//! Most steps meet no wall, or one face and that in a plain way. Both are settled here for all lanes at once; what is left
//! (corners, round walls, spheres that touch already) is for [`Shape::meet`](super::Shape::meet), lane by lane.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::contact::misses;
use super::{Meeting, Plane};
use crate::integrate::{Lanes, Lanes3};
use crate::lanes::{Mask, bits, choose, mask};
use crate::vector::{Vec3, add, dot, scale};

/// A flat face of a wall.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    normal: Vec3,
    /// n · x on the face, m.
    level: f64,
    /// Radii between the centre and the face at contact.
    share: f64,
    /// Index of its wall.
    pub wall: usize,
}

impl Face {
    pub fn new(plane: &Plane, share: f64, wall: usize) -> Self {
        Self { normal: plane.normal, level: dot(plane.normal, plane.point), share, wall }
    }

    /// Contact at `x`, put exactly at the clearance.
    #[inline(always)]
    pub fn meeting(&self, theta: f64, x: Vec3, radius: f64) -> Meeting {
        let off = dot(self.normal, x) - self.level - self.share * radius;
        Meeting { theta, position: add(x, scale(self.normal, -off)), normal: self.normal }
    }
}

/// What flat faces lie ahead of `W` paths.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Ahead<const W: usize> {
    /// How many faces each may meet: surely no wall at all where it is 0.
    pub(crate) count: [u64; W],
    /// The last of these faces.
    pub(crate) face: [u64; W],
    /// Bernstein coefficients over the step of the distance from contact with it, m.
    gap: [Lanes<W>; 6],
    /// Distance below which a sphere may touch, m.
    margin: Lanes<W>,
}

impl<const W: usize> Ahead<W> {
    /// Whatever may be ahead: all is left to the look lane by lane.
    pub const UNKNOWN: Self = Self { count: [2; W], face: [0; W], gap: [[0.0; W]; 6], margin: [0.0; W] };

    /// No face looked at yet, for spheres that may touch within `margin`.
    #[inline(always)]
    pub(crate) fn nothing(margin: Lanes<W>) -> Self {
        Self { count: [0; W], margin, ..Self::UNKNOWN }
    }

    /// Looks at one face more.
    #[inline(always)]
    pub(crate) fn look(&mut self, index: usize, face: &Face, x: &Lanes3<W>, path: &[Lanes3<W>; 5], radius: &Lanes<W>) {
        let mut gap = [[0.0; W]; 6];
        let start = along(face.normal, x);
        for l in 0..W {
            gap[0][l] = start[l] - face.level - face.share * radius[l];
        }
        let mut lowest = [f64::INFINITY; W];
        for i in 0..5 {
            let change = along(face.normal, &path[i]);
            for l in 0..W {
                lowest[l] = if change[l] < lowest[l] { change[l] } else { lowest[l] };
                gap[i + 1][l] = gap[0][l] + change[l];
            }
        }
        let mut may = [0; W];
        for l in 0..W {
            may[l] = mask(!misses(gap[0][l], lowest[l], self.margin[l]));
        }
        for l in 0..W {
            self.count[l] += may[l] & 1;
            self.face[l] = (self.face[l] & !may[l]) | (index as u64 & may[l]);
        }
        for i in 0..6 {
            choose(&mut self.gap[i], &gap[i], &may);
        }
    }

    /// Leaves the lanes of a mask to the look lane by lane.
    #[inline(always)]
    pub(crate) fn look_further(&mut self, lanes: &Mask<W>) {
        for l in 0..W {
            self.count[l] += lanes[l] & 2;
        }
    }

    /// Where on the step the only face ahead is met, for the lanes of which that is plain: a sphere clear of it, a gap whose
    /// coefficients change sign once. As [`Bernstein::first_descent`](super::Bernstein::first_descent), by Halley's method.
    #[inline(always)]
    pub(crate) fn descents(&self) -> (Lanes<W>, Mask<W>) {
        let b = &self.gap;
        let mut plain = [0; W];
        for l in 0..W {
            plain[l] = mask(self.count[l] == 1) & mask(b[0][l] > self.margin[l]) & mask(b[5][l] < 0.0);
        }
        let mut above = [0u64; W];
        for i in 0..5 {
            // one change from positive to negative: never back
            for l in 0..W {
                above[l] |= mask(b[i][l] <= 0.0);
                plain[l] &= !(above[l] & mask(b[i + 1][l] > 0.0));
            }
        }
        if bits(&plain) == 0 {
            return ([0.0; W], plain);
        }
        let theta = single_descents(b, &mut plain);
        (theta, plain)
    }
}

/// Where polynomials by their Bernstein coefficients come down through zero, for the lanes of which it is plain that they do so once.
/// Lanes on which the search does not settle are taken out.
#[inline(always)]
pub(crate) fn single_descents<const W: usize>(b: &[Lanes<W>; 6], plain: &mut Mask<W>) -> Lanes<W> {
    let m = powers(b);
    let (mut low, mut high) = ([0.0; W], [1.0; W]);
    let mut theta = [0.0; W];
    for l in 0..W {
        theta[l] = b[0][l] / (b[0][l] - b[5][l]);
    }
    let mut open = *plain;
    for _ in 0..MOST {
        halley(&m, &mut theta, &mut low, &mut high, &mut open);
        if bits(&open) == 0 {
            break;
        }
    }
    for l in 0..W {
        plain[l] &= !open[l];
    }
    theta
}

/// Iterations after which a root is left to the careful search: gentle curves need two or three.
const MOST: u32 = 8;

/// n · v, lane by lane.
#[inline(always)]
fn along<const W: usize>(n: Vec3, v: &Lanes3<W>) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = n[0] * v[0][l] + n[1] * v[1][l] + n[2] * v[2][l];
    }
    out
}

/// Coefficients of the powers of θ.
#[inline(always)]
fn powers<const W: usize>(b: &[Lanes<W>; 6]) -> [Lanes<W>; 6] {
    const BINOMIAL: [f64; 6] = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
    let mut m = *b;
    for k in 1..6 {
        for i in (k..6).rev() {
            for l in 0..W {
                m[i][l] -= m[i - 1][l];
            }
        }
    }
    for k in 1..6 {
        for l in 0..W {
            m[k][l] *= BINOMIAL[k];
        }
    }
    m
}

/// One step of Halley's method, kept inside the brackets, for the lanes that are open; those that arrive are closed.
#[inline(always)]
fn halley<const W: usize>(
    m: &[Lanes<W>; 6],
    theta: &mut Lanes<W>,
    low: &mut Lanes<W>,
    high: &mut Lanes<W>,
    open: &mut Mask<W>,
) {
    let (mut value, mut slope, mut bend) = (m[5], [0.0f64; W], [0.0f64; W]);
    for i in (0..5).rev() {
        for l in 0..W {
            bend[l] = bend[l].mul_add(theta[l], slope[l]);
            slope[l] = slope[l].mul_add(theta[l], value[l]);
            value[l] = value[l].mul_add(theta[l], m[i][l]);
        }
    }
    let mut next = [0.0; W];
    for l in 0..W {
        low[l] = if value[l] > 0.0 { theta[l] } else { low[l] };
        high[l] = if value[l] > 0.0 { high[l] } else { theta[l] };
        next[l] = theta[l] - value[l] * slope[l] / slope[l].mul_add(slope[l], -(value[l] * bend[l]));
    }
    let (mut inside, mut near) = ([0; W], [0; W]);
    for l in 0..W {
        inside[l] = mask(next[l] >= low[l]) & mask(next[l] <= high[l]);
        // Halley's method cubes what is left: 1e-6 of θ becomes rounding
        near[l] = inside[l] & mask((next[l] - theta[l]).abs() <= 1e-6 * theta[l]);
    }
    let mut middle = [0.0; W];
    for l in 0..W {
        middle[l] = 0.5 * (low[l] + high[l]);
    }
    choose(&mut middle, &next, &inside);
    choose(theta, &middle, open);
    for l in 0..W {
        open[l] &= !near[l];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Path, Room, Shape};
    use proptest::prelude::*;

    #[test]
    fn what_is_settled_side_by_side_is_what_the_room_says() {
        let room = Room { min: [0.0; 3], max: [1.0, 2.0, 3.0] };
        let faces: Vec<Face> = room.faces().iter().map(|f| Face::new(f, 1.0, 0)).collect();
        proptest!(|(x in prop::array::uniform3(0.11f64..0.89), points in prop::array::uniform5(prop::array::uniform3(-0.8f64..0.8)))| {
            let path = Path { start: x, points };
            let column = |v: Vec3| v.map(|c| [c]);
            let mut ahead = Ahead::<1>::nothing([1e-9]);
            for (i, face) in faces.iter().enumerate() {
                ahead.look(i, face, &column(x), &points.map(column), &[0.1]);
            }
            let met = Shape::Room(room).meet(&path, 0.1, 1e-12).map(|(m, _)| m);
            if ahead.count[0] == 0 {
                prop_assert!(met.is_none());
            }
            let (theta, plain) = ahead.descents();
            if plain[0] != 0 {
                let m = met.unwrap();
                let face = &faces[ahead.face[0] as usize];
                let here = face.meeting(theta[0], path.at(theta[0]), 0.1);
                prop_assert!((here.theta - m.theta).abs() < 1e-12 && here.normal == m.normal, "{:?} {:?}", here, m);
                prop_assert!((0..3).all(|c| (here.position[c] - m.position[c]).abs() < 1e-12));
            }
        });
    }

    #[test]
    fn plain_hits_are_settled() {
        let room = Room { min: [0.0; 3], max: [1.0; 3] };
        let path = Path::straight([0.5; 3], [0.2, -1.0, 0.1]);
        let mut ahead = Ahead::<2>::nothing([1e-9; 2]);
        for (i, face) in room.faces().iter().enumerate() {
            let two = |v: Vec3| v.map(|c| [c, 0.1 * c]);
            ahead.look(i, &Face::new(face, 0.0, 0), &[[0.5; 2]; 3], &path.points.map(two), &[0.1; 2]);
        }
        assert_eq!((ahead.count, ahead.face[0]), ([1, 0], 2));
        let (theta, plain) = ahead.descents();
        assert!((theta[0] - 0.5).abs() < 1e-15 && plain == [u64::MAX, 0]);
    }
}
