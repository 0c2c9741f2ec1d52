//! The tetrahedra of `W` spheres, component by component: what is asked of them at each step is answered side by side.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::Tetrahedron;
use crate::geometry::single_descents;
use crate::integrate::{Lanes, Lanes3};
use crate::lanes::{Mask, choose, mask};
use crate::vector::Vec3;
use std::fmt;

/// A [`Tetrahedron`] each.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Tetrahedra<const W: usize> {
    pub(super) origin: Lanes3<W>,
    pub(super) dual: [Lanes3<W>; 3],
    pub(super) velocity: Lanes3<W>,
    pub(super) gradient: [Lanes3<W>; 3],
    pub(crate) clear: Lanes<W>,
    pub(crate) id: [u32; W],
    pub(crate) cell: [u32; W],
}

impl<const W: usize> fmt::Debug for Tetrahedra<W> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "tetrahedra {:?}", self.id)
    }
}

impl<const W: usize> crate::domain::Pieces<Tetrahedron> for Tetrahedra<W> {
    #[inline(always)]
    fn all(one: Tetrahedron) -> Self {
        let spread = |v: Vec3| v.map(|c| [c; W]);
        Self {
            origin: spread(one.origin),
            dual: one.dual.map(spread),
            velocity: spread(one.velocity),
            gradient: one.gradient.map(spread),
            clear: [one.clear; W],
            id: [one.id; W],
            cell: [one.cell; W],
        }
    }

    #[inline(always)]
    fn get(&self, l: usize) -> Tetrahedron {
        let column = |v: &Lanes3<W>| [v[0][l], v[1][l], v[2][l]];
        Tetrahedron {
            origin: column(&self.origin),
            dual: self.dual.each_ref().map(column),
            velocity: column(&self.velocity),
            gradient: self.gradient.each_ref().map(column),
            clear: self.clear[l],
            id: self.id[l],
            cell: self.cell[l],
        }
    }

    #[inline(always)]
    fn set(&mut self, l: usize, one: Tetrahedron) {
        for c in 0..3 {
            self.origin[c][l] = one.origin[c];
            self.velocity[c][l] = one.velocity[c];
            for i in 0..3 {
                self.dual[i][c][l] = one.dual[i][c];
                self.gradient[i][c][l] = one.gradient[i][c];
            }
        }
        (self.clear[l], self.id[l], self.cell[l]) = (one.clear, one.id, one.cell);
    }
}

/// Which paths stay in their tetrahedra, and where others leave.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Leaving<const W: usize> {
    /// Surely stays.
    pub stays: Mask<W>,
    /// Surely leaves, by which side and where: sides are numbered as the corners they face, the centre's last.
    pub leaves: Mask<W>,
    pub side: [u64; W],
    pub theta: Lanes<W>,
    /// How far the path has come there, and how that changes with θ, m.
    pub way: Lanes3<W>,
    pub slope: Lanes3<W>,
}

/// A λ this near to zero may be rounding: whether such a sphere gets on is for the look lane by lane.
const NEAR: f64 = 1e-6;

impl<const W: usize> Tetrahedra<W> {
    /// Takes those of some lanes from another.
    #[inline(always)]
    pub(crate) fn take(&mut self, other: &Self, lanes: &Mask<W>) {
        for c in 0..3 {
            choose(&mut self.origin[c], &other.origin[c], lanes);
            choose(&mut self.velocity[c], &other.velocity[c], lanes);
            for i in 0..3 {
                choose(&mut self.dual[i][c], &other.dual[i][c], lanes);
                choose(&mut self.gradient[i][c], &other.gradient[i][c], lanes);
            }
        }
        choose(&mut self.clear, &other.clear, lanes);
        for l in 0..W {
            self.id[l] = if lanes[l] != 0 { other.id[l] } else { self.id[l] };
            self.cell[l] = if lanes[l] != 0 { other.cell[l] } else { self.cell[l] };
        }
    }

    /// u(x), m/s.
    #[inline(always)]
    pub(crate) fn velocities(&self, x: &Lanes3<W>) -> Lanes3<W> {
        let y = self.relative(x);
        let mut out = self.velocity;
        for i in 0..3 {
            for c in 0..3 {
                for l in 0..W {
                    out[i][l] = self.gradient[i][c][l].mul_add(y[c][l], out[i][l]);
                }
            }
        }
        out
    }

    /// Places relative to the cells' centres, m.
    #[inline(always)]
    fn relative(&self, x: &Lanes3<W>) -> Lanes3<W> {
        let mut y = [[0.0; W]; 3];
        for c in 0..3 {
            for l in 0..W {
                y[c][l] = x[c][l] - self.origin[c][l];
            }
        }
        y
    }

    /// How λ₁, λ₂, λ₃ change along displacements, and λ₀.
    #[inline(always)]
    fn changes(&self, way: &Lanes3<W>) -> [Lanes<W>; 4] {
        let mut out = [[0.0; W]; 4];
        for i in 0..3 {
            let d = &self.dual[i];
            for l in 0..W {
                out[i][l] = d[2][l].mul_add(way[2][l], d[1][l].mul_add(way[1][l], d[0][l] * way[0][l]));
            }
        }
        for l in 0..W {
            out[3][l] = -(out[0][l] + out[1][l] + out[2][l]);
        }
        out
    }

    /// λ₁, λ₂, λ₃ and λ₀ of places.
    #[inline(always)]
    fn coordinates(&self, x: &Lanes3<W>) -> [Lanes<W>; 4] {
        let mut at = self.changes(&self.relative(x));
        for l in 0..W {
            at[3][l] += 1.0;
        }
        at
    }

    /// How soon straight paths leave, s; infinite where one does not.
    #[inline(always)]
    pub(crate) fn soonest(&self, x: &Lanes3<W>, v: &Lanes3<W>) -> Lanes<W> {
        let (at, rate) = (self.coordinates(x), self.changes(v));
        let mut soonest = [f64::INFINITY; W];
        for side in 0..4 {
            for l in 0..W {
                let time = -at[side][l] / rate[side][l];
                let counts = (rate[side][l] < 0.0) & (time > 0.0) & (time < soonest[l]);
                soonest[l] = if counts { time } else { soonest[l] };
            }
        }
        soonest
    }

    /// Which paths (starts and control points 1 to 5 relative to them) of spheres of these radii surely come near no wall.
    #[inline(always)]
    pub(crate) fn are_clear(&self, start: &Lanes3<W>, path: &[Lanes3<W>; 5], radius: &Lanes<W>) -> Mask<W> {
        let y = self.relative(start);
        let mut most = [0.0; W];
        for l in 0..W {
            most[l] = y[2][l].mul_add(y[2][l], y[1][l].mul_add(y[1][l], y[0][l] * y[0][l]));
        }
        for p in path {
            for l in 0..W {
                let at = [y[0][l] + p[0][l], y[1][l] + p[1][l], y[2][l] + p[2][l]];
                let square = at[2].mul_add(at[2], at[1].mul_add(at[1], at[0] * at[0]));
                most[l] = if square < most[l] { most[l] } else { square };
            }
        }
        let mut clear = [0; W];
        for l in 0..W {
            let free = self.clear[l] - radius[l];
            clear[l] = mask(free > 0.0) & mask(most[l] < free * free);
        }
        clear
    }

    /// Where paths leave, in the plain cases: a sphere that is inside, of whose λ each either stays above zero or falls all the way.
    #[inline(always)]
    pub(crate) fn leave(&self, start: &Lanes3<W>, path: &[Lanes3<W>; 5]) -> Leaving<W> {
        let at = self.coordinates(start);
        let (mut least, mut rise, mut last) = ([[f64::INFINITY; W]; 4], [[f64::NEG_INFINITY; W]; 4], [[0.0; W]; 4]);
        for p in path {
            let change = self.changes(p);
            for side in 0..4 {
                fall(&change[side], &mut least[side], &mut rise[side], &mut last[side]);
            }
        }
        let (mut none, mut once) = ([[0; W]; 4], [[0; W]; 4]);
        let (mut stays, mut plain, mut leaves) = ([u64::MAX; W], [u64::MAX; W], [0; W]);
        for side in 0..4 {
            for l in 0..W {
                let (at, end) = (at[side][l], at[side][l] + last[side][l]);
                none[side][l] = mask(at + least[side][l] > 0.0) & mask(end > 0.0);
                once[side][l] = mask(at > NEAR) & mask(end < 0.0) & mask(rise[side][l] < 0.0);
                stays[l] &= none[side][l];
                plain[l] &= none[side][l] | once[side][l];
                leaves[l] |= once[side][l];
            }
        }
        for l in 0..W {
            plain[l] &= leaves[l];
        }
        let side = sooner(&at, &last, &once);
        let along = self.coefficients(&at, path, &side);
        let theta = single_descents(&along, &mut plain);
        let (way, slope) = reach(path, &theta);
        // on the way there no other side may have been gone through: the two corners on one column of a plane case have the same λ
        let change = self.changes(&way);
        let mut value = [[0.0; W]; 4];
        for s in 0..4 {
            for l in 0..W {
                value[s][l] = at[s][l] + change[s][l];
            }
        }
        let mut root = value[0];
        for s in 1..4 {
            choose(&mut root, &value[s], &is(&side, s));
        }
        for s in 0..4 {
            for l in 0..W {
                plain[l] &= none[s][l] | mask(value[s][l] > 0.0) | mask(value[s][l] >= root[l]);
            }
        }
        Leaving { stays, leaves: plain, side, theta, way, slope }
    }

    /// Bernstein coefficients of a side's λ along paths, from λ at the starts.
    #[inline(always)]
    fn coefficients(&self, at: &[Lanes<W>; 4], path: &[Lanes3<W>; 5], side: &[u64; W]) -> [Lanes<W>; 6] {
        let (mut normal, mut from) = (self.dual[0], at[0]);
        for s in 1..4 {
            let is = is(side, s);
            for c in 0..3 {
                let mut d = [0.0; W];
                for l in 0..W {
                    d[l] = if s < 3 {
                        self.dual[s][c][l]
                    } else {
                        -(self.dual[0][c][l] + self.dual[1][c][l] + self.dual[2][c][l])
                    };
                }
                choose(&mut normal[c], &d, &is);
            }
            choose(&mut from, &at[s], &is);
        }
        let mut b = [from; 6];
        for k in 0..5 {
            let p = &path[k];
            for l in 0..W {
                let change = normal[1][l].mul_add(p[1][l], normal[0][l] * p[0][l]);
                b[k + 1][l] += normal[2][l].mul_add(p[2][l], change);
            }
        }
        b
    }
}

/// The least of some numbers so far, and the most that one was above the one before, with the next.
#[inline(always)]
fn fall<const W: usize>(new: &Lanes<W>, least: &mut Lanes<W>, rise: &mut Lanes<W>, last: &mut Lanes<W>) {
    let mut up = [0.0; W];
    for l in 0..W {
        up[l] = new[l] - last[l];
    }
    for l in 0..W {
        least[l] = if new[l] < least[l] { new[l] } else { least[l] };
    }
    for l in 0..W {
        rise[l] = if up[l] > rise[l] { up[l] } else { rise[l] };
    }
    *last = *new;
}

/// Which lanes have a side.
#[inline(always)]
fn is<const W: usize>(side: &[u64; W], s: usize) -> Mask<W> {
    let mut is = [0; W];
    for l in 0..W {
        is[l] = mask(side[l] == s as u64);
    }
    is
}

/// Of the sides whose λ, `at` the start, falls through zero by `last`, the one it would come to first if it fell evenly.
#[inline(always)]
fn sooner<const W: usize>(at: &[Lanes<W>; 4], last: &[Lanes<W>; 4], once: &[Mask<W>; 4]) -> [u64; W] {
    let (mut side, mut known, mut from, mut by) = ([0; W], once[0], at[0], last[0]);
    for s in 1..4 {
        let mut sooner = [0; W];
        for l in 0..W {
            sooner[l] = once[s][l] & (!known[l] | mask(at[s][l] * by[l] > from[l] * last[s][l]));
            known[l] |= sooner[l];
            side[l] = (s as u64 & sooner[l]) | (side[l] & !sooner[l]);
        }
        choose(&mut from, &at[s], &sooner);
        choose(&mut by, &last[s], &sooner);
    }
    side
}

/// How far paths have come at θ, and how that changes with θ, m (de Casteljau).
#[inline(always)]
fn reach<const W: usize>(path: &[Lanes3<W>; 5], theta: &Lanes<W>) -> (Lanes3<W>, Lanes3<W>) {
    let (mut way, mut slope) = ([[0.0; W]; 3], [[0.0; W]; 3]);
    for c in 0..3 {
        for l in 0..W {
            let mut x = [0.0, path[0][c][l], path[1][c][l], path[2][c][l], path[3][c][l], path[4][c][l]];
            for top in (2..6).rev() {
                for i in 0..top {
                    x[i] = theta[l].mul_add(x[i + 1] - x[i], x[i]);
                }
            }
            way[c][l] = theta[l].mul_add(x[1] - x[0], x[0]);
            slope[c][l] = 5.0 * (x[1] - x[0]);
        }
    }
    (way, slope)
}

#[cfg(test)]
mod tests {
    use super::super::Cells;
    use super::super::tests::{Dice, shaken, with_velocity};
    use super::*;
    use crate::domain::Pieces;
    use crate::geometry::Path;
    use crate::vector::{add, dot, norm, sub};
    use carom_cfd::block::Kind;

    fn lanes(v: Vec3) -> Lanes3<1> {
        v.map(|c| [c])
    }

    #[test]
    fn what_is_settled_side_by_side_is_what_each_tetrahedron_says() {
        let mut dice = Dice::new(17);
        let (mut stay, mut leave, mut all) = (0, 0, 0);
        for kind in Kind::ALL {
            let cells = Cells::new(&with_velocity(shaken(kind, [4, 3, 2], 0.3, 5), |x| x)).unwrap();
            for _ in 0..400 {
                let x = dice.point();
                let here = cells.find(x);
                if here.is_nowhere() {
                    continue;
                }
                let size = dice.roll();
                let change = dice.point().map(|c| size * size * (c - 0.5));
                let bend = |p| add(p, dice.point().map(|c| 0.02 * size * size * (c - 0.5)));
                let bent = Path::straight(x, change).points.map(bend);
                let path = Path { start: x, points: bent };
                let got = Tetrahedra::<1>::all(here).leave(&lanes(x), &path.points.map(lanes));
                let want = here.exit(&path);
                all += 1;
                if got.stays[0] != 0 {
                    stay += 1;
                    assert!(want.is_none());
                }
                if got.leaves[0] != 0 {
                    leave += 1;
                    let (theta, side) = want.unwrap();
                    assert!((got.theta[0] - theta).abs() < 1e-13, "{} {theta}", got.theta[0]);
                    assert_eq!(got.side[0] as usize, side);
                    let way = got.way.map(|c| c[0]);
                    assert!(norm(sub(add(x, way), path.at(theta))) < 1e-14);
                    let slope = got.slope.map(|c| c[0]);
                    assert!(norm(sub(slope, path.slope(theta))) < 1e-12);
                }
            }
        }
        assert!(stay > 200 && leave > 500 && stay + leave > all * 9 / 10, "{stay} and {leave} of {all}");
    }

    #[test]
    fn what_is_asked_side_by_side_is_what_is_asked_of_one() {
        let cells =
            Cells::new(&with_velocity(shaken(Kind::Polyhedra, [3, 3, 2], 0.3, 6), |x| [x[1], x[2], x[0]])).unwrap();
        let mut dice = Dice::new(4);
        for _ in 0..200 {
            let (x, v) = (dice.point(), dice.point().map(|c| c - 0.5));
            let here = cells.find(x);
            let one = Tetrahedra::<1>::all(here);
            let u = one.velocities(&lanes(x)).map(|c| c[0]);
            assert!(norm(sub(u, here.velocity_at(x))) < 1e-14);
            let (got, want) = (one.soonest(&lanes(x), &lanes(v))[0], here.soonest(x, v));
            assert!(got == want || (got - want).abs() < 1e-12 * want, "{got} {want}");
            // the corners' coordinates are 1 and 0
            let ([a, b, c], centre) = cells.corners(here.id, here.cell);
            for (i, node) in [a, b, c, centre].into_iter().enumerate() {
                let at = here.coordinates(cells.nodes[node].place);
                assert!((0..4).all(|j| (at[j] - f64::from(u8::from(i == j))).abs() < 1e-12), "{at:?}");
                let u = here.velocity_at(cells.nodes[node].place);
                assert!(dot(sub(u, cells.nodes[node].velocity), [1.0; 3]).abs() < 1e-12);
            }
        }
    }
}
