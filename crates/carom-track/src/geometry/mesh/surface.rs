//! What triangles make together: common corners, flat parts, and the edges and corners that stick out.
//!
//! Corners are the same where their coordinates are. Neighbours in one plane (to what the file's digits tell) share that
//! plane to the last bit, so that a flat wall is flat whatever its triangles. An edge can be touched only from directions that
//! lead away from all its triangles, a corner only from those that lead away from all its edges: where there are none, it is
//! not kept, so the seams of a flat wall and concave edges never act.

use super::Triangle;
use super::rim;
use crate::vector::{Vec3, add, cross, dot, scale, sub, unit};
use rayon::prelude::*;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A plane of one triangle or of many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flat {
    pub point: Vec3,
    pub normal: Vec3,
}

impl Flat {
    #[inline(always)]
    pub fn height(&self, x: Vec3) -> f64 {
        dot(self.normal, sub(x, self.point))
    }
}

/// A triangle by its corners' numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Face {
    pub corners: [u32; 3],
    /// Its plane.
    pub flat: u32,
    /// Where it was in the list given.
    pub number: u32,
    /// As many of bits 0 to 2 as it has edges to look after; bits 3 to 5: corners; bits 6 and 7: whether one of these can be
    /// touched from the side that the plane's normal points to, and from the other.
    pub rim: u32,
    /// Its first edge in the list of edges.
    pub first_edge: u32,
}

/// An edge that sticks out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    pub ends: [u32; 2],
    /// The corners opposite to it of its triangles: a run in a list.
    pub opposite: [u32; 2],
}

/// Triangles with common corners.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Surface {
    pub corners: Vec<Vec3>,
    pub faces: Vec<Face>,
    pub flats: Vec<Flat>,
    pub edges: Vec<Edge>,
    /// Corners opposite to edges, edge by edge.
    pub opposite: Vec<u32>,
    /// Corners at the other ends of all edges of a corner at which one sticks out: where each corner's run begins, and the runs.
    pub fans: (Vec<u32>, Vec<u32>),
    /// Triangles that were left out: without area, or with a corner that is not finite.
    pub left_out: usize,
}

/// FNV over words, folded: corners are many and come in runs.
#[derive(Default)]
pub(super) struct Words(u64);

impl Hasher for Words {
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 29)
    }
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|b| self.write_u64(u64::from(*b)));
    }
    fn write_u64(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(23) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
    fn write_usize(&mut self, word: usize) {
        self.write_u64(word as u64);
    }
}

/// A triangle's side: the numbers of its ends, the lower first, its triangle and the corner opposite.
#[derive(Clone, Copy)]
pub(super) struct Side {
    pub ends: (u32, u32),
    pub face: u32,
    pub opposite: u32,
}

impl Surface {
    /// Of triangles whose corners are right to a length `precision` (m), and the sides for [`Surface::arrange`].
    pub fn new(triangles: &[Triangle], precision: f64) -> (Self, Vec<Side>) {
        let mut surface = Self::default();
        surface.weld(triangles);
        let sides = surface.sides();
        surface.flatten(&sides, precision);
        (surface, sides)
    }

    /// Numbers the corners; leaves out triangles without area.
    fn weld(&mut self, triangles: &[Triangle]) {
        let mut numbers: HashMap<[u64; 3], u32, BuildHasherDefault<Words>> = HashMap::default();
        numbers.reserve(triangles.len() / 2);
        self.faces.reserve(triangles.len());
        for (number, t) in triangles.iter().enumerate() {
            let area = cross(sub(t[1], t[0]), sub(t[2], t[0]));
            if unit(area).is_none() {
                self.left_out += 1;
                continue;
            }
            let corners = t.map(|x| {
                // no zero below zero
                let x = x.map(|c| c + 0.0);
                *numbers.entry(x.map(f64::to_bits)).or_insert_with(|| {
                    self.corners.push(x);
                    self.corners.len() as u32 - 1
                })
            });
            self.faces.push(Face { corners, flat: 0, number: number as u32, rim: 0, first_edge: 0 });
        }
    }

    /// The sides of all triangles, those with the same ends together.
    fn sides(&self) -> Vec<Side> {
        let side = |face: usize, f: &Face, i: usize| {
            let (a, b) = (f.corners[i], f.corners[(i + 1) % 3]);
            Side { ends: (a.min(b), a.max(b)), face: face as u32, opposite: f.corners[(i + 2) % 3] }
        };
        let mut sides: Vec<Side> =
            self.faces.par_iter().enumerate().flat_map_iter(|(n, f)| [0, 1, 2].map(|i| side(n, f, i))).collect();
        sides.par_sort_unstable_by_key(|s| (s.ends, s.face));
        sides
    }

    pub fn triangle(&self, face: &Face) -> Triangle {
        face.corners.map(|c| self.corners[c as usize])
    }

    /// Puts the triangles into another order, and gives each the edges and corners that it is the first to have and that
    /// stick out.
    pub fn arrange(&mut self, mut sides: Vec<Side>, order: &[u32]) {
        let mut place = vec![0; order.len()];
        order.iter().zip(0..).for_each(|(old, new)| place[*old as usize] = new);
        self.faces = order.iter().map(|i| self.faces[*i as usize]).collect();
        sides.par_iter_mut().for_each(|s| s.face = place[s.face as usize]);
        sides.chunk_by_mut(|a, b| a.ends == b.ends).for_each(|g| g.sort_unstable_by_key(|s| s.face));
        let groups: Vec<&[Side]> = sides.chunk_by(|a, b| a.ends == b.ends).collect();
        let mut edges: Vec<(&[Side], u32)> =
            groups.par_iter().filter_map(|g| Some((*g, self.edge_sticks_out(g)?))).collect();
        edges.par_sort_unstable_by_key(|(g, _)| (g[0].face, g[0].ends));
        let mut candidates = vec![false; self.corners.len()];
        for (group, sides) in edges {
            let ends = [group[0].ends.0, group[0].ends.1];
            ends.iter().for_each(|c| candidates[*c as usize] = true);
            let first = self.opposite.len() as u32;
            self.opposite.extend(group.iter().map(|s| s.opposite));
            let owner = &mut self.faces[group[0].face as usize];
            if owner.rim & 7 == 0 {
                owner.first_edge = self.edges.len() as u32;
            }
            // their number is what matters
            owner.rim = (owner.rim & !7) | ((owner.rim & 7) << 1) | 1 | sides;
            self.edges.push(Edge { ends, opposite: [first, self.opposite.len() as u32] });
        }
        self.fans = fans(&candidates, &groups);
        self.keep_corners(&candidates);
    }

    /// Gives each corner that sticks out to the first triangle that has it.
    fn keep_corners(&mut self, candidates: &[bool]) {
        let out = candidates.par_iter().enumerate().map(|(c, may)| if *may { self.corner_sticks_out(c) } else { None });
        let mut out: Vec<Option<Vec<Vec3>>> = out.collect();
        for face in &mut self.faces {
            for (i, c) in face.corners.iter().enumerate() {
                if let Some(ways) = out[*c as usize].take() {
                    face.rim |= (8 << i) | sides(self.flats[face.flat as usize].normal, &ways);
                }
            }
        }
    }

    /// Directions from a corner along its edges.
    pub fn fan(&self, corner: usize) -> impl Iterator<Item = Vec3> {
        let run = self.fans.0[corner] as usize..self.fans.0[corner + 1] as usize;
        self.fans.1[run].iter().filter_map(move |c| unit(sub(self.corners[*c as usize], self.corners[corner])))
    }

    /// Whether there are directions across an edge that lead away from all its triangles, and then the sides of the first
    /// triangle that they are on.
    fn edge_sticks_out(&self, group: &[Side]) -> Option<u32> {
        let [a, b] = [group[0].ends.0, group[0].ends.1].map(|c| self.corners[c as usize]);
        let flat = |s: &Side| self.faces[s.face as usize].flat;
        let ways: Vec<Vec3> =
            group.iter().filter_map(|s| rim::across(a, b, self.corners[s.opposite as usize])).collect();
        let first = *ways.first()?;
        let two = if let [_, second] = ways.as_slice() { Some(*second) } else { None };
        if let ([one, other], Some(second)) = (group, two)
            && flat(one) == flat(other)
            && dot(first, second) < 0.0
        {
            return None;
        }
        // the widest angle between neighbouring directions must exceed half a turn
        let normal = cross(unit(sub(b, a))?, first);
        let mut angles: Vec<f64> = ways.iter().map(|u| quarters(dot(*u, first), dot(*u, normal))).collect();
        angles.sort_by(f64::total_cmp);
        let wrapped = angles[0] + 4.0 - angles[angles.len() - 1];
        let widest = angles.windows(2).map(|w| w[1] - w[0]).fold(wrapped, f64::max);
        if widest <= 2.0 + 1e-9 {
            return None;
        }
        // with a right or obtuse angle between two triangles all directions away are on one side of the first
        let one_side = two.filter(|second| dot(first, *second) < 1e-12);
        Some(one_side.map_or(BOTH, |second| sides(self.flats[flat(&group[0]) as usize].normal, &[scale(second, -1.0)])))
    }

    /// The outermost directions that lead away from all edges of a corner; none if there is no such direction inside of them.
    fn corner_sticks_out(&self, corner: usize) -> Option<Vec<Vec3>> {
        let fan: Vec<Vec3> = self.fan(corner).collect();
        if fan.len() < 3 || fan.len() > 16 {
            // two directions leave a half plane to either side; many take long to tell
            return Some(vec![[0.0; 3]]);
        }
        // on a crease or a border that runs straight through
        if fan.iter().any(|d| fan.iter().any(|e| dot(*d, *e) < -1.0 + 1e-14)) {
            return None;
        }
        let mut ways = Vec::new();
        for (i, d) in fan.iter().enumerate() {
            for e in &fan[..i] {
                let Some(way) = unit(cross(*d, *e)) else { continue };
                let leads_away = |w: &Vec3| fan.iter().all(|d| dot(*d, *w) <= 1e-12);
                ways.extend([way, scale(way, -1.0)].into_iter().filter(leads_away));
            }
        }
        let middle = ways.iter().fold([0.0; 3], |sum, w| add(sum, *w));
        fan.iter().all(|d| dot(*d, middle) < -1e-9).then_some(ways)
    }
}

/// Where a direction points, from 0 to 4 once round: opposite ones are 2 apart.
fn quarters(x: f64, y: f64) -> f64 {
    let share = y / (x.abs() + y.abs());
    match (x >= 0.0, y >= 0.0) {
        (true, true) => share,
        (false, _) => 2.0 - share,
        (true, false) => 4.0 + share,
    }
}

/// Both sides of a plane.
const BOTH: u32 = 3 << 6;

/// The sides of a plane that directions are on; none of the plane's own counts for both.
fn sides(normal: Vec3, ways: &[Vec3]) -> u32 {
    let (up, down) = (ways.iter().any(|w| dot(*w, normal) > 1e-9), ways.iter().any(|w| dot(*w, normal) < -1e-9));
    match (up, down) {
        (true, false) => 1 << 6,
        (false, true) => 2 << 6,
        _ => BOTH,
    }
}

/// Numbers in runs.
pub(super) struct Runs(Vec<u32>, Vec<u32>);

impl Runs {
    pub fn of(&self, i: u32) -> &[u32] {
        &self.1[self.0[i as usize] as usize..self.0[i as usize + 1] as usize]
    }
}

/// For each triangle the others at its sides.
pub(super) fn neighbours(faces: usize, sides: &[Side]) -> Runs {
    let pairs = || {
        let groups = sides.chunk_by(|a, b| a.ends == b.ends);
        groups.flat_map(|g| {
            // where very many meet, each with the next is enough
            let all = if g.len() <= 8 { g.len() } else { 1 };
            let pairs =
                (0..g.len()).flat_map(move |i| (i + 1..g.len().min(i + 1 + all)).map(move |j| (g[i].face, g[j].face)));
            pairs.flat_map(|(a, b)| [(a, b), (b, a)])
        })
    };
    let (starts, list) = runs(faces, pairs);
    Runs(starts, list)
}

/// For each corner that counts the others that an edge leads to.
fn fans(counts: &[bool], groups: &[&[Side]]) -> (Vec<u32>, Vec<u32>) {
    let pairs = || {
        let both = groups.iter().flat_map(|g| [g[0].ends, (g[0].ends.1, g[0].ends.0)]);
        both.filter(|(a, _)| counts[*a as usize])
    };
    runs(counts.len(), pairs)
}

/// Pairs sorted by their first: where the seconds of each begin, and the seconds.
fn runs<I: Iterator<Item = (u32, u32)>>(firsts: usize, pairs: impl Fn() -> I) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0u32; firsts + 1];
    pairs().for_each(|(a, _)| starts[a as usize + 1] += 1);
    for i in 0..firsts {
        starts[i + 1] += starts[i];
    }
    let mut next = starts.clone();
    let mut seconds = vec![0; starts[firsts] as usize];
    pairs().for_each(|(a, b)| {
        seconds[next[a as usize] as usize] = b;
        next[a as usize] += 1;
    });
    (starts, seconds)
}
