//! A mesh of cells with walls: from tetrahedron to tetrahedron.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::{BEYOND, Carry, Domain, Edges, Next, Pieces};
use crate::flow::Local;
use crate::flow::cells::{Behind, Cells, Leaving, NearWalls, Tetrahedra, Tetrahedron};
use crate::geometry::{Ahead, Hit, Meeting, Path, Walls};
use crate::integrate::{Lanes, Lanes3};
use crate::lanes::{Mask, bits, take_lowest};
use crate::vector::{Vec3, scale, sub, unit};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// A finished CFD result with walls.
#[derive(Debug)]
pub struct Meshed {
    cells: Arc<Cells>,
    walls: Walls,
    /// Whether the space goes on elsewhere, and how places are seen from behind cyclic patches.
    goes_on: bool,
    shifts: Vec<Carry>,
    /// Of each patch, the index of its wall.
    of_patch: Vec<Option<usize>>,
    /// Of each cell, a distance from its centre within which there is no wall, m: the bits of an `f32`, or [`ASK`]. Found when a sphere first
    /// enters the cell, as most runs see few cells of a large mesh; whichever thread finds it, it is the same.
    clear: Vec<AtomicU32>,
    /// Distance and friction of the solid walls, where it is asked for.
    near: Option<NearWalls>,
}

/// What no distance has for bits.
const ASK: u32 = u32::MAX;

impl Meshed {
    /// A flow on cells, and its walls; `of_patch` says which wall each patch is.
    pub fn new(cells: Arc<Cells>, walls: Walls, of_patch: Vec<Option<usize>>) -> Self {
        let clear = (0..cells.len()).map(|_| AtomicU32::new(ASK)).collect();
        let (goes_on, shifts) = (cells.goes_on(), cells.shifts());
        Self { cells, walls, goes_on, shifts, of_patch, clear, near: None }
    }

    /// The flow.
    pub fn cells(&self) -> &Arc<Cells> {
        &self.cells
    }

    /// The same, with the distance and friction velocity of its solid walls; `nu` is the fluid's kinematic viscosity, m²/s.
    #[must_use]
    pub fn with_friction(self, nu: f64) -> Self {
        let near = NearWalls::new(&self.cells, self.walls.list(), self.walls.openings(), nu);
        Self { near, ..self }
    }

    pub(super) fn with_openings(self, open: Vec<bool>) -> Self {
        Self { walls: self.walls.with_openings(open), ..self }
    }

    /// A distance from a cell's centre within which there is no wall, m.
    #[inline(always)]
    fn clear(&self, cell: u32) -> f64 {
        let known = self.clear[cell as usize].load(Ordering::Relaxed);
        f64::from(f32::from_bits(if known == ASK { self.find_clear(cell) } else { known }))
    }

    #[cold]
    #[inline(never)]
    fn find_clear(&self, cell: u32) -> u32 {
        let distance = self.walls.distance(self.cells.middle(cell as usize));
        // never more than it is
        let clear = (distance * (1.0 - 1e-6)) as f32 * (1.0 - 1e-6);
        self.clear[cell as usize].store(clear.to_bits(), Ordering::Relaxed);
        clear.to_bits()
    }

    #[inline(always)]
    fn prepared(&self, mut tet: Tetrahedron) -> Tetrahedron {
        if !tet.is_nowhere() {
            tet.clear = self.clear(tet.cell);
        }
        tet
    }

    /// What lies ahead where the mesh does not say it: another cell, or beyond the axis of a wedge the other side of it.
    fn look_for(&self, theta: f64, x: Vec3, slope: Vec3) -> Next<Tetrahedron> {
        let into = self.cells.find_ahead(x, slope);
        match self.cells.back_into_wedge(x, slope).filter(|_| into.is_nowhere()) {
            Some(carry) => self.carried(theta, self.cells.carry_back(carry, x, slope)),
            None => Next::Edge { theta, into: self.prepared(into) },
        }
    }

    fn carried(&self, theta: f64, (into, carry): (Tetrahedron, Carry)) -> Next<Tetrahedron> {
        Next::Carried { theta, into: self.prepared(into), carry }
    }

    /// Whether a lane's path meets a wall up to θ.
    #[inline(always)]
    fn meets<const W: usize>(
        &self,
        l: usize,
        start: &Lanes3<W>,
        path: &[Lanes3<W>; 5],
        radius: f64,
        theta: f64,
    ) -> bool {
        let mut points = [[0.0; 3]; 5];
        for k in 0..5 {
            points[k] = [path[k][0][l], path[k][1][l], path[k][2][l]];
        }
        let path = Path { start: [start[0][l], start[1][l], start[2][l]], points };
        self.walls.first(&path, radius).is_some_and(|hit| hit.meeting.theta <= theta)
    }

    /// The end of a path at a patch that its walls let through: only rounding does.
    fn through(&self, patch: usize, triangle: u32, theta: f64, path: &Path) -> Option<Hit> {
        let wall = self.of_patch.get(patch).copied().flatten()?;
        let [a, b, c] = self.cells.triangle(patch, triangle)?;
        let out = unit(crate::vector::cross(sub(b, a), sub(c, a)))?;
        let meeting = Meeting { theta, position: path.at(theta), normal: scale(out, -1.0) };
        let wall_velocity = self.walls.list().get(wall)?.velocity;
        Some(Hit { wall, face: Some(triangle), meeting, wall_velocity })
    }
}

impl Domain for Meshed {
    type Here = Tetrahedron;
    type Many<const W: usize> = Tetrahedra<W>;
    const NOWHERE: Tetrahedron = Tetrahedron::NOWHERE;

    fn enter(&self, _time: f64, x: Vec3) -> Tetrahedron {
        self.prepared(self.cells.find(x))
    }

    fn enter_ahead(&self, here: Tetrahedron, x: Vec3, v: Vec3) -> Tetrahedron {
        let found = self.prepared(self.cells.find_ahead(x, v));
        if found.is_nowhere() { here } else { found }
    }

    fn varies_gas(&self) -> bool {
        self.cells.has_gas()
    }

    fn is_lost(&self, here: Tetrahedron) -> bool {
        here.is_nowhere()
    }

    fn cell(&self, here: Tetrahedron) -> Option<u32> {
        (!here.is_nowhere()).then_some(here.cell)
    }

    #[inline(always)]
    fn fluid(&self, here: Tetrahedron, _time: f64, x: Vec3) -> Local {
        let mut local = self.cells.sample_in(&here, x);
        if let Some(near) = self.near.as_ref().filter(|_| !here.is_nowhere()) {
            near.add(&self.cells, &here, x, &mut local);
        }
        local
    }

    #[inline(always)]
    fn velocities<const W: usize>(&self, here: &Tetrahedra<W>, _time: &Lanes<W>, x: &Lanes3<W>) -> Lanes3<W> {
        here.velocities(x)
    }

    #[inline(always)]
    fn longest(&self, here: Tetrahedron, x: Vec3, v: Vec3) -> f64 {
        BEYOND * here.soonest(x, v)
    }

    fn room(&self, here: Tetrahedron, _x: Vec3) -> f64 {
        here.room()
    }

    fn goes_on(&self) -> bool {
        self.goes_on
    }

    fn shifts(&self) -> &[Carry] {
        &self.shifts
    }

    #[inline(always)]
    fn longest_all<const W: usize>(&self, here: &Tetrahedra<W>, x: &Lanes3<W>, v: &Lanes3<W>) -> Lanes<W> {
        let mut longest = here.soonest(x, v);
        for l in 0..W {
            longest[l] *= BEYOND;
        }
        longest
    }

    #[inline(always)]
    fn look<const W: usize>(
        &self,
        here: &Tetrahedra<W>,
        start: &Lanes3<W>,
        path: &[Lanes3<W>; 5],
        radius: &Lanes<W>,
        edges: &mut Edges<W>,
    ) -> Ahead<W> {
        let clear = here.are_clear(start, path, radius);
        let Leaving { mut stays, mut leaves, side, theta, way, slope } = here.leave(start, path);
        let mut near = [0; W];
        for l in 0..W {
            near[l] = !clear[l] & (stays[l] | leaves[l]);
        }
        let mut near = bits(&near);
        while let Some(l) = take_lowest(&mut near) {
            if self.meets(l, start, path, radius[l], if stays[l] == 0 { theta[l] } else { 1.0 }) {
                (stays[l], leaves[l]) = (0, 0);
            }
        }
        let (mut ahead, mut further) = (Ahead::nothing([0.0; W]), [0; W]);
        for l in 0..W {
            further[l] = !stays[l];
        }
        *edges = Edges { plain: leaves, side, theta, way, slope };
        ahead.look_further(&further);
        ahead
    }

    const SIDE_BY_SIDE: bool = true;

    #[inline(always)]
    fn go_over<const W: usize>(&self, here: &mut Tetrahedra<W>, edges: &Edges<W>, lanes: &Mask<W>) -> Mask<W> {
        let (mut id, mut cell, mut known) = ([0; W], [0; W], 0);
        let mut left = bits(lanes);
        while let Some(l) = take_lowest(&mut left) {
            if let Some(next) = self.cells.next(here.id[l], here.cell[l], edges.side[l] as usize) {
                (id[l], cell[l]) = next;
                known |= 1 << l;
            }
        }
        let (mut into, good) = self.cells.make(&id, &cell, known);
        while let Some(l) = take_lowest(&mut known) {
            into.clear[l] = self.clear(cell[l]);
        }
        here.take(&into, &good);
        good
    }

    #[inline(always)]
    fn edge(&self, here: Tetrahedron, path: &Path) -> Next<Tetrahedron> {
        let Some((theta, side)) = here.exit(path) else { return Next::Clear };
        let (x, slope) = (path.at(theta), path.slope(theta));
        match self.cells.behind(&here, side, x, slope) {
            Behind::Inside(next, cell) => match self.cells.tetrahedron_of(next, cell) {
                Some(into) => Next::Edge { theta, into: self.prepared(into) },
                None => self.look_for(theta, x, slope),
            },
            Behind::Unknown => self.look_for(theta, x, slope),
            Behind::Mirror(carry, tet) => {
                self.carried(theta, (self.cells.tetrahedron(tet).unwrap_or(Tetrahedron::NOWHERE), carry))
            }
            Behind::Turned(carry) => self.carried(theta, self.cells.carry_back(carry, x, slope)),
            Behind::Paired(carry, partner) => self.carried(theta, self.cells.carry_behind(carry, partner, &here, x)),
            Behind::Patch(patch, triangle) => match self.through(patch, triangle, theta, path) {
                Some(hit) => Next::Wall(hit),
                None => Next::Edge { theta, into: Tetrahedron::NOWHERE },
            },
        }
    }

    #[inline(always)]
    fn first(&self, here: Tetrahedron, path: &Path, radius: f64) -> Next<Tetrahedron> {
        let edge = self.edge(here, path);
        let lanes = |v: Vec3| v.map(|c| [c]);
        let clear = Tetrahedra::<1>::all(here).are_clear(&lanes(path.start), &path.points.map(lanes), &[radius]);
        if clear[0] != 0 {
            return edge;
        }
        super::earlier(edge, self.walls.first(path, radius))
    }

    #[inline(always)]
    fn walls(&self) -> &Walls {
        &self.walls
    }
}

impl From<Meshed> for super::AnyDomain {
    fn from(domain: Meshed) -> Self {
        Self::Meshed(domain)
    }
}
