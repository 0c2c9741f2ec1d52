//! What a sphere in contact motion moves on: one wall, flat or round, or the groove between two.

use super::Motion;
use crate::geometry::{Cylinder, Shape, Wall};
use crate::tracker::Behavior;
use crate::tracker::meeting::law_of;
use crate::vector::{Vec3, add, cross, dot, norm, scale, sub};

/// How a wall rubs against a sphere that moves along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rub {
    /// Coulomb friction f > 0.
    Friction(f64),
    /// Not at all.
    Free,
    /// So that nothing is left of the motion along it: an endless series of bounces, each of which takes a share.
    Ended,
}

impl Rub {
    /// That of a wall for the spheres of an injection, which move along it at a speed (m/s).
    pub fn of(behavior: Option<&Behavior>, injection: usize, speed: f64) -> Self {
        let Some(law) = behavior.and_then(|b| law_of(b, injection)) else { return Self::Ended };
        match (law.tangential().friction(), law.given_tangential_restitution(0.0, speed)) {
            (Some(f), _) if f > 0.0 => Self::Friction(f),
            (None, Some(e_t)) if e_t < 1.0 => Self::Ended,
            _ => Self::Free,
        }
    }
}

/// Force across a wall, over the whole, that counts neither as leaning on it nor as pulling off it.
const LEANS: f64 = 1e-9;

/// Shifts after which walls meet too sharply for their gaps to be closed.
const MOST_SHIFTS: usize = 32;

/// One contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Held<'a> {
    pub index: usize,
    pub wall: &'a Wall,
    /// At the sphere's place, into the fluid.
    pub normal: Vec3,
    pub rub: Rub,
    /// Distance from contact, m.
    pub gap: f64,
}

/// The contacts that press.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface<'a> {
    contacts: [Held<'a>; 2],
    count: usize,
}

/// How a surface acts on a sphere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pressed {
    /// Acceleration along the surface, and what keeps the sphere on a curved one, m/s².
    pub acceleration: Vec3,
    /// Whether no contact is pulled off.
    pub holds: bool,
    /// Σ f times the force per mass, m/s².
    pub friction: f64,
    /// Sum of the forces per mass, m/s².
    pub total: f64,
}

impl<'a> Surface<'a> {
    /// The contacts that press a sphere on which the forces act with `a` (m/s²): none, if it leaves; `None` if three or more hold it.
    pub fn choose(contacts: &[Held<'a>], motion: &Motion, a: Vec3) -> Option<Self> {
        let none = contacts.first().map(|c| Self { contacts: [*c; 2], count: 0 })?;
        let singles = contacts.iter().map(|c| Self { contacts: [*c; 2], count: 1 });
        let pairs = contacts
            .iter()
            .enumerate()
            .flat_map(|(i, c)| contacts.iter().skip(i + 1).map(|d| Self { contacts: [*c, *d], count: 2 }));
        std::iter::once(none).chain(singles).chain(pairs).find(|s| s.bears(contacts, motion, a))
    }

    /// Whether these contacts press, and no other one is pressed into.
    fn bears(&self, all: &[Held<'a>], motion: &Motion, a: Vec3) -> bool {
        let pressed = self.press(motion, a);
        let leans = LEANS * norm(a);
        // without any force there is nothing to hold it either
        let off = if self.count == 0 { leans } else { -leans };
        pressed.holds
            && all.iter().all(|c| {
                self.list().iter().any(|own| own.index == c.index && dot(own.normal, c.normal) > 1.0 - 1e-9)
                    || dot(pressed.acceleration, c.normal) - c.needs(motion) >= off
            })
    }

    /// The contacts.
    pub fn list(&self) -> &[Held<'a>] {
        self.contacts.get(..self.count).unwrap_or_default()
    }

    /// The shift that closes the gaps of its contacts without going into another one's wall, m; none where that takes more than `most`.
    pub fn closing(&self, all: &[Held<'a>], most: f64) -> Vec3 {
        let mut shift = self.gaps_closed();
        let is_own = |c: &Held| self.list().iter().any(|own| own.index == c.index && own.normal == c.normal);
        for _ in 0..MOST_SHIFTS {
            let gap = |c: &Held| c.gap + dot(c.normal, shift);
            let Some(deepest) =
                all.iter().filter(|c| !is_own(c) && gap(c) < 0.0).min_by(|a, b| gap(a).total_cmp(&gap(b)))
            else {
                return if norm(shift) <= most { shift } else { [0.0; 3] };
            };
            let free = self.along(deepest.normal);
            let share = dot(free, free);
            // a little further than the wall: rounding must not bring it back
            shift = add(shift, scale(free, -(1.0 + 1e-9) * gap(deepest) / share.max(1e-300)));
        }
        [0.0; 3]
    }

    fn gaps_closed(&self) -> Vec3 {
        match self.list() {
            [] => [0.0; 3],
            [c] => scale(c.normal, -c.gap),
            [c, d, ..] => {
                let cosine = dot(c.normal, d.normal);
                let per = 1.0 / (1.0 - cosine * cosine).max(1e-300);
                let (p, q) = ((cosine * d.gap - c.gap) * per, (cosine * c.gap - d.gap) * per);
                add(scale(c.normal, p), scale(d.normal, q))
            }
        }
    }

    /// The velocity of the wall, m/s.
    pub fn wall_velocity(&self) -> Vec3 {
        self.contacts[0].wall.velocity
    }

    /// The unit direction of a groove; `None` on one wall.
    pub fn groove(&self) -> Option<Vec3> {
        let [a, b] = self.contacts.map(|c| c.normal);
        (self.count == 2).then(|| crate::vector::unit(cross(a, b))).flatten()
    }

    /// What is left of a vector along the surface.
    pub fn along(&self, v: Vec3) -> Vec3 {
        match self.groove() {
            Some(t) => scale(t, dot(t, v)),
            None => {
                let n = self.contacts[0].normal;
                sub(v, scale(n, dot(n, v)))
            }
        }
    }

    /// The contacts at another place: on a round wall the normal turns.
    pub fn at(&self, x: Vec3) -> Self {
        let mut here = *self;
        for c in &mut here.contacts {
            if let Shape::Cylinder(cylinder) = &c.wall.shape {
                c.normal = cylinder.normal(x);
            }
        }
        here
    }

    /// The forces at the contacts, and what they leave of an acceleration.
    pub fn press(&self, motion: &Motion, a: Vec3) -> Pressed {
        let rub = |c: &Held| if let Rub::Friction(f) = c.rub { f } else { 0.0 };
        match self.list() {
            [] => Pressed { acceleration: a, holds: true, friction: 0.0, total: 0.0 },
            [c] => {
                let p = c.needs(motion) - dot(a, c.normal);
                let acceleration = add(a, scale(c.normal, p));
                Pressed { acceleration, holds: p > -LEANS * norm(a), friction: rub(c) * p.max(0.0), total: p }
            }
            [c, d, ..] => {
                let (p, q) = (c.needs(motion) - dot(a, c.normal), d.needs(motion) - dot(a, d.normal));
                let cosine = dot(c.normal, d.normal);
                let per = 1.0 / (1.0 - cosine * cosine).max(1e-300);
                let (p, q) = ((p - cosine * q) * per, (q - cosine * p) * per);
                let acceleration = add(add(a, scale(c.normal, p)), scale(d.normal, q));
                let friction = rub(c) * p.max(0.0) + rub(d) * q.max(0.0);
                Pressed { acceleration, holds: p.min(q) > -LEANS * norm(a), friction, total: p + q }
            }
        }
    }

    /// Slip of the contact points, m/s: in a groove along it, both alike.
    pub fn slip(&self, motion: &Motion, radius: f64) -> Vec3 {
        let v = self.along(sub(motion.v, self.wall_velocity()));
        match self.groove() {
            Some(t) => sub(v, scale(t, self.lever() * radius * dot(motion.spin, self.axis()))),
            None => sub(v, scale(cross(motion.spin, self.contacts[0].normal), radius)),
        }
    }

    /// The axis about which a sphere rolls forward along a groove.
    fn axis(&self) -> Vec3 {
        let [a, b] = self.contacts.map(|c| c.normal);
        crate::vector::unit(sub(a, b)).map_or([0.0; 3], |axis| {
            // rolling forward: v = −R n × ... along n₁ × n₂ or against it
            if dot(cross(axis, a), cross(a, b)) < 0.0 { scale(axis, -1.0) } else { axis }
        })
    }

    /// Distance of the contact points from that axis over the radius: 1 on one wall.
    pub fn lever(&self) -> f64 {
        let [a, b] = self.contacts.map(|c| c.normal);
        if self.count < 2 { 1.0 } else { norm(cross(a, b)) / norm(sub(a, b)).max(1e-300) }
    }

    /// The change of spin by a force per mass `f` on the contact points along the surface, rad/s².
    pub fn turn(&self, f: Vec3, radius: f64) -> Vec3 {
        match self.groove() {
            Some(t) => scale(self.axis(), -2.5 / radius * self.lever() * dot(f, t)),
            None => scale(cross(self.contacts[0].normal, f), -2.5 / radius),
        }
    }

    /// The spin with which the sphere rolls, rad/s; what does not belong to rolling stays.
    pub fn rolling_spin(&self, motion: &Motion, radius: f64) -> Vec3 {
        let v = self.along(sub(motion.v, self.wall_velocity()));
        match self.groove() {
            Some(t) => {
                let axis = self.axis();
                let want = dot(v, t) / (self.lever() * radius);
                add(motion.spin, scale(axis, want - dot(motion.spin, axis)))
            }
            None => {
                let n = self.contacts[0].normal;
                add(scale(n, dot(n, motion.spin)), scale(cross(n, v), 1.0 / radius))
            }
        }
    }

    /// Radius of the circle that the centre goes round on a round wall that it lies in, m.
    pub fn hollow(&self, radius: f64) -> Option<f64> {
        match (self.list(), &self.contacts[0].wall.shape) {
            ([c], Shape::Cylinder(cylinder)) if cylinder.inside => Some(cylinder.radius - c.wall.clearance(radius)),
            _ => None,
        }
    }
}

impl Held<'_> {
    /// The acceleration along the normal that keeps a sphere on a round wall, m/s²; 0 on a flat one.
    fn needs(&self, motion: &Motion) -> f64 {
        let Shape::Cylinder(Cylinder { point, axis, inside, .. }) = &self.wall.shape else { return 0.0 };
        let across = |v: Vec3| sub(v, scale(*axis, dot(v, *axis)));
        let (r, v) = (norm(across(sub(motion.x, *point))), across(motion.v));
        let around = sub(v, scale(self.normal, dot(v, self.normal)));
        let turning = dot(around, around) / r.max(1e-300);
        if *inside { turning } else { -turning }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{ContactAt, Plane};
    use crate::vector::unit;

    fn wall(normal: Vec3) -> Wall {
        let shape = Shape::Plane(Plane { point: [0.0; 3], normal });
        Wall { name: String::new(), shape, contact_at: ContactAt::Surface, velocity: [0.0; 3], patch: None }
    }

    fn held(wall: &Wall) -> Held<'_> {
        let Shape::Plane(p) = &wall.shape else { unreachable!() };
        Held { index: 0, wall, normal: p.normal, rub: Rub::Friction(0.5), gap: 0.0 }
    }

    #[test]
    fn a_groove_bears_the_weight_with_both_walls_and_rolling_in_it_slips_at_neither() {
        let normals = [unit([1.0, 1.0, 0.0]).unwrap(), unit([-1.0, 1.0, 0.0]).unwrap()];
        let walls = normals.map(wall);
        let contacts: Vec<Held> = walls.iter().enumerate().map(|(index, w)| Held { index, ..held(w) }).collect();
        let mut m = Motion { x: [0.0, 1e-4, 0.0], v: [0.0, 0.0, 0.3], spin: [0.0; 3] };
        let groove = Surface::choose(&contacts, &m, [0.0, -10.0, 0.0]).unwrap();
        let pressed = groove.press(&m, [0.0, -10.0, 0.0]);
        assert!((pressed.total - 20.0 / 2f64.sqrt()).abs() < 1e-12 && norm(pressed.acceleration) < 1e-12);
        let radius = 1e-4;
        m.spin = groove.rolling_spin(&m, radius);
        assert!(norm(groove.slip(&m, radius)) < 1e-15);
        for n in normals {
            // the contact point of each wall is at rest
            let contact = add(m.v, cross(m.spin, scale(n, -radius)));
            assert!(norm(contact) < 1e-15, "{contact:?}");
        }
        // friction forwards brakes a spin that runs ahead
        assert!(dot(groove.turn([0.0, 0.0, 1.0], radius), m.spin) < 0.0);
        // pushed along one wall away from the other, one wall is enough
        let one = Surface::choose(&contacts, &m, [7.0, -6.0, 0.0]).unwrap();
        assert_eq!((one.list().len(), one.list()[0].index), (1, 1));
        assert!(Surface::choose(&contacts, &m, [0.0, 1.0, 0.0]).unwrap().list().is_empty());
    }
}
