//! The first contact of a path with triangles.
//!
//! The path is divided into pieces that are nearly straight against its clearance or the triangles' size; for each in turn the
//! boxes that a band around its chord crosses are visited, nearest first, until the best contact lies before all that wait.

use super::super::bernstein::Descents;
use super::super::{Meeting, Path};
use super::Mesh;
use super::falls::Falls;
use super::piece::Piece;
use super::rim::{self, Reach};
use super::surface::{Face, Surface};
use super::tree::{Child, MIXED, Node, STACK};
use crate::vector::{Vec3, cross, dot, norm, scale, sub, unit};
use arrayvec::ArrayVec;

/// Most pieces of one path, as a power of two.
const MOST_HALVINGS: u32 = 6;

/// A search under way.
pub(super) struct Sweep<'a> {
    mesh: &'a Mesh,
    path: &'a Path,
    reach: Reach,
    best: f64,
    found: Option<Found>,
    /// What the last plane looked at does to the path.
    flat: u32,
    falls: Falls,
}

/// A contact: the triangle, and what of it is touched.
#[derive(Clone, Copy)]
struct Found {
    face: u32,
    normal: Vec3,
    /// The point of an edge or a corner that is touched; none on a face.
    foot: Option<Vec3>,
}

impl Surface {
    /// Whether a point lies over a triangle, its edges included by `beside` (m). The sign beside an edge is computed from its
    /// ends in one order: neighbours in one plane share every point.
    #[inline(always)]
    pub(super) fn is_over(&self, face: &Face, x: Vec3, beside: f64) -> bool {
        let n = &self.flats[face.flat as usize].normal;
        let corners = face.corners;
        let turn = {
            let [a, b, c] = self.triangle(face);
            if dot(cross(sub(b, a), sub(c, a)), *n) < 0.0 { -1.0 } else { 1.0 }
        };
        (0..3).all(|i| {
            let (p, q) = (corners[i], corners[(i + 1) % 3]);
            let (low, high, sign) = if p < q { (p, q, turn) } else { (q, p, -turn) };
            let (a, b) = (self.corners[low as usize], self.corners[high as usize]);
            let e = sub(b, a);
            let inside = sign * dot(cross(*n, e), sub(x, a));
            inside >= -beside * (e[0].abs() + e[1].abs() + e[2].abs())
        })
    }
}

impl<'a> Sweep<'a> {
    pub fn new(mesh: &'a Mesh, path: &'a Path, reach: Reach) -> Self {
        Self { mesh, path, reach, best: f64::INFINITY, found: None, flat: MIXED, falls: Falls::NONE }
    }

    /// The first contact and its triangle's place in the list of faces.
    #[inline(always)]
    pub fn first(mut self) -> Option<(Meeting, u32)> {
        let whole = Piece::whole(self.path);
        let bend = norm(whole.bend());
        let fine = 0.5 * (self.reach.clearance + self.mesh.size);
        let mut halvings = 0;
        let mut rest = bend;
        while rest > fine && halvings < MOST_HALVINGS {
            // the bend of a half is a quarter
            rest *= 0.25;
            halvings += 1;
        }
        if halvings == 0 {
            self.visit(&whole);
        } else {
            let count = f64::from(1u32 << halvings);
            for i in 0..1u32 << halvings {
                let from = f64::from(i) / count;
                if self.best < from {
                    break;
                }
                self.visit(&Piece::of(self.path, from, f64::from(i + 1) / count));
            }
        }
        self.meeting()
    }

    /// Looks at all that a piece comes near.
    #[inline(always)]
    fn visit(&mut self, piece: &Piece) {
        let band = Band::new(piece, self.reach.clearance + self.reach.slack);
        let mut stack = ArrayVec::<(f64, Child), STACK>::new();
        stack.push((0.0, Child { first: 0, count: 0, flat: MIXED }));
        while let Some((enters, child)) = stack.pop() {
            if piece.theta(enters) > self.best {
                continue;
            }
            for i in child.first..child.first + child.count {
                self.look(i, piece);
            }
            if child.count > 0 {
                continue;
            }
            let Some(node) = self.mesh.tree.nodes.get(child.first as usize) else { continue };
            let enters = band.enters(node);
            let begin = stack.len();
            for (i, theta) in enters.iter().enumerate() {
                let child = node.children[i];
                if *theta <= 1.0 && (child.flat == MIXED || self.may_hold(child.flat, node, i)) {
                    // the nearest on top
                    let place = (begin..stack.len()).find(|s| stack[*s].0 < *theta).unwrap_or(stack.len());
                    stack.insert(place, (*theta, child));
                }
            }
        }
    }

    /// Works out what a plane does to the path.
    #[inline(always)]
    fn turn_to(&mut self, flat: u32) {
        if flat != self.flat {
            self.flat = flat;
            self.falls = Falls::new(&self.mesh.surface.flats[flat as usize], self.path, self.reach);
        }
    }

    /// Whether a child whose triangles all lie in one plane may have the contact: where the path meets the plane but once, it
    /// has if that point is in its box.
    #[inline(always)]
    fn may_hold(&mut self, flat: u32, node: &Node, child: usize) -> bool {
        self.turn_to(flat);
        let Falls { near, far, normal, is_clear, .. } = &self.falls;
        if *is_clear {
            return false;
        }
        if near.now || far.as_ref().is_some_and(|f| f.descents != Descents::None) {
            return true;
        }
        match near.descents {
            Descents::None => false,
            Descents::Many => true,
            Descents::One(theta) => {
                let foot = sub(near.at, scale(*normal, self.reach.clearance));
                let wide = |c: usize| self.reach.beside() + 1e-14 * foot[c].abs();
                theta < self.best
                    && (0..3)
                        .all(|c| foot[c] >= node.min[c][child] - wide(c) && foot[c] <= node.max[c][child] + wide(c))
            }
        }
    }

    /// Looks at one triangle.
    #[inline(always)]
    fn look(&mut self, index: u32, piece: &Piece) {
        let surface = &self.mesh.surface;
        let face = &surface.faces[index as usize];
        self.turn_to(face.flat);
        if self.falls.is_clear {
            return;
        }
        let beside = self.reach.beside();
        let over = |x: Vec3| surface.is_over(face, x, beside);
        let falls = &self.falls;
        let mut found = falls.near.first(self.best, self.path, over).map(|theta| (theta, falls.normal));
        if let Some(far) = &falls.far
            && let Some(theta) = far.first(self.best, self.path, over)
            && found.is_none_or(|(near, _)| theta < near)
        {
            found = Some((theta, scale(falls.normal, -1.0)));
        }
        if let Some((theta, normal)) = found
            && theta < self.best
        {
            self.best = theta;
            self.found = Some(Found { face: index, normal, foot: None });
        }
        if face.rim != 0 && self.falls.may_reach(face.rim, self.best) {
            self.look_at_rim(index, piece);
        }
    }

    /// Looks at the edges and corners that a triangle has to look after.
    #[inline(never)]
    fn look_at_rim(&mut self, index: u32, piece: &Piece) {
        let surface = &self.mesh.surface;
        let face = surface.faces[index as usize];
        let edges = (face.rim & 7).count_ones();
        for edge in face.first_edge..face.first_edge + edges {
            let edge = &surface.edges[edge as usize];
            let [a, b] = edge.ends.map(|c| surface.corners[c as usize]);
            let mut touch = |x: Vec3, foot: Vec3| {
                let leads_away = |c: &u32| {
                    let c = surface.corners[*c as usize];
                    rim::across(a, b, c)
                        .is_some_and(|u| dot(u, sub(x, foot)) < -self.reach.tilt() * self.reach.clearance)
                };
                let opposite = &surface.opposite[edge.opposite[0] as usize..edge.opposite[1] as usize];
                opposite.iter().all(leads_away) && !self.mesh.is_on_a_face(x, foot, self.reach)
            };
            let theta = rim::edge(a, b, piece, self.reach, &mut touch);
            self.take(theta, index, |x| {
                let e = sub(b, a);
                let s = (dot(e, sub(x, a)) / dot(e, e)).clamp(0.0, 1.0);
                [0, 1, 2].map(|c| a[c] + s * e[c])
            });
        }
        for (i, c) in face.corners.iter().enumerate() {
            if face.rim & (8 << i) != 0 {
                let at = surface.corners[*c as usize];
                let mut touch = |x: Vec3, foot: Vec3| {
                    let away = sub(x, foot);
                    let tilt = self.reach.tilt() * self.reach.clearance;
                    surface.fan(*c as usize).all(|d| dot(d, away) < -tilt)
                        && !self.mesh.is_on_a_face(x, foot, self.reach)
                };
                let theta = rim::corner(at, piece, self.reach, &mut touch);
                self.take(theta, index, |_| at);
            }
        }
    }

    fn take(&mut self, theta: Option<f64>, index: u32, foot: impl Fn(Vec3) -> Vec3) {
        let Some(theta) = theta.filter(|t| *t < self.best) else { return };
        let x = self.path.at(theta);
        let foot = foot(x);
        if let Some(normal) = unit(sub(x, foot)) {
            self.best = theta;
            self.found = Some(Found { face: index, normal, foot: Some(foot) });
        }
    }

    /// The contact, with the centre put exactly at the clearance.
    #[inline(always)]
    fn meeting(&self) -> Option<(Meeting, u32)> {
        let Found { face, normal, foot } = self.found?;
        let x = self.path.at(self.best);
        let surface = &self.mesh.surface;
        let distance = match foot {
            Some(foot) => dot(normal, sub(x, foot)),
            None => dot(normal, sub(x, surface.flats[surface.faces[face as usize].flat as usize].point)),
        };
        let off = distance - self.reach.clearance;
        // a sphere that starts deep in a wall is not thrown out of it
        let off = if off < -1e-3 * self.reach.clearance { 0.0 } else { off };
        Some((Meeting { theta: self.best, position: sub(x, scale(normal, off)), normal }, face))
    }
}

/// The band around the chord of a piece within which the piece stays, by a width.
struct Band {
    /// Starts on the near and far side of the band, axis by axis.
    low: Vec3,
    high: Vec3,
    over: Vec3,
}

impl Band {
    #[inline(always)]
    fn new(piece: &Piece, width: f64) -> Self {
        let (start, bend, chord) = (piece.path.start, piece.bend(), piece.path.points[4]);
        let mut band = Self { low: start, high: start, over: [0.0; 3] };
        for c in 0..3 {
            // with what the ends of the piece were rounded by
            let half = width + bend[c] + 1e-15 * (start[c].abs() + chord[c].abs());
            band.low[c] -= half;
            band.high[c] += half;
            let far = if chord[c].abs() > 1e-200 { chord[c] } else { 1e-200 };
            band.over[c] = 1.0 / far;
        }
        band
    }

    /// Where on the piece the band enters each box of a node; beyond 1 where it does not.
    #[inline(always)]
    fn enters(&self, node: &Node) -> [f64; 4] {
        let (mut first, mut last) = ([0.0; 4], [1.0; 4]);
        for c in 0..3 {
            for i in 0..4 {
                let a = (node.min[c][i] - self.high[c]) * self.over[c];
                let b = (node.max[c][i] - self.low[c]) * self.over[c];
                // an empty box is entered at infinity
                let (near, far) = if self.over[c] > 0.0 { (a, b) } else { (b, a) };
                first[i] = if near > first[i] { near } else { first[i] };
                last[i] = if far < last[i] { far } else { last[i] };
            }
        }
        let mut enters = [2.0; 4];
        for i in 0..4 {
            enters[i] = if first[i] <= last[i] { first[i] } else { 2.0 };
        }
        enters
    }
}
