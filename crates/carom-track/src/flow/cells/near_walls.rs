//! How far the solid walls of a mesh are, and how fast the fluid rubs on them.
//!
//! The distance d of the nearest solid wall and the friction velocity u_τ there are found at each node and are linear in each
//! tetrahedron like everything else: on flat walls d is exact, and its gradient is the wall's normal. Where two walls are as near, that gradient
//! jumps from a tetrahedron to the next, and spheres that a walk carries towards the jump from both sides would stay on it: the normal's direction is
//! linear too, from node to node, each with the mean of the tetrahedra around it. With y the distance of the centre
//! of the wall's cell, u its speed along the wall and k its turbulent kinetic energy, the face of a wall has
//!
//! u_τ = C_µ^{1/4} √k where C_µ^{1/4} √k y/ν > 11.225, else √(ν u/y):
//!
//! the log layer of the usual wall functions (Launder & Spalding 1974, doi:10.1016/0045-7825(74)90029-2) above the sublayer's edge, the
//! resolved slope below. In a laminar flow it is the latter.

use super::{C_MU, Cells, Node};
use crate::flow::Local;
use crate::geometry::{Shape, Wall};
use crate::vector::{Vec3, add, cross, dot, norm, scale, sub, unit};
use rayon::prelude::*;

/// d, m, u_τ, m/s, and the direction away from walls, of each node.
#[derive(Debug)]
pub(crate) struct NearWalls {
    nodes: Vec<[f64; 5]>,
}

/// y⁺ where the sublayer meets the log law: y⁺ = ln(9.8 y⁺)/0.41.
const SUBLAYER: f64 = 11.225;

/// Nodes that one thread takes at a time.
const TOGETHER: usize = 1024;

impl NearWalls {
    /// Of a flow between walls, those that are `open` aside; `nu` is the kinematic viscosity, m²/s. None where no wall is solid.
    pub fn new(cells: &Cells, walls: &[Wall], open: &[bool], nu: f64) -> Option<Self> {
        let solid: Vec<_> = walls.iter().zip(open).filter(|(_, open)| !**open).map(|(wall, _)| wall).collect();
        if solid.is_empty() {
            return None;
        }
        let patch = |wall: &Wall| cells.patches().iter().position(|p| Some(&p.name) == wall.patch.as_ref());
        let friction: Vec<Vec<f64>> =
            solid.iter().map(|wall| patch(wall).map_or(Vec::new(), |p| cells.frictions(p, nu))).collect();
        let at = |x: Vec3, far: f64| {
            let mut nearest = (far, 0.0);
            for (wall, friction) in solid.iter().zip(&friction) {
                let (distance, rub) = match &wall.shape {
                    Shape::Mesh(mesh) => {
                        let Some((face, distance)) = mesh.nearest_face(x, nearest.0) else { continue };
                        (distance, friction.get(face as usize).copied().unwrap_or(0.0))
                    }
                    shape => (shape.distance(x).abs(), 0.0),
                };
                if distance < nearest.0 {
                    nearest = (distance, rub);
                }
            }
            [nearest.0, nearest.1]
        };
        // nodes that follow each other are near each other: the way from one to the next bounds the search
        let each_of = |nodes: &[Node]| {
            let (mut from, mut near) = ([0.0; 3], [f64::INFINITY; 2]);
            let next = |node: &Node| {
                let x = cells.flat(node.place);
                let far = (near[0] + norm(sub(x, from))) * (1.0 + 1e-9) + f64::MIN_POSITIVE;
                near = at(x, far);
                if near[0] >= far {
                    // rounding, far from the origin
                    near = at(x, f64::INFINITY);
                }
                from = x;
                near
            };
            nodes.iter().map(next).collect::<Vec<_>>()
        };
        let mut found: Vec<_> = cells.nodes.par_chunks(TOGETHER).flat_map_iter(each_of).collect();
        cells.seams.join(&mut found, |_, near| near, |a, b| if b[0] < a[0] { b } else { a });
        let away = cells.away(|node| found[node][0]);
        Some(Self { nodes: found.into_iter().zip(away).map(|([d, rub], [x, y, z])| [d, rub, x, y, z]).collect() })
    }

    /// Adds what is known of the walls.
    #[inline(always)]
    pub fn add(&self, cells: &Cells, here: &super::Tetrahedron, x: Vec3, local: &mut Local) {
        let [distance, rub, away @ ..] = cells.blend(here, x, &self.nodes);
        local.wall_distance = if distance > 0.0 { distance } else { 0.0 };
        local.friction_velocity = if rub > 0.0 { rub } else { 0.0 };
        local.wall_normal = unit(away).unwrap_or_default();
    }
}

impl Cells {
    /// The direction of a field's gradient at each node, the mean of the tetrahedra around it; of no length where they cancel.
    fn away(&self, field: impl Fn(usize) -> f64) -> Vec<Vec3> {
        let mut away = vec![[0.0; 3]; self.nodes.len()];
        for cell in 0..self.len() {
            for tet in self.cut.of_cell(cell) {
                let Some(here) = self.tetrahedron_of(tet, self.cut.cell(tet)) else { continue };
                let Some(direction) = unit(self.slope(&here, &field)) else { continue };
                let ([a, b, c], centre) = self.corners(here.id, here.cell);
                for node in [a, b, c, centre] {
                    away[node] = add(away[node], direction);
                }
            }
        }
        self.seams.join(&mut away, |carry, sum| carry.vector(sum), add);
        self.seams.along_all(&mut away);
        away.into_iter().map(|sum| unit(sum).unwrap_or_default()).collect()
    }

    /// u_τ of each triangle of a patch, m/s.
    fn frictions(&self, patch: usize, nu: f64) -> Vec<f64> {
        let faces = &self.patches[patch].faces;
        (self.cut.first[faces.start]..self.cut.first[faces.end]).map(|t| self.friction(t, nu)).collect()
    }

    fn friction(&self, triangle: u32, nu: f64) -> f64 {
        let (corners, centre) = self.corners(2 * triangle, self.cut.cell(2 * triangle));
        let [a, b, c] = corners.map(|p| self.nodes[p].place);
        let Some(normal) = unit(cross(sub(b, a), sub(c, a))) else { return 0.0 };
        let y = dot(sub(self.nodes[centre].place, a), normal).abs();
        let wall = corners.map(|p| self.nodes[p].velocity);
        let wall = [0, 1, 2].map(|i| (wall[0][i] + wall[1][i] + wall[2][i]) / 3.0);
        let slip = sub(self.nodes[centre].velocity, wall);
        let along = norm(sub(slip, scale(normal, dot(slip, normal))));
        if y <= 0.0 {
            return 0.0;
        }
        let turbulent = self.turbulence.as_ref().map_or(0.0, |nodes| C_MU.sqrt().sqrt() * nodes[centre][0].sqrt());
        if turbulent * y / nu > SUBLAYER { turbulent } else { (nu * along / y).sqrt() }
    }
}
