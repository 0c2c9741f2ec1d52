//! How far the solid walls of a mesh are, and how fast the fluid rubs on them.
//!
//! The distance d of the nearest solid wall and the friction velocity u_τ there are found at each node and are linear in each
//! tetrahedron like everything else: on flat walls d is exact, and its gradient is the wall's normal. With y the distance of the centre
//! of the wall's cell, u its speed along the wall and k its turbulent kinetic energy, the face of a wall has
//!
//! u_τ = C_µ^{1/4} √k where C_µ^{1/4} √k y/ν > 11.225, else √(ν u/y):
//!
//! the log layer of the usual wall functions (Launder & Spalding 1974, doi:10.1016/0045-7825(74)90029-2) above the sublayer's edge, the
//! resolved slope below. In a laminar flow it is the latter.

use super::{C_MU, Cells};
use crate::flow::Local;
use crate::geometry::{Shape, Wall};
use crate::vector::{Vec3, cross, dot, norm, scale, sub, unit};
use rayon::prelude::*;

/// d, m, and u_τ, m/s, of each node.
#[derive(Debug)]
pub(crate) struct NearWalls {
    nodes: Vec<[f64; 2]>,
}

/// y⁺ where the sublayer meets the log law: y⁺ = ln(9.8 y⁺)/0.41.
const SUBLAYER: f64 = 11.225;

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
        let at = |x: Vec3| {
            let x = cells.flat(x);
            let mut nearest = (f64::INFINITY, 0.0);
            for (wall, friction) in solid.iter().zip(&friction) {
                let (distance, rub) = match &wall.shape {
                    Shape::Mesh(mesh) => {
                        let Some((face, distance)) = mesh.nearest_face(x) else { continue };
                        // repetitions of a wedge count on
                        (distance, friction.get(face as usize % friction.len().max(1)).copied().unwrap_or(0.0))
                    }
                    shape => (shape.distance(x).abs(), 0.0),
                };
                if distance < nearest.0 {
                    nearest = (distance, rub);
                }
            }
            [nearest.0, nearest.1]
        };
        Some(Self { nodes: cells.nodes.par_iter().map(|node| at(node.place)).collect() })
    }

    /// Adds what is known of the walls.
    #[inline(always)]
    pub fn add(&self, cells: &Cells, here: &super::Tetrahedron, x: Vec3, local: &mut Local) {
        let [distance, rub] = cells.blend(here, x, &self.nodes);
        let slope = cells.slope(here, |node| self.nodes[node][0]);
        local.wall_distance = if distance > 0.0 { distance } else { 0.0 };
        local.friction_velocity = if rub > 0.0 { rub } else { 0.0 };
        let steepness = norm(slope);
        local.wall_normal = if steepness > 0.0 { scale(slope, 1.0 / steepness) } else { [0.0; 3] };
    }
}

impl Cells {
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
