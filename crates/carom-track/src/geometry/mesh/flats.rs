//! The flat parts of a triangulated wall.

use super::surface::{Face, Flat, Runs, Side, Surface, Words, neighbours};
use crate::vector::{Vec3, add, cross, dot, frame, norm, scale, sub, unit};
use rayon::prelude::*;
use std::collections::{HashMap, HashSet};
use std::hash::BuildHasherDefault;

impl Surface {
    /// The plane of a triangle alone.
    fn own_flat(&self, face: &Face) -> Flat {
        let [a, b, c] = self.triangle(face);
        // weld has left out what has no normal
        let normal = unit(cross(sub(b, a), sub(c, a))).unwrap_or([0.0, 0.0, 1.0]);
        Flat { point: a, normal }
    }

    /// Finds the planes: from the largest triangle on to all neighbours that lie in its plane.
    pub fn flatten(&mut self, sides: &[Side], precision: f64) {
        const NONE: u32 = u32::MAX;
        let neighbours = neighbours(self.faces.len(), sides);
        let area = |f: &Face| {
            let [a, b, c] = self.triangle(f);
            norm(cross(sub(b, a), sub(c, a)))
        };
        let mut order: Vec<(f64, u32)> = self.faces.par_iter().map(area).zip(0..self.faces.len() as u32).collect();
        order.par_sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut flats: Vec<Flat> = Vec::new();
        let mut of = vec![NONE; self.faces.len()];
        let mut many = Vec::new();
        for (_, seed) in order {
            if of[seed as usize] == NONE {
                let (flat, size) = self.grow(seed, flats.len() as u32, &neighbours, &mut of, precision);
                flats.push(flat);
                many.push(size > 1);
            }
        }
        self.faces.iter_mut().zip(of).for_each(|(f, flat)| f.flat = flat);
        self.settle(&mut flats, &mut many, precision);
        self.flats = flats;
    }

    /// Gives a triangle the plane of that number, and all those about it that lie in it. The plane of one triangle is told by
    /// its corners' rounding no better than over its own size: it is fitted again to all there are as they become more.
    fn grow(&self, seed: u32, number: u32, neighbours: &Runs, of: &mut [u32], precision: f64) -> (Flat, usize) {
        let mut fit = Fit::new(self.own_flat(&self.faces[seed as usize]));
        let mut flat = fit.first;
        self.triangle(&self.faces[seed as usize]).iter().for_each(|x| fit.add(*x));
        let mut members = vec![seed];
        of[seed as usize] = number;
        let (mut front, mut next) = (vec![seed], Vec::new());
        loop {
            let before = members.len();
            while let Some(face) = front.pop() {
                let mut refused = false;
                for other in neighbours.of(face) {
                    if of[*other as usize] != u32::MAX {
                        continue;
                    }
                    if self.lies_in(&flat, &self.faces[*other as usize], precision) {
                        of[*other as usize] = number;
                        members.push(*other);
                        front.push(*other);
                    } else {
                        refused = true;
                    }
                }
                if refused {
                    next.push(face);
                }
            }
            let new = members[before..].iter().flat_map(|f| self.triangle(&self.faces[*f as usize]));
            new.for_each(|x| fit.add(x));
            // flat to the last digit, or nothing more to learn
            if members.len() == before || fit.is_exact() {
                return (flat, members.len());
            }
            let fitted = fit.flat();
            let lies = |f: &u32| self.lies_in(&fitted, &self.faces[*f as usize], precision);
            if !members.iter().all(lies) {
                return (flat, members.len());
            }
            flat = fitted;
            std::mem::swap(&mut front, &mut next);
        }
    }

    fn lies_in(&self, flat: &Flat, face: &Face, precision: f64) -> bool {
        let near = self.triangle(face).iter().all(|x| flat.height(*x).abs() <= precision);
        // a sliver may lie in any plane through its length
        near && {
            let [a, b, c] = self.triangle(face);
            let area = cross(sub(b, a), sub(c, a));
            let reach = norm(sub(b, a)).max(norm(sub(c, a)));
            dot(area, flat.normal).abs() > 0.7 * norm(area) || norm(area) <= 4.0 * precision * reach
        }
    }

    /// Puts the corners of flat parts into their planes, where they are off by no more than the precision; triangles of which
    /// a corner cannot be put there get a plane of their own.
    fn settle(&mut self, flats: &mut Vec<Flat>, many: &mut Vec<bool>, precision: f64) {
        let mut of: Vec<Vec<u32>> = Vec::new();
        let mut planes: HashMap<u32, usize, BuildHasherDefault<Words>> = HashMap::default();
        for face in self.faces.iter().filter(|f| many[f.flat as usize]) {
            for corner in face.corners {
                let place = *planes.entry(corner).or_insert_with(|| {
                    of.push(Vec::new());
                    of.len() - 1
                });
                if !of[place].contains(&face.flat) {
                    of[place].push(face.flat);
                }
            }
        }
        let mut off: HashSet<u32, BuildHasherDefault<Words>> = HashSet::default();
        let mut moves: Vec<(u32, usize)> = planes.into_iter().collect();
        moves.sort_unstable();
        for (corner, place) in moves {
            let x = self.corners[corner as usize];
            let tiny = 1e-15 * x.iter().fold(0.0f64, |m, c| m.max(c.abs()));
            let planes: Vec<Flat> = of[place].iter().map(|f| flats[*f as usize]).collect();
            if planes.iter().all(|f| f.height(x).abs() <= tiny) {
                continue;
            }
            let moved = onto(x, &planes);
            let fits =
                planes.iter().all(|f| f.height(moved).abs() <= 4.0 * tiny) && norm(sub(moved, x)) <= 8.0 * precision;
            if fits {
                self.corners[corner as usize] = moved;
            } else {
                off.insert(corner);
            }
        }
        // planes of single triangles follow their corners
        for i in 0..self.faces.len() {
            let face = self.faces[i];
            if !many[face.flat as usize] {
                flats[face.flat as usize] = self.own_flat(&face);
            } else if face.corners.iter().any(|c| off.contains(c)) {
                self.faces[i].flat = flats.len() as u32;
                flats.push(self.own_flat(&face));
                many.push(false);
            }
        }
    }
}

/// The point nearest to `x` that lies in up to three planes.
fn onto(x: Vec3, planes: &[Flat]) -> Vec3 {
    // orthogonal directions of the planes' normals, each with how far to go along it
    let mut moved = x;
    for _ in 0..3 {
        let mut basis: Vec<Vec3> = Vec::new();
        let mut step = [0.0; 3];
        for p in planes.iter().take(3) {
            let rest = basis.iter().fold(p.normal, |n, b| sub(n, scale(*b, dot(*b, p.normal))));
            if let Some(b) = unit(rest).filter(|_| norm(rest) > 1e-3) {
                let far = (-p.height(moved) - dot(step, p.normal)) / dot(b, p.normal);
                step = add(step, scale(b, far));
                basis.push(b);
            }
        }
        moved = add(moved, step);
    }
    moved
}

/// A plane near that of the first three corners, fitted to more by least squares.
struct Fit {
    first: Flat,
    along: [Vec3; 2],
    /// Sums of 1, s, t, s², st, t² and of h, sh, th, where s, t are places along the plane and h heights over it.
    places: [f64; 6],
    heights: [f64; 3],
    highest: f64,
}

impl Fit {
    fn new(first: Flat) -> Self {
        let (t, b) = frame(first.normal);
        Self { first, along: [t, b], places: [0.0; 6], heights: [0.0; 3], highest: 0.0 }
    }

    fn add(&mut self, x: Vec3) {
        let r = sub(x, self.first.point);
        let (s, t, h) = (dot(r, self.along[0]), dot(r, self.along[1]), dot(r, self.first.normal));
        self.places.iter_mut().zip([1.0, s, t, s * s, s * t, t * t]).for_each(|(sum, v)| *sum += v);
        self.heights.iter_mut().zip([h, s * h, t * h]).for_each(|(sum, v)| *sum += v);
        let size = x.iter().fold(0.0f64, |m, c| m.max(c.abs()));
        self.highest = self.highest.max(h.abs() - 1e-15 * size);
    }

    /// Whether all lie in the first plane but for rounding in double precision.
    fn is_exact(&self) -> bool {
        self.highest <= 0.0
    }

    fn flat(&self) -> Flat {
        let ([n, s, t, ss, st, tt], [h, sh, th]) = (self.places, self.heights);
        // about the mean place
        let (ss, st, tt) = (ss - s * s / n, st - s * t / n, tt - t * t / n);
        let (sh, th) = (sh - s * h / n, th - t * h / n);
        let det = ss * tt - st * st;
        let slopes = [(sh * tt - th * st) / det, (th * ss - sh * st) / det];
        if !(det > 1e-12 * ss * tt && slopes.iter().all(|s| s.is_finite())) {
            return self.first;
        }
        let lean = add(scale(self.along[0], slopes[0]), scale(self.along[1], slopes[1]));
        let middle = add(scale(self.along[0], s / n), scale(self.along[1], t / n));
        let point = add(self.first.point, add(middle, scale(self.first.normal, h / n)));
        unit(sub(self.first.normal, lean)).map_or(self.first, |normal| Flat { point, normal })
    }
}
