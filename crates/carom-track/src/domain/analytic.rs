//! An analytic flow or a table, with walls.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::{BEYOND, Domain, Edges, Next};
use crate::flow::{Exit, Flow, Local, Piece};
use crate::geometry::{Ahead, Path, Wall, Walls};
use crate::integrate::{Lanes, Lanes3};
use crate::lanes::{Mask, mask};
use crate::vector::{Vec3, dot, norm};

/// Of what a step may span, what it tries.
const WITHIN: f64 = 0.9;

/// An analytic flow or a table, with walls.
#[derive(Debug)]
pub struct Analytic {
    flow: Flow,
    walls: Walls,
}

impl Analytic {
    /// A flow and its walls.
    pub fn new(flow: Flow, walls: Vec<Wall>) -> Self {
        Self { flow, walls: Walls::new(walls) }
    }

    pub(super) fn with_openings(self, open: Vec<bool>) -> Self {
        Self { walls: self.walls.with_openings(open), ..self }
    }
}

impl Domain for Analytic {
    type Here = Piece;
    type Many<const W: usize> = [Piece; W];
    const NOWHERE: Piece = Piece([0; 3]);

    #[inline(always)]
    fn enter(&self, _time: f64, x: Vec3) -> Piece {
        self.flow.piece(x)
    }

    #[inline(always)]
    fn fluid(&self, here: Piece, _time: f64, x: Vec3) -> Local {
        self.flow.sample_in(here, x)
    }

    #[inline(always)]
    fn velocities<const W: usize>(&self, here: &[Piece; W], _time: &Lanes<W>, x: &Lanes3<W>) -> Lanes3<W> {
        self.flow.velocities(here, x)
    }

    #[inline(always)]
    fn is_uniform(&self) -> bool {
        matches!(self.flow, Flow::Still | Flow::Uniform { .. })
    }

    #[inline(always)]
    fn varies_gas(&self) -> bool {
        self.flow.varies_gas()
    }

    #[inline(always)]
    fn is_one_piece(&self) -> bool {
        self.flow.is_one_piece()
    }

    fn is_beyond(&self, here: Piece) -> bool {
        matches!(&self.flow, Flow::Table(table) if table.is_outside(here))
    }

    #[inline]
    fn longest(&self, here: Piece, x: Vec3, v: Vec3) -> f64 {
        let end = BEYOND * self.flow.soonest(here, x, v);
        let reach = self.flow.reach(here, x);
        if reach < f64::INFINITY { end.min(WITHIN * reach / norm(v)) } else { end }
    }

    fn room(&self, here: Piece, x: Vec3) -> f64 {
        if self.flow.is_one_piece() {
            return f64::INFINITY;
        }
        // at unit speed a time is a length
        let way = |c: usize, speed: f64| {
            let mut v = [0.0; 3];
            v[c] = speed;
            self.flow.soonest(here, x, v)
        };
        (0..3).fold(self.flow.reach(here, x), |least, c| least.min(way(c, 1.0) + way(c, -1.0)))
    }

    #[inline(always)]
    fn look<const W: usize>(
        &self,
        here: &[Piece; W],
        start: &Lanes3<W>,
        path: &[Lanes3<W>; 5],
        radius: &Lanes<W>,
        _edges: &mut Edges<W>,
    ) -> Ahead<W> {
        let mut ahead = self.walls.look(start, path, radius);
        if !self.flow.is_one_piece() {
            ahead.look_further(&self.may_leave(here, start, path));
        }
        ahead
    }

    #[inline(always)]
    fn edge(&self, here: Piece, path: &Path) -> Next<Piece> {
        if self.flow.is_one_piece() {
            return Next::Clear;
        }
        let reach = self.flow.reach(here, path.start);
        if reach < f64::INFINITY {
            let furthest = path.points.iter().fold(0.0f64, |m, p| m.max(dot(*p, *p))).sqrt();
            if furthest > reach {
                return Next::Longest(WITHIN * reach / furthest);
            }
        }
        self.flow.exit(here, path).map_or(Next::Clear, |Exit { theta, into }| Next::Edge { theta, into })
    }

    #[inline(always)]
    fn walls(&self) -> &Walls {
        &self.walls
    }
}

impl Analytic {
    /// Which paths may leave their pieces, or span too much.
    #[inline]
    fn may_leave<const W: usize>(&self, here: &[Piece; W], start: &Lanes3<W>, path: &[Lanes3<W>; 5]) -> Mask<W> {
        let mut may = [0; W];
        for l in 0..W {
            let mut corners = [[start[0][l], start[1][l], start[2][l]]; 2];
            for c in 0..3 {
                let (mut low, mut high) = (0.0f64, 0.0f64);
                for point in path {
                    let p = point[c][l];
                    low = if p < low { p } else { low };
                    high = if p > high { p } else { high };
                }
                corners[0][c] += low;
                corners[1][c] += high;
            }
            may[l] = mask(!self.flow.holds(here[l], corners));
        }
        may
    }
}
