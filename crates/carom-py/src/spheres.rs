//! How spheres come, whatever stands for each of their numbers.

use crate::numbers::Input;
use carom::Impact;
use carom::impact::components;
use std::convert::Infallible;

/// Spheres on a wall: their numbers as arguments (`Input`), as arrays that are held, as columns, or as one row.
#[derive(Clone, Copy, Debug)]
pub struct Spheres<T> {
    pub diameter: T,
    /// Speed and angle, or normal and tangential speed.
    pub motion: [T; 2],
    pub by_angle: bool,
    pub spin: T,
    /// The law's own where there is none.
    pub density: Option<T>,
    /// All 1/2 where there are none.
    pub draws: Option<[T; 4]>,
}

impl<T> Spheres<T> {
    /// Each number made into something else, if all can be.
    #[inline]
    pub fn try_map<'a, U, E>(&'a self, of: impl Fn(&'a T) -> Result<U, E>) -> Result<Spheres<U>, E> {
        let [first, second] = &self.motion;
        Ok(Spheres {
            diameter: of(&self.diameter)?,
            motion: [of(first)?, of(second)?],
            by_angle: self.by_angle,
            spin: of(&self.spin)?,
            density: self.density.as_ref().map(&of).transpose()?,
            draws: match &self.draws {
                None => None,
                Some([a, b, c, d]) => Some([of(a)?, of(b)?, of(c)?, of(d)?]),
            },
        })
    }

    /// Each number made into something else.
    #[inline]
    pub fn map<'a, U>(&'a self, of: impl Fn(&'a T) -> U) -> Spheres<U> {
        let Ok(all) = self.try_map(|number| Ok::<_, Infallible>(of(number)));
        all
    }

    /// All with their names.
    pub fn named(&self) -> Vec<(&'static str, &T)> {
        let names = if self.by_angle { ["speed", "angle"] } else { ["normal", "tangential"] };
        let mut all = vec![("diameter", &self.diameter)];
        all.extend(names.into_iter().zip(&self.motion));
        all.push(("spin", &self.spin));
        all.extend(self.density.as_ref().map(|d| ("density", d)));
        all.extend(self.draws.iter().flatten().map(|d| ("draws", d)));
        all
    }
}

impl Spheres<Input> {
    /// The row, if all are single numbers.
    #[inline]
    pub fn one(&self) -> Option<Spheres<f64>> {
        self.try_map(|input| input.one().ok_or(())).ok()
    }
}

impl Spheres<f64> {
    /// On a wall at y = 0, with the sphere above it moving along +x.
    #[inline]
    pub fn impact(&self) -> Impact {
        let [a, b] = self.motion;
        let (normal, tangential) = if self.by_angle { components(a, b) } else { (a, b) };
        let on_wall = Impact::new(self.diameter, [tangential, -normal, 0.0], [0.0, 1.0, 0.0]);
        let draws = self.draws.unwrap_or(on_wall.draws);
        Impact { density: self.density, spin: [0.0, 0.0, -self.spin], draws, ..on_wall }
    }

    /// Speed and angle in degrees.
    pub fn speed_and_angle(&self) -> (f64, f64) {
        let [a, b] = self.motion;
        match (self.by_angle, b == 0.0) {
            (true, _) => (a, b),
            (false, true) => (a, 90.0),
            (false, false) => (a.hypot(b), a.atan2(b).to_degrees()),
        }
    }
}
