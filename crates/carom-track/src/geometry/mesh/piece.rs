//! Pieces of a path, short enough to be nearly straight.

use super::super::Path;
use crate::vector::{Vec3, add, scale, sub};

/// A stretch of a path as a path of its own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub path: Path,
    /// Where on the whole path it begins and ends.
    pub from: f64,
    pub to: f64,
}

impl Piece {
    /// The whole of a path.
    #[inline(always)]
    pub fn whole(path: &Path) -> Self {
        Self { path: *path, from: 0.0, to: 1.0 }
    }

    /// The stretch from θ = `from` to `to` of a path.
    #[inline(always)]
    pub fn of(path: &Path, from: f64, to: f64) -> Self {
        if from == 0.0 && to == 1.0 {
            return Self::whole(path);
        }
        let (left, _) = split(&path.points, to);
        let part = from / to;
        let (before, right) = split(&left, part);
        let start = add(path.start, before[4]);
        Self { path: Path { start, points: right }, from, to }
    }

    /// Its place on the whole path.
    #[inline(always)]
    pub fn theta(&self, theta: f64) -> f64 {
        self.from + theta * (self.to - self.from)
    }

    /// The two halves.
    pub fn halves(&self) -> (Self, Self) {
        let middle = 0.5 * (self.from + self.to);
        let (left, right) = split(&self.path.points, 0.5);
        let second = Path { start: add(self.path.start, left[4]), points: right };
        let first = Path { points: left, ..self.path };
        (Self { path: first, to: middle, ..*self }, Self { path: second, from: middle, ..*self })
    }

    /// How far it strays from uniform motion along its chord, component by component, m.
    #[inline(always)]
    pub fn bend(&self) -> Vec3 {
        let end = self.path.points[4];
        let mut bend = [0.0; 3];
        for (i, p) in self.path.points.iter().take(4).enumerate() {
            for c in 0..3 {
                let off = (p[c] - 0.2 * (i + 1) as f64 * end[c]).abs();
                bend[c] = if off > bend[c] { off } else { bend[c] };
            }
        }
        bend
    }
}

/// De Casteljau's division at θ: control points 1 to 5 of both parts, each relative to its own start.
#[inline(always)]
fn split(points: &[Vec3; 5], theta: f64) -> ([Vec3; 5], [Vec3; 5]) {
    let mut c = [[0.0; 3], points[0], points[1], points[2], points[3], points[4]];
    let (mut left, mut right) = ([[0.0; 3]; 5], [points[4]; 5]);
    for top in (1..6).rev() {
        for i in 0..top {
            c[i] = add(c[i], scale(sub(c[i + 1], c[i]), theta));
        }
        left[5 - top] = c[0];
        if top > 1 {
            right[top - 2] = c[top - 1];
        }
    }
    let start = left[4];
    (left, right.map(|p| sub(p, start)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::norm;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn pieces_are_the_path(
            start in prop::array::uniform3(-1.0f64..1.0), points in prop::array::uniform5(prop::array::uniform3(-1.0f64..1.0)),
            ends in prop::array::uniform2(0.0f64..1.0), at in 0.0f64..1.0,
        ) {
            let path = Path { start, points };
            let (from, to) = (ends[0].min(ends[1]), ends[0].max(ends[1]).max(1e-3));
            let piece = Piece::of(&path, from, to);
            let (first, second) = piece.halves();
            for p in [piece, first, second] {
                prop_assert!(norm(sub(p.path.at(at), path.at(p.theta(at)))) < 1e-14);
                let straight = add(p.path.start, scale(p.path.points[4], at));
                let off = sub(p.path.at(at), straight);
                prop_assert!((0..3).all(|c| off[c].abs() <= p.bend()[c] + 1e-15));
            }
        }
    }
}
