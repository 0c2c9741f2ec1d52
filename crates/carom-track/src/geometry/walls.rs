//! All walls of a domain: what of them a path meets first, and what a sphere touches or overlaps.
//!
//! Planes and the sides of rooms are looked at for `W` paths side by side; a cylinder or a mesh makes only those paths look
//! further that come near it.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::{Ahead, Bounds, Face, Meeting, Path, Shape};
use crate::force::wall_drag::Nearest;
use crate::integrate::{Lanes, Lanes3};
use crate::vector::Vec3;

/// A path meets a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the wall.
    pub wall: usize,
    /// The triangle, in the order of its file, where the wall is a mesh.
    pub face: Option<u32>,
    /// Where on the path, and the normal there.
    pub meeting: Meeting,
    /// Velocity of the wall at the contact point, m/s.
    pub wall_velocity: Vec3,
}

/// What must reach the wall for contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactAt {
    /// The sphere's surface, one radius before its centre.
    #[default]
    Surface,
    /// The sphere's centre.
    Center,
}

/// A wall's geometry.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Its name in results.
    pub name: String,
    /// Its shape.
    pub shape: Shape,
    /// What must reach it for contact.
    pub contact_at: ContactAt,
    /// Velocity of the wall along itself, m/s.
    pub velocity: Vec3,
    /// The patch of a mesh of cells that it is.
    pub patch: Option<String>,
}

impl Wall {
    /// A wall at rest that a sphere's surface touches.
    pub fn new(name: &str, shape: Shape) -> Self {
        Self { name: name.to_owned(), shape, contact_at: ContactAt::Surface, velocity: [0.0; 3], patch: None }
    }

    /// Distance at which a sphere of that radius is in contact, m.
    #[inline(always)]
    pub fn clearance(&self, radius: f64) -> f64 {
        match self.contact_at {
            ContactAt::Surface => radius,
            ContactAt::Center => 0.0,
        }
    }
}

/// A sphere is where a wall is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// Index of the wall.
    pub wall: usize,
    /// How far the sphere would have to move to be clear of it, m.
    pub depth: f64,
}

/// One of the walls, or of their faces, that a sphere touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Index of the wall.
    pub wall: usize,
    /// The triangle, in the order of its file, where the wall is a mesh.
    pub face: Option<u32>,
    /// Unit normal at the contact, from the wall to the sphere's centre.
    pub normal: Vec3,
    /// Distance from contact, m; negative where rounding has let it sink in.
    pub gap: f64,
}

/// What a sphere touches.
#[derive(Clone, Copy, Debug)]
pub struct Supports {
    list: [Support; Self::MOST],
    count: usize,
}

impl Supports {
    /// Most contacts that are told apart: more than hold a sphere in any vessel.
    pub const MOST: usize = 8;

    const NONE: Self =
        Self { list: [Support { wall: 0, face: None, normal: [0.0; 3], gap: 0.0 }; Self::MOST], count: 0 };

    /// The contacts; those of one wall with the same normal are one.
    pub fn iter(&self) -> impl Iterator<Item = &Support> {
        self.list.iter().take(self.count)
    }

    /// Whether nothing is touched.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    fn add(&mut self, new: Support) {
        let same = |s: &Support| s.wall == new.wall && (0..3).all(|c| (s.normal[c] - new.normal[c]).abs() < 1e-9);
        if !self.iter().any(same)
            && let Some(place) = self.list.get_mut(self.count)
        {
            *place = new;
            self.count += 1;
        }
    }
}

/// All walls of a domain.
#[derive(Clone, Debug)]
pub struct Walls {
    list: Vec<Wall>,
    /// Planes and sides of rooms, for the look side by side.
    faces: Vec<Face>,
    /// The others' indices.
    curved: Vec<usize>,
    /// Of each, whether it is an opening: met, but nothing solid.
    open: Vec<bool>,
}

/// The distance that counts as touching: far below anything measured, above the rounding of positions.
#[inline(always)]
fn slack(x: Vec3, radius: f64) -> f64 {
    1e-15 * x[0].abs().max(x[1].abs()).max(x[2].abs()) + 1e-9 * radius
}

impl Walls {
    /// Walls in the order of their indices.
    pub fn new(list: Vec<Wall>) -> Self {
        let (mut faces, mut curved) = (Vec::new(), Vec::new());
        for (index, wall) in list.iter().enumerate() {
            let face = |plane: &_| Face::new(plane, wall.clearance(1.0), index);
            match &wall.shape {
                Shape::Plane(p) => faces.push(face(p)),
                Shape::Room(r) => faces.extend(r.faces().iter().map(face)),
                Shape::Cylinder(_) | Shape::Mesh(_) => curved.push(index),
            }
        }
        let open = vec![false; list.len()];
        Self { list, faces, curved, open }
    }

    /// The same, some of them openings: spheres meet them, the fluid does not.
    pub fn with_openings(self, open: Vec<bool>) -> Self {
        Self { open, ..self }
    }

    /// The solid wall nearest to a point.
    #[inline(always)]
    pub fn nearest(&self, x: Vec3) -> Option<Nearest> {
        let mut nearest: Option<Nearest> = None;
        for (wall, _) in self.list.iter().zip(&self.open).filter(|(_, open)| !**open) {
            let found = wall.shape.nearest(x);
            if let Some((distance, normal)) = found.filter(|f| nearest.is_none_or(|n| f.0 < n.distance)) {
                nearest = Some(Nearest { distance, normal, velocity: wall.velocity });
            }
        }
        nearest
    }

    /// Distance of the nearest of them from a point, m.
    pub fn distance(&self, x: Vec3) -> f64 {
        self.list.iter().fold(f64::INFINITY, |nearest, wall| match &wall.shape {
            Shape::Mesh(mesh) => mesh.distance_within(x, nearest).unwrap_or(nearest),
            shape => nearest.min(shape.distance(x).abs()),
        })
    }

    /// Of each, whether it is an opening.
    pub fn openings(&self) -> &[bool] {
        &self.open
    }

    /// The walls, in the order of their indices.
    pub fn list(&self) -> &[Wall] {
        &self.list
    }

    /// The box around all walls that have one (rooms, meshes); none if none has.
    pub fn bounds(&self) -> Option<Bounds> {
        let boxes = self.list.iter().map(|w| w.shape.bounds());
        boxes.filter(|b| b.min.iter().chain(&b.max).all(|c| c.is_finite())).reduce(|a, b| a.union(&b))
    }

    /// What lies ahead of `W` paths (starts and control points 1 to 5 relative to them), as far as a look side by side tells.
    #[inline(always)]
    pub fn look<const W: usize>(&self, start: &Lanes3<W>, path: &[Lanes3<W>; 5], radius: &Lanes<W>) -> Ahead<W> {
        let mut margin = [0.0; W];
        for l in 0..W {
            margin[l] = 2.0 * slack([start[0][l], start[1][l], start[2][l]], radius[l]);
        }
        let mut ahead = Ahead::nothing(margin);
        for (index, face) in self.faces.iter().enumerate() {
            ahead.look(index, face, start, path, radius);
        }
        for wall in self.curved.iter().filter_map(|i| self.list.get(*i)) {
            let mut clearance = [0.0; W];
            for l in 0..W {
                clearance[l] = wall.clearance(radius[l]);
            }
            match &wall.shape {
                Shape::Cylinder(c) => ahead.look_further(&c.may_meet(start, path, &clearance, &margin)),
                Shape::Mesh(m) => ahead.look_further(&m.may_meet(start, path, &clearance, &margin)),
                Shape::Plane(_) | Shape::Room(_) => {}
            }
        }
        ahead
    }

    /// Where the centre of a sphere of that radius, on that path, first touches a wall.
    #[inline(always)]
    pub fn first(&self, path: &Path, radius: f64) -> Option<Hit> {
        let slack = slack(path.start, radius);
        let mut first: Option<Hit> = None;
        for (index, wall) in self.list.iter().enumerate() {
            let met = wall.shape.meet(path, wall.clearance(radius), slack);
            if let Some((meeting, face)) = met.filter(|(m, _)| first.is_none_or(|f| m.theta < f.meeting.theta)) {
                first = Some(Hit { wall: index, face, meeting, wall_velocity: wall.velocity });
            }
        }
        first
    }

    /// The hit on a face that [`Walls::look`] saw, with the centre at `x`, θ along the path.
    #[inline(always)]
    pub fn hit(&self, face: usize, theta: f64, x: Vec3, radius: f64) -> Option<Hit> {
        let face = self.faces.get(face)?;
        let wall_velocity = self.list.get(face.wall)?.velocity;
        Some(Hit { wall: face.wall, face: None, meeting: face.meeting(theta, x, radius), wall_velocity })
    }

    /// The wall that a sphere of that radius at `x` overlaps most, beyond rounding: behind a plane, in a solid, across a
    /// triangle.
    pub fn overlap(&self, x: Vec3, radius: f64) -> Option<Overlap> {
        let touching = 2.0 * slack(x, radius);
        let mut most: Option<Overlap> = None;
        for (wall, shape) in self.list.iter().enumerate() {
            let depth = shape.clearance(radius) - shape.shape.distance(x);
            if depth > touching && most.is_none_or(|m| depth > m.depth) {
                most = Some(Overlap { wall, depth });
            }
        }
        most
    }

    /// What a sphere of that radius at `x` touches: all within `slack` (m) of contact.
    pub fn support(&self, x: Vec3, radius: f64, slack: f64) -> Supports {
        let mut found = Supports::NONE;
        for (index, wall) in self.list.iter().enumerate() {
            wall.shape.touched(x, wall.clearance(radius), slack, &mut |face, normal, gap| {
                found.add(Support { wall: index, face, normal, gap });
            });
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Cylinder, Mesh, Plane, Room};
    use crate::lanes::Mask;
    use crate::vector::{norm, unit};
    use proptest::prelude::*;

    fn wall(shape: Shape) -> Wall {
        Wall { name: String::new(), shape, contact_at: ContactAt::Surface, velocity: [0.0; 3], patch: None }
    }

    fn rod(point: Vec3, axis: Vec3, radius: f64, inside: bool) -> Shape {
        Shape::Cylinder(Cylinder { point, axis: unit(axis).unwrap(), radius, inside })
    }

    #[test]
    fn what_is_surely_clear_side_by_side_meets_nothing() {
        let walls = Walls::new(vec![
            wall(Shape::Room(Room { min: [-1.0; 3], max: [1.0; 3] })),
            wall(rod([0.5, 0.0, 0.0], [1.0, 2.0, 3.0], 0.1, false)),
            wall(rod([0.0; 3], [1.0, -0.3, 0.2], 0.8, true)),
            wall(Shape::Mesh(Mesh::block([-0.4, -0.2, 0.1], [0.0, 0.4, 0.5]).unwrap())),
        ]);
        let clear = std::cell::Cell::new(0);
        proptest!(ProptestConfig::with_cases(4000), |(
            x in prop::array::uniform3(-0.9f64..0.9), p in prop::array::uniform5(prop::array::uniform3(-0.3f64..0.3))
        )| {
            let path = Path { start: x, points: p };
            let column = |v: Vec3| v.map(|c| [c]);
            let ahead = walls.look::<1>(&column(x), &p.map(column), &[0.05]);
            if ahead.count[0] == 0 {
                clear.set(clear.get() + 1);
                prop_assert!(walls.first(&path, 0.05).is_none());
            }
        });
        assert!(clear.get() > 100, "{}", clear.get());
    }

    #[test]
    fn a_far_rod_leaves_flat_hits_side_by_side() {
        let room = wall(Shape::Room(Room { min: [0.0; 3], max: [1.0; 3] }));
        let walls = Walls::new(vec![room, wall(rod([9.0; 3], [0.0, 0.0, 1.0], 0.5, false))]);
        let down = Path::straight([0.5; 3], [0.0, -1.0, 0.0]);
        let ahead = walls.look::<1>(&[[0.5]; 3], &down.points.map(|p| p.map(|c| [c])), &[0.1]);
        let (theta, plain): ([f64; 1], Mask<1>) = ahead.descents();
        assert!(ahead.count == [1] && plain == [u64::MAX] && (theta[0] - 0.4).abs() < 1e-15);
    }

    #[test]
    fn overlaps_and_supports_of_every_shape() {
        let walls = Walls::new(vec![
            wall(Shape::Plane(Plane { point: [0.0; 3], normal: [0.0, 1.0, 0.0] })),
            wall(rod([5.0, 1.0, 0.0], [0.0, 0.0, 1.0], 0.5, false)),
            wall(Shape::Mesh(Mesh::block([-3.0, 0.0, -1.0], [-2.0, 1.0, 1.0]).unwrap())),
        ]);
        let r = 0.1;
        assert_eq!(walls.overlap([0.0, 0.1, 0.0], r), None);
        assert!(walls.overlap([0.0, 0.06, 0.0], r).is_some_and(|o| o.wall == 0 && (o.depth - 0.04).abs() < 1e-15));
        assert!(walls.overlap([0.0, -7.0, 0.0], r).is_some_and(|o| o.wall == 0 && (o.depth - 7.1).abs() < 1e-15));
        assert!(walls.overlap([5.0, 1.1, 0.0], r).is_some_and(|o| o.wall == 1 && (o.depth - 0.5).abs() < 1e-15));
        // in the middle of the block, 0.5 from its nearest side
        assert!(walls.overlap([-2.5, 0.5, 0.0], r).is_some_and(|o| o.wall == 2 && (o.depth - 0.6).abs() < 1e-15));
        // in the corner of floor and block
        let s = walls.support([-1.9, 0.1, 0.3], r, 1e-9);
        let of = |w: usize| s.iter().find(|s| s.wall == w).unwrap();
        assert!(s.iter().count() == 2 && of(0).normal == [0.0, 1.0, 0.0] && norm(of(2).normal) > 0.999);
        assert!((of(2).normal[0] - 1.0).abs() < 1e-12 && of(2).face.is_some() && of(0).face.is_none());
        assert!(walls.support([0.0, 0.2, 0.0], r, 1e-9).is_empty());
        assert_eq!(walls.bounds(), Some(Bounds { min: [-3.0, 0.0, -1.0], max: [-2.0, 1.0, 1.0] }));
    }
}
