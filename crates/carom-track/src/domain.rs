//! What the tracker asks of the space it tracks in: what the fluid is like here and now, and what comes first on a path.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

mod analytic;
mod meshed;

pub use analytic::Analytic;
pub use meshed::Meshed;

use crate::flow::{Flow, Local};
use crate::geometry::{Ahead, Path, Walls};
pub use crate::geometry::{ContactAt, Hit, Wall};
use crate::integrate::{Lanes, Lanes3};
use crate::lanes::Mask;
use crate::vector::Vec3;
pub use carom_cfd::Carry;
use std::fmt::Debug;

/// A space with a fluid and walls, made of pieces in each of which the flow is smooth: cells, layers, a jet's inside.
///
/// A sphere keeps its piece ([`Domain::Here`]) between calls. Its fluid is asked by the piece's formula, which goes on smoothly
/// beyond the piece's edges: a trial step may reach there before it is cut at what [`Domain::first`] says comes first.
pub trait Domain: Sync {
    /// The piece a sphere is in: a cell, a layer.
    type Here: Copy + Send + Sync + Debug;

    /// The pieces of `W` spheres, laid out for questions side by side.
    type Many<const W: usize>: Pieces<Self::Here>;

    /// The piece of spheres that have none yet.
    const NOWHERE: Self::Here;

    /// The piece of a point at a time (s).
    fn enter(&self, time: f64, x: Vec3) -> Self::Here;

    /// Everything known of the fluid at a time and point.
    fn fluid(&self, here: Self::Here, time: f64, x: Vec3) -> Local;

    /// The fluid's velocity at `W` times and points, m/s.
    fn velocities<const W: usize>(&self, here: &Self::Many<W>, time: &Lanes<W>, x: &Lanes3<W>) -> Lanes3<W>;

    /// Whether the fluid moves alike everywhere and always.
    fn is_uniform(&self) -> bool {
        false
    }

    /// Whether the fluid's answer holds the state of the gas ([`Local::gas`]), which may differ from place to place.
    fn varies_gas(&self) -> bool {
        false
    }

    /// Whether there is one piece only, and no step too long for it.
    fn is_one_piece(&self) -> bool {
        false
    }

    /// The piece that a sphere at `x` comes into next on its way along `v`, where it was led round and round without getting on.
    fn enter_ahead(&self, here: Self::Here, _x: Vec3, _v: Vec3) -> Self::Here {
        here
    }

    /// Whether a piece is none: the place is outside the space, though no wall was met.
    fn is_lost(&self, _here: Self::Here) -> bool {
        false
    }

    /// The cell of a mesh that a piece lies in; `None` without a mesh, and for no piece.
    fn cell(&self, _here: Self::Here) -> Option<u32> {
        None
    }

    /// Whether a piece lies where nothing is known of the fluid but what holds at the edge of what is.
    fn is_beyond(&self, _here: Self::Here) -> bool {
        false
    }

    /// How long a step from `x` at `v` is worth trying, s: until about the end of the piece, or of what a step may span.
    fn longest(&self, _here: Self::Here, _x: Vec3, _v: Vec3) -> f64 {
        f64::INFINITY
    }

    /// How far a step from `x` may spread at random, m: the least width of the piece, and what a step may span there.
    fn room(&self, _here: Self::Here, _x: Vec3) -> f64 {
        f64::INFINITY
    }

    /// Whether the space goes on elsewhere than where its sides are ([`Next::Carried`]).
    fn goes_on(&self) -> bool {
        false
    }

    /// How places are seen from elsewhere, where walls may be nearer than on this side.
    fn shifts(&self) -> &[Carry] {
        &[]
    }

    /// [`Domain::longest`] of `W` spheres, s.
    #[inline(always)]
    fn longest_all<const W: usize>(&self, here: &Self::Many<W>, x: &Lanes3<W>, v: &Lanes3<W>) -> Lanes<W> {
        let mut out = [0.0; W];
        for l in 0..W {
            out[l] = self.longest(here.get(l), [x[0][l], x[1][l], x[2][l]], [v[0][l], v[1][l], v[2][l]]);
        }
        out
    }

    /// Whether spheres go over the edges of pieces side by side, where these are plain: see [`Edges`].
    const SIDE_BY_SIDE: bool = false;

    /// Puts the spheres of some lanes into the pieces behind the edges they come to, and says of which lanes that is plain: the others stay.
    #[inline(always)]
    fn go_over<const W: usize>(&self, _here: &mut Self::Many<W>, _edges: &Edges<W>, _lanes: &Mask<W>) -> Mask<W> {
        [0; W]
    }

    /// What lies ahead of `W` paths (starts and control points 1 to 5 relative to them), as far as a look side by side tells.
    #[inline(always)]
    fn look<const W: usize>(
        &self,
        _here: &Self::Many<W>,
        _start: &Lanes3<W>,
        _path: &[Lanes3<W>; 5],
        _radius: &Lanes<W>,
        _edges: &mut Edges<W>,
    ) -> Ahead<W> {
        Ahead::UNKNOWN
    }

    /// The edge of the piece on a path, or how much of it is no longer than a step may be; walls aside.
    fn edge(&self, here: Self::Here, path: &Path) -> Next<Self::Here>;

    /// What comes first on the path of a sphere of that radius.
    #[inline(always)]
    fn first(&self, here: Self::Here, path: &Path, radius: f64) -> Next<Self::Here> {
        let edge = self.edge(here, path);
        if let Next::Longest(_) = edge {
            return edge;
        }
        earlier(edge, self.walls().first(path, radius))
    }

    /// The walls.
    fn walls(&self) -> &Walls;
}

/// Where paths come to the edges of their pieces, for those of which that is plain, and that nothing else comes first.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Edges<const W: usize> {
    /// The lanes.
    pub plain: Mask<W>,
    /// Where on the path, 0 to 1.
    pub theta: Lanes<W>,
    /// Which edge of the piece, as the domain counts them.
    pub side: [u64; W],
    /// How far the path has come there, and how that changes with θ, m.
    pub way: Lanes3<W>,
    /// See [`Edges::way`].
    pub slope: Lanes3<W>,
}

impl<const W: usize> Edges<W> {
    /// None.
    pub const NONE: Self =
        Self { plain: [0; W], theta: [0.0; W], side: [0; W], way: [[0.0; W]; 3], slope: [[0.0; W]; 3] };
}

/// Pieces of spheres side by side.
pub trait Pieces<H>: Copy + Debug {
    /// One piece for all.
    fn all(piece: H) -> Self;

    /// One sphere's piece.
    fn get(&self, lane: usize) -> H;

    /// Puts one sphere into a piece.
    fn set(&mut self, lane: usize, piece: H);
}

impl<H: Copy + Debug, const W: usize> Pieces<H> for [H; W] {
    #[inline(always)]
    fn all(piece: H) -> Self {
        [piece; W]
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> H {
        self[lane]
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, piece: H) {
        self[lane] = piece;
    }
}

/// What comes first on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next<H> {
    /// Nothing.
    Clear,
    /// The edge of a piece.
    Edge {
        /// Where on the path, 0 to 1.
        theta: f64,
        /// The piece behind it.
        into: H,
    },
    /// A place from which the space goes on elsewhere: a plane of symmetry, a cyclic patch.
    Carried {
        /// Where on the path, 0 to 1.
        theta: f64,
        /// The piece there.
        into: H,
        /// How places and vectors are carried there; spins do not turn with a mirror.
        carry: Carry,
    },
    /// A wall.
    Wall(Hit),
    /// The path is longer than the flow's structure allows: a step this share as long would not be.
    Longest(f64),
}

/// An edge or a wall, whichever comes first.
#[inline(always)]
fn earlier<H>(edge: Next<H>, hit: Option<Hit>) -> Next<H> {
    match (edge, hit) {
        (Next::Edge { theta, into }, hit) if hit.is_none_or(|h| theta < h.meeting.theta) => Next::Edge { theta, into },
        (Next::Carried { theta, into, carry }, hit) if hit.is_none_or(|h| theta < h.meeting.theta) => {
            Next::Carried { theta, into, carry }
        }
        (_, Some(hit)) => Next::Wall(hit),
        (edge, None) => edge,
    }
}

/// Of the time to the end of a piece, what a step tries: the end itself is then well within.
pub(crate) const BEYOND: f64 = 1.05;

/// A domain of any kind: chosen once in a run, so that the tracker is compiled once for each.
#[derive(Debug)]
#[non_exhaustive]
#[allow(clippy::large_enum_variant, reason = "there is one of it in a run")]
pub enum AnyDomain {
    /// An analytic flow or a table, with walls.
    Analytic(Analytic),
    /// A finished CFD result, with walls.
    Meshed(Meshed),
}

impl From<Analytic> for AnyDomain {
    fn from(domain: Analytic) -> Self {
        Self::Analytic(domain)
    }
}

impl AnyDomain {
    /// A flow and its walls.
    pub fn new(flow: Flow, walls: Vec<Wall>) -> Self {
        match flow {
            // walls made of patches carry their names
            Flow::Cells(cells) => {
                let of_patch =
                    cells.patches().iter().map(|p| walls.iter().position(|w| w.patch.as_deref() == Some(&p.name)));
                let of_patch = of_patch.collect();
                Meshed::new(cells, Walls::new(walls), of_patch).into()
            }
            flow => Analytic::new(flow, walls).into(),
        }
    }

    /// The same, some of its walls openings: spheres meet them, the fluid does not.
    pub fn with_openings(self, open: Vec<bool>) -> Self {
        match self {
            Self::Analytic(d) => d.with_openings(open).into(),
            Self::Meshed(d) => d.with_openings(open).into(),
        }
    }

    /// The same, a mesh with the distance and friction velocity of its solid walls, for walks and removal; `nu` is the fluid's kinematic
    /// viscosity, m²/s. Other flows know them as it is.
    #[must_use]
    pub fn with_friction(self, nu: f64) -> Self {
        match self {
            Self::Meshed(d) => d.with_friction(nu).into(),
            other => other,
        }
    }

    /// The walls, in the order of their indices.
    pub fn walls(&self) -> &[Wall] {
        self.geometry().list()
    }

    /// The walls, as one.
    pub fn geometry(&self) -> &Walls {
        match self {
            Self::Analytic(d) => d.walls(),
            Self::Meshed(d) => d.walls(),
        }
    }

    /// Everything known of the fluid at a time (s) and point (m).
    pub fn fluid(&self, time: f64, x: Vec3) -> Local {
        match self {
            Self::Analytic(d) => d.fluid(d.enter(time, x), time, x),
            Self::Meshed(d) => d.fluid(d.enter(time, x), time, x),
        }
    }
}
