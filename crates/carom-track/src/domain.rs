//! What the tracker asks of the space it tracks in: what the fluid is like, and where a path next meets a wall.

use crate::flow::{Flow, Local};
use crate::geometry::{Ahead, Path, Walls};
pub use crate::geometry::{ContactAt, Hit, Wall};
use crate::integrate::{Lanes, Lanes3};
use crate::vector::Vec3;

/// A space with a fluid and walls. A CFD mesh can be one too.
pub trait Domain: Sync {
    /// Everything known of the fluid at a point.
    fn fluid(&self, x: Vec3) -> Local;

    /// The fluid's velocity at `W` points, m/s.
    fn velocities<const W: usize>(&self, x: &Lanes3<W>) -> Lanes3<W>;

    /// Whether the fluid moves alike everywhere.
    fn is_uniform(&self) -> bool {
        false
    }

    /// Where the centre of a sphere of that radius, on that path, first touches a wall.
    fn next_wall(&self, path: &Path, radius: f64) -> Option<Hit>;

    /// What lies ahead of `W` paths (starts and control points 1 to 5 relative to them), as far as a look side by side tells.
    #[inline(always)]
    fn ahead<const W: usize>(&self, _start: &Lanes3<W>, _path: &[Lanes3<W>; 5], _radius: &Lanes<W>) -> Ahead<W> {
        Ahead::UNKNOWN
    }

    /// The hit on a face that [`Domain::ahead`] saw, with the centre at `x`, θ along the path.
    fn hit(&self, _face: usize, _theta: f64, _x: Vec3, _radius: f64) -> Option<Hit> {
        None
    }
}

/// An analytic flow with walls of simple shapes.
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

    /// The walls, in the order of their indices.
    pub fn walls(&self) -> &[Wall] {
        self.walls.list()
    }
}

impl Domain for Analytic {
    fn fluid(&self, x: Vec3) -> Local {
        self.flow.sample(x)
    }

    #[inline(always)]
    fn velocities<const W: usize>(&self, x: &Lanes3<W>) -> Lanes3<W> {
        self.flow.velocities(x)
    }

    fn is_uniform(&self) -> bool {
        matches!(self.flow, Flow::Still | Flow::Uniform { .. })
    }

    #[inline(always)]
    fn next_wall(&self, path: &Path, radius: f64) -> Option<Hit> {
        self.walls.first(path, radius)
    }

    #[inline(always)]
    fn ahead<const W: usize>(&self, start: &Lanes3<W>, path: &[Lanes3<W>; 5], radius: &Lanes<W>) -> Ahead<W> {
        self.walls.look(start, path, radius)
    }

    #[inline(always)]
    fn hit(&self, face: usize, theta: f64, x: Vec3, radius: f64) -> Option<Hit> {
        self.walls.hit(face, theta, x, radius)
    }
}
