//! Tetrahedra made from their nodes, for `W` spheres side by side, when they enter them.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::beyond::Plane;
use super::strips::Strips;
use super::tetrahedron::FLAT;
use super::{Cells, Node, Tetrahedra, Tetrahedron};
use crate::domain::Pieces;
use crate::integrate::{Lanes, Lanes3};
use crate::lanes::{Mask, choose, mask, take_lowest};
use crate::vector::Vec3;

impl Cells {
    /// A tetrahedron by its number; `None` if it is flat, or another stands for it.
    pub(crate) fn tetrahedron(&self, tet: u32) -> Option<Tetrahedron> {
        self.tetrahedron_of(tet, self.cut.cell(tet))
    }

    /// The same of a known cell.
    pub(crate) fn tetrahedron_of(&self, tet: u32, cell: u32) -> Option<Tetrahedron> {
        let (made, good) = self.make(&[tet], &[cell], 1);
        (good[0] != 0).then(|| made.get(0))
    }

    /// Those of some lanes, given as bits, by their numbers and cells, and which of them are not flat and stand for themselves.
    #[inline(always)]
    pub(crate) fn make<const W: usize>(&self, id: &[u32; W], cell: &[u32; W], lanes: u64) -> (Tetrahedra<W>, Mask<W>) {
        match (&self.plane, &self.strips) {
            (Some(plane), Some(strips)) => self.make_in_plane(plane, strips, id, cell, lanes),
            (plane, _) => self.make_solid(plane.as_ref(), id, cell, lanes),
        }
    }

    #[inline(always)]
    fn make_solid<const W: usize>(
        &self,
        plane: Option<&Plane>,
        id: &[u32; W],
        cell: &[u32; W],
        mut lanes: u64,
    ) -> (Tetrahedra<W>, Mask<W>) {
        let (mut at, mut good) = ([[0; 4]; W], [0; W]);
        let mut left = lanes;
        while let Some(l) = take_lowest(&mut left) {
            let ([a, b, c], centre) = self.corners(id[l], cell[l]);
            (at[l], good[l]) = ([a, b, c, centre], u64::MAX);
        }
        let mut nodes = [Nodes::ZERO; 4];
        while let Some(l) = take_lowest(&mut lanes) {
            for i in 0..4 {
                nodes[i].put(l, &self.nodes[at[l][i]]);
            }
        }
        let [mut a, mut b, mut c, mut centre] = nodes;
        a.less(&centre);
        b.less(&centre);
        c.less(&centre);
        let (mut dual, sound) = dual(&a.place, &b.place, &c.place);
        if let Some(plane) = plane {
            shift(&mut centre.place, plane.across, plane.level);
            for d in &mut dual {
                shift(d, plane.across, 0.0);
            }
        }
        let mut gradient = [[[0.0; W]; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                for l in 0..W {
                    let sum = a.velocity[i][l] * dual[0][j][l] + b.velocity[i][l] * dual[1][j][l];
                    gradient[i][j][l] = sum + c.velocity[i][l] * dual[2][j][l];
                }
            }
        }
        for l in 0..W {
            good[l] &= sound[l];
        }
        let Nodes { place: origin, velocity } = centre;
        (Tetrahedra { origin, dual, velocity, gradient, clear: [0.0; W], id: *id, cell: *cell }, good)
    }

    /// The triangles of a plane case: a corner that is alone on its column, and two that share the other column's coordinate.
    #[inline(always)]
    fn make_in_plane<const W: usize>(
        &self,
        plane: &Plane,
        strips: &Strips,
        id: &[u32; W],
        cell: &[u32; W],
        mut lanes: u64,
    ) -> (Tetrahedra<W>, Mask<W>) {
        let (mut at, mut good, mut alone) = ([[0; 3]; W], [0; W], [0; W]);
        let mut left = lanes;
        while let Some(l) = take_lowest(&mut left) {
            let (corners, centre) = self.corners(id[l], cell[l]);
            let single = strips.alone(id[l]);
            let [p, q] = match single {
                0 => [corners[0], corners[1]],
                1 => [corners[1], corners[2]],
                _ => [corners[2], corners[0]],
            };
            (at[l], alone[l], good[l]) = ([p, q, centre], single, mask(single < 3));
        }
        let mut nodes = [Nodes::ZERO; 3];
        while let Some(l) = take_lowest(&mut lanes) {
            for i in 0..3 {
                nodes[i].put(l, &self.nodes[at[l][i]]);
            }
        }
        let [mut p, mut q, mut centre] = nodes;
        for node in [&mut p, &mut q, &mut centre] {
            shift(&mut node.place, plane.across, plane.level);
        }
        p.less(&centre);
        q.less(&centre);
        let across = spread(plane.across);
        let (mut to_p, mut to_q) = (cross(&q.place, &across), cross(&across, &p.place));
        let area = dot(&p.place, &to_p);
        let (pp, qq) = (dot(&p.place, &p.place), dot(&q.place, &q.place));
        let mut share = [0.0; W];
        for l in 0..W {
            good[l] &= mask(area[l] * area[l] > FLAT * FLAT * pp[l] * qq[l]);
            share[l] = 1.0 / area[l];
        }
        scale(&mut to_p, &share);
        scale(&mut to_q, &share);
        let mut gradient = [[[0.0; W]; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                for l in 0..W {
                    gradient[i][j][l] = p.velocity[i][l] * to_p[j][l] + q.velocity[i][l] * to_q[j][l];
                }
            }
        }
        scale(&mut to_q, &[0.5; W]);
        let mut dual = [to_q; 3];
        for i in 0..3 {
            let mut is = [0; W];
            for l in 0..W {
                is[l] = mask(alone[l] == i as u64);
            }
            for c in 0..3 {
                choose(&mut dual[i][c], &to_p[c], &is);
            }
        }
        let Nodes { place: origin, velocity } = centre;
        (Tetrahedra { origin, dual, velocity, gradient, clear: [0.0; W], id: *id, cell: *cell }, good)
    }
}

/// A node of each lane.
#[derive(Clone, Copy)]
#[repr(align(64))]
struct Nodes<const W: usize> {
    place: Lanes3<W>,
    velocity: Lanes3<W>,
}

impl<const W: usize> Nodes<W> {
    const ZERO: Self = Self { place: [[0.0; W]; 3], velocity: [[0.0; W]; 3] };

    #[inline(always)]
    fn put(&mut self, l: usize, node: &Node) {
        for c in 0..3 {
            self.place[c][l] = node.place[c];
            self.velocity[c][l] = node.velocity[c];
        }
    }

    #[inline(always)]
    fn less(&mut self, other: &Self) {
        for c in 0..3 {
            for l in 0..W {
                self.place[c][l] -= other.place[c][l];
                self.velocity[c][l] -= other.velocity[c][l];
            }
        }
    }
}

/// The vectors dual to three edges, and where these are not flat.
#[inline(always)]
fn dual<const W: usize>(a: &Lanes3<W>, b: &Lanes3<W>, c: &Lanes3<W>) -> ([Lanes3<W>; 3], Mask<W>) {
    let mut normals = [cross(b, c), cross(c, a), cross(a, b)];
    let volume = dot(a, &normals[0]);
    let (aa, bb, cc) = (dot(a, a), dot(b, b), dot(c, c));
    let (mut sound, mut share) = ([0; W], [0.0; W]);
    for l in 0..W {
        sound[l] = mask(volume[l] * volume[l] > FLAT * FLAT * aa[l] * bb[l] * cc[l]);
        share[l] = 1.0 / volume[l];
    }
    for n in &mut normals {
        scale(n, &share);
    }
    (normals, sound)
}

#[inline(always)]
fn spread<const W: usize>(v: Vec3) -> Lanes3<W> {
    [[v[0]; W], [v[1]; W], [v[2]; W]]
}

/// Moves vectors along a direction to a level of it.
#[inline(always)]
fn shift<const W: usize>(v: &mut Lanes3<W>, along: Vec3, level: f64) {
    let mut way = [0.0; W];
    for l in 0..W {
        way[l] = level - (v[0][l] * along[0] + v[1][l] * along[1] + v[2][l] * along[2]);
    }
    for c in 0..3 {
        for l in 0..W {
            v[c][l] += way[l] * along[c];
        }
    }
}

#[inline(always)]
fn scale<const W: usize>(v: &mut Lanes3<W>, by: &Lanes<W>) {
    for c in 0..3 {
        for l in 0..W {
            v[c][l] *= by[l];
        }
    }
}

#[inline(always)]
fn dot<const W: usize>(a: &Lanes3<W>, b: &Lanes3<W>) -> Lanes<W> {
    let mut out = [0.0; W];
    for l in 0..W {
        out[l] = a[0][l] * b[0][l] + a[1][l] * b[1][l] + a[2][l] * b[2][l];
    }
    out
}

#[inline(always)]
fn cross<const W: usize>(a: &Lanes3<W>, b: &Lanes3<W>) -> Lanes3<W> {
    let mut out = [[0.0; W]; 3];
    for c in 0..3 {
        let (i, j) = ((c + 1) % 3, (c + 2) % 3);
        for l in 0..W {
            out[c][l] = a[i][l] * b[j][l] - a[j][l] * b[i][l];
        }
    }
    out
}
