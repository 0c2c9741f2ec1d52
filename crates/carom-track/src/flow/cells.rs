//! A flow on a mesh of cells, from a finished CFD result.
//!
//! Cells are cut into tetrahedra (`cells/cut.rs`), in each of which every field is linear between its four nodes: three points of the mesh and
//! the cell's centre (`cells/nodes.rs`). So fields are continuous everywhere and, on the boundary, what the boundary condition says. A sphere
//! keeps the [`Tetrahedron`] it is in.

mod beyond;
mod cut;
mod gaps;
mod locate;
mod making;
mod near_walls;
mod nodes;
mod seams;
mod state;
mod strips;
mod tetrahedra;
mod tetrahedron;
mod walls;
mod within;

pub(crate) use beyond::carry_spin;
pub(crate) use near_walls::NearWalls;
pub(crate) use tetrahedra::Leaving;
pub use tetrahedra::Tetrahedra;
pub use tetrahedron::Tetrahedron;

use super::Local;
use super::gas_nodes::GasNodes;
use crate::geometry::{Bounds, Triangle};
use crate::vector::{Vec3, add, norm, scale, sub, unit};
use beyond::{Plane, Wedge};
use carom_cfd::geometry::{base_points, cell_centres_and_volumes, face_centres_and_areas};
use carom_cfd::{Carry, Field, Patch, PatchKind, Snapshot};
use cut::{Cut, NONE};
use locate::Locator;
use nodes::Nodes;
use seams::Seams;
use strips::Strips;

/// A flow on a mesh of cells.
#[derive(Debug)]
pub struct Cells {
    cut: Cut,
    /// Points, then centres of cells.
    nodes: Vec<Node>,
    /// Number of the first centre.
    centres: usize,
    /// k, m²/s², and ε, m²/s³, of the nodes, where there is turbulence.
    turbulence: Option<Vec<[f64; 2]>>,
    /// Temperature and density of the nodes, where there are any.
    state: Option<GasNodes>,
    patches: Vec<Patch>,
    plane: Option<Plane>,
    /// Of a plane case, how tetrahedra make triangles of the plane.
    strips: Option<Strips>,
    wedge: Option<Wedge>,
    seams: Seams,
    locator: Option<Locator>,
    bounds: Bounds,
    inverted: usize,
}

/// A point of the mesh or the centre of a cell: place and velocity side by side, as tetrahedra are made of both.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// m.
    place: Vec3,
    /// m/s.
    velocity: Vec3,
}

/// What lies behind a side of a tetrahedron.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Behind {
    /// Another tetrahedron, and its cell.
    Inside(u32, u32),
    /// Not known from the mesh: to be looked for.
    Unknown,
    /// A patch that ends the space: its index, and the triangle, counted over the patch.
    Patch(usize, u32),
    /// The space goes on in the mirror image of a tetrahedron.
    Mirror(Carry, u32),
    /// The space goes on in the wedge, turned round its axis.
    Turned(Carry),
    /// The space goes on behind another patch, by its index.
    Paired(Carry, usize),
}

/// A result that no flow can be made of.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CellsError {
    /// No velocity.
    #[error("the result has no velocity")]
    NoVelocity,
    /// Both empty and wedge patches.
    #[error("the mesh has empty and wedge patches: it is either plane or axisymmetric")]
    PlaneAndRound,
    /// Empty sides that are no plane.
    #[error("the empty patches are not the two sides of a plane case")]
    NotPlane,
    /// A density that no gas has.
    #[error("the result's density goes down to {least} kg/m3: it must be positive everywhere")]
    Density {
        /// The least, kg/m³.
        least: f64,
    },
    /// Other than two wedges.
    #[error("the mesh has {count} wedge patches: an axisymmetric case has two, at an angle below 180 degrees")]
    Wedges {
        /// How many.
        count: usize,
    },
}

/// C_µ of k-ε and k-ω models: ε = C_µ k ω.
const C_MU: f64 = 0.09;

impl Cells {
    /// The flow of a result that was checked ([`carom_cfd::check`]).
    ///
    /// # Errors
    /// [`CellsError`].
    pub fn new(snapshot: &Snapshot) -> Result<Self, CellsError> {
        let (mesh, fields) = (&snapshot.mesh, &snapshot.fields);
        let velocity = fields.velocity.as_ref().ok_or(CellsError::NoVelocity)?;
        let (face_centres, areas) = face_centres_and_areas(&mesh.points, &mesh.faces);
        let (cell_centres, _) = cell_centres_and_volumes(mesh, &face_centres, &areas);
        let count = |kind: &PatchKind| mesh.patches.iter().filter(|p| p.kind == *kind && !p.faces.is_empty()).count();
        let (empty, wedges) = (count(&PatchKind::Empty), count(&PatchKind::Wedge));
        let plane = Plane::of(mesh, &areas);
        let wedge = Wedge::of(mesh, &areas);
        match (empty, wedges) {
            (0, 0) => {}
            (1.., 1..) => return Err(CellsError::PlaneAndRound),
            (1.., 0) if plane.is_none() => return Err(CellsError::NotPlane),
            (0, count) if wedge.is_none() => return Err(CellsError::Wedges { count }),
            _ => {}
        }
        let seams = Seams::new(mesh, &areas);
        let base = base_points(mesh, &cell_centres);
        let mut cut = Cut::new(mesh, &base);
        let strips = plane.as_ref().and_then(|plane| Strips::new(snapshot, plane, &mut cut));
        let nodes = Nodes { mesh, cut: &cut, cell_centres: &cell_centres, face_centres: &face_centres, seams: &seams };
        let mut velocity = nodes.values(velocity, |carry, v: Vec3| carry.vector(v));
        seams.along_mirrors(&mut velocity);
        if let (Some(Field::Cells { .. }), Some(wedge)) = (&fields.velocity, &wedge) {
            wedge.turn_sides(mesh, &mut velocity);
        }
        let scalar = |field: &Field<1>| nodes.values(field, |_, v| v);
        let k = fields.k.as_ref().map(&scalar);
        let dissipation = match (&k, &fields.epsilon, &fields.omega) {
            (Some(_), Some(epsilon), _) => Some(scalar(epsilon)),
            (Some(k), None, Some(omega)) => {
                Some(scalar(omega).iter().zip(k).map(|(omega, k)| [C_MU * k[0] * omega[0]]).collect())
            }
            _ => None,
        };
        let turbulence =
            k.zip(dissipation).map(|(k, e)| k.iter().zip(&e).map(|(k, e)| [k[0].max(0.0), e[0].max(0.0)]).collect());
        let temperature = fields.temperature.as_ref().map(&scalar);
        let density = fields.density.as_ref().map(&scalar);
        let least = density.iter().flatten().fold(f64::INFINITY, |least, d| least.min(d[0]));
        if least <= 0.0 {
            return Err(CellsError::Density { least });
        }
        let state = temperature.map(|t| state::nodes(&t, density.as_deref()));
        let centres = mesh.points.len();
        let places = mesh.points.iter().copied().chain(cell_centres);
        let along = |v: Vec3| plane.map_or(v, |p| p.along(v));
        let nodes = places.zip(velocity).map(|(place, velocity)| Node { place, velocity: along(velocity) }).collect();
        let bounds = Bounds::around(mesh.points.iter().copied());
        let mut cells = Self {
            cut,
            nodes,
            centres,
            turbulence,
            state,
            patches: mesh.patches.clone(),
            plane,
            strips,
            wedge,
            seams,
            locator: None,
            bounds,
            inverted: base.inverted.len(),
        };
        cells.locator = Some(Locator::new(&cells));
        Ok(cells)
    }

    /// How many cells.
    pub fn len(&self) -> usize {
        self.cut.cells()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The patches of the mesh.
    pub fn patches(&self) -> &[Patch] {
        &self.patches
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Whether it has turbulence.
    pub fn is_turbulent(&self) -> bool {
        self.turbulence.is_some()
    }

    /// Faces whose tetrahedra are turned or flat from whichever corner the face is cut.
    pub fn inverted(&self) -> usize {
        self.inverted
    }

    /// Number of a cell's centre among the nodes.
    fn centre(&self, cell: usize) -> usize {
        self.centres + cell
    }

    /// A point of a plane case put into its plane.
    fn flat(&self, x: Vec3) -> Vec3 {
        self.plane.map_or(x, |p| p.put(x))
    }

    /// Nodes of a tetrahedron of a cell: its triangle's corners, and the cell's centre.
    #[inline(always)]
    fn corners(&self, tet: u32, cell: u32) -> ([usize; 3], usize) {
        let corners = self.cut.triangles[(tet >> 1) as usize].map(|p| p as usize);
        (corners, self.centre(cell as usize))
    }

    /// The tetrahedron within the mesh behind a side of another one, and its cell; none where the mesh does not say it or ends.
    #[inline(always)]
    pub(crate) fn next(&self, id: u32, cell: u32, side: usize) -> Option<(u32, u32)> {
        if side < 3 {
            let next = self.cut.beside(id, side);
            return (next != NONE).then_some((next, cell));
        }
        self.cut.across(id, self.cut.face(id) as usize)
    }

    /// What is behind a side.
    #[inline(always)]
    pub(crate) fn behind(&self, here: &Tetrahedron, side: usize, x: Vec3, slope: Vec3) -> Behind {
        match self.next(here.id, here.cell, side) {
            Some((next, cell)) => Behind::Inside(next, cell),
            None if side < 3 => Behind::Unknown,
            None => self.behind_boundary(here, self.cut.face(here.id) as usize, x, slope),
        }
    }

    /// What is behind a face of the boundary.
    #[inline(never)]
    fn behind_boundary(&self, here: &Tetrahedron, face: usize, x: Vec3, slope: Vec3) -> Behind {
        let triangle = here.id >> 1;
        let Some((index, patch)) = self.patches.iter().enumerate().find(|(_, p)| p.faces.contains(&face)) else {
            return Behind::Unknown;
        };
        match &patch.kind {
            PatchKind::Symmetry => {
                let corners = self.cut.triangles[triangle as usize].map(|p| self.nodes[p as usize].place);
                match unit(crate::vector::cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]))) {
                    Some(normal) => Behind::Mirror(beyond::mirror(corners[0], normal), here.id),
                    None => Behind::Unknown,
                }
            }
            PatchKind::Wedge => match &self.wedge {
                Some(wedge) => Behind::Turned(wedge.back(x, slope)),
                None => Behind::Unknown,
            },
            PatchKind::Cyclic { partner, carry } | PatchKind::CyclicAmi { partner, carry } => {
                Behind::Paired(*carry, *partner)
            }
            // met by rounding alone: the fields lie in the plane
            PatchKind::Empty => Behind::Unknown,
            _ => Behind::Patch(index, triangle - self.cut.first[patch.faces.start]),
        }
    }

    /// How what leaves a wedge at `x` towards `v` comes back into it; none in other meshes.
    pub(crate) fn back_into_wedge(&self, x: Vec3, v: Vec3) -> Option<Carry> {
        self.wedge.as_ref().map(|wedge| wedge.back(x, v))
    }

    /// The tetrahedron of a point; [`Tetrahedron::NOWHERE`] outside the mesh.
    pub(crate) fn find(&self, x: Vec3) -> Tetrahedron {
        let found = self.locator.as_ref().and_then(|l| l.find(self, x));
        found.and_then(|tet| self.tetrahedron(tet)).unwrap_or(Tetrahedron::NOWHERE)
    }

    /// The tetrahedron that a sphere at `x` comes into next on its way along `v`.
    pub(crate) fn find_ahead(&self, x: Vec3, v: Vec3) -> Tetrahedron {
        const STEP: f64 = 1e-9;
        let size = norm(sub(self.bounds.max, self.bounds.min));
        let ahead = unit(v).map_or(x, |way| add(x, scale(way, STEP * size)));
        let there = self.find(ahead);
        if there.is_nowhere() { self.find(x) } else { there }
    }

    /// The centre of a cell, in the plane of a plane case, m.
    pub(crate) fn middle(&self, cell: usize) -> Vec3 {
        self.flat(self.nodes[self.centre(cell)].place)
    }

    /// A triangle of a patch.
    pub(crate) fn triangle(&self, patch: usize, triangle: u32) -> Option<Triangle> {
        let first = self.cut.first[self.patches.get(patch)?.faces.start];
        Some(self.cut.triangles.get((first + triangle) as usize)?.map(|p| self.nodes[p as usize].place))
    }

    /// The triangles of a patch, m; sides turned as the faces are, out of the mesh.
    pub fn triangles(&self, patch: &Patch) -> Vec<Triangle> {
        let (from, to) = (self.cut.first[patch.faces.start] as usize, self.cut.first[patch.faces.end] as usize);
        self.cut.triangles[from..to].iter().map(|t| t.map(|p| self.nodes[p as usize].place)).collect()
    }

    /// Whether a point lies in a cell.
    pub fn holds(&self, x: Vec3) -> bool {
        !self.find(x).is_nowhere()
    }

    /// Whether the space goes on elsewhere than where its sides are: planes of symmetry, wedges, cyclic patches.
    pub fn goes_on(&self) -> bool {
        self.patches.iter().any(|p| {
            matches!(
                p.kind,
                PatchKind::Symmetry | PatchKind::Wedge | PatchKind::Cyclic { .. } | PatchKind::CyclicAmi { .. }
            )
        })
    }

    /// How places and vectors are carried over where the space goes on elsewhere, by the name of the patch; mirrors aside.
    pub fn carries(&self) -> impl Iterator<Item = (&str, Carry)> {
        self.patches.iter().filter_map(|p| {
            let carry = match &p.kind {
                PatchKind::Wedge => self.wedge.as_ref()?.turn(self.wedge.as_ref()?.angle),
                PatchKind::Cyclic { carry, .. } | PatchKind::CyclicAmi { carry, .. } => *carry,
                _ => return None,
            };
            Some((p.name.as_str(), carry))
        })
    }

    /// How what is near a cyclic patch is seen from behind its partner, where other walls are near. Beside mirrors and in wedges the nearest
    /// wall is on this side.
    pub(crate) fn shifts(&self) -> Vec<Carry> {
        let shift = |p: &Patch| match p.kind {
            PatchKind::Cyclic { carry, .. } | PatchKind::CyclicAmi { carry, .. } => Some(carry),
            _ => None,
        };
        self.patches.iter().filter_map(shift).collect()
    }

    /// Velocity at a point, m/s; at rest outside the mesh.
    pub fn velocity(&self, x: Vec3) -> Vec3 {
        self.find(x).velocity_at(x)
    }

    /// Everything known at a point; fluid at rest outside the mesh.
    pub fn sample(&self, x: Vec3) -> Local {
        self.sample_in(&self.find(x), x)
    }

    /// No speed within a box is above this, m/s.
    pub(crate) fn fastest(&self, [low, high]: [Vec3; 2]) -> f64 {
        let around = Bounds { min: low, max: high };
        let mut most = 0.0f64;
        let speed = |p: usize| norm(self.nodes[p].velocity);
        if (0..3).all(|c| low[c] <= self.bounds.min[c] && high[c] >= self.bounds.max[c]) {
            return (0..self.nodes.len()).map(speed).fold(0.0, f64::max);
        }
        self.locator.iter().for_each(|l| {
            l.meeting(&around, |cell| {
                for tet in self.cut.of_cell(cell as usize) {
                    let (corners, centre) = self.corners(tet, cell);
                    most = corners.into_iter().chain([centre]).map(speed).fold(most, f64::max);
                }
            });
        });
        most
    }

    /// Everything known at `x`, by the formulas of a tetrahedron.
    #[inline(always)]
    pub(crate) fn sample_in(&self, here: &Tetrahedron, x: Vec3) -> Local {
        let mut local = Local::steady(here.velocity_at(x), here.gradient);
        if here.is_nowhere() {
            return local;
        }
        if let Some(nodes) = &self.turbulence {
            let [k, epsilon] = self.blend(here, x, nodes);
            (local.k, local.epsilon) = (k.max(0.0), epsilon.max(0.0));
        }
        local.gas = self
            .state
            .as_ref()
            .map(|s| s.state(self.blend(here, x, &s.nodes), self.slope(here, |node| s.nodes[node][0])));
        local
    }

    /// A field's value at `x`.
    #[inline(always)]
    fn blend<const N: usize>(&self, here: &Tetrahedron, x: Vec3, nodes: &[[f64; N]]) -> [f64; N] {
        let (corners, centre) = self.corners(here.id, here.cell);
        let weights = here.coordinates(x);
        let at = [corners[0], corners[1], corners[2], centre];
        let mut sum = [0.0; N];
        for (weight, node) in weights.into_iter().zip(at) {
            for (s, v) in sum.iter_mut().zip(nodes[node]) {
                *s = weight.mul_add(v, *s);
            }
        }
        sum
    }
}

#[cfg(test)]
pub(crate) mod tests;
