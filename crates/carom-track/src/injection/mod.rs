//! Where, when, how big and how fast spheres start.
//!
//! A sphere's start is a pure function of (seed, injection, number), so any part of a run can make its own.
//!
//! Two ways to say how much: a **count** of spheres, each for itself (weight 1), with diameters drawn by number; or a
//! **mass** (or mass flow over a time window) carried by a number of parcels, each standing for `weight` like spheres, with
//! diameters drawn by mass, so that all parcels carry the same mass and the injected mass is exact.
//! Positions fill a place evenly, or, [by flux](Injection::by_flux), in proportion to the fluid's velocity into it.
//! Starts are spread over the time window, one at random in each of as many equal intervals as there are starts.
//!
//! ```
//! use carom_track::{flow::Fluid, injection::*};
//! let plan = Plan {
//!     sizes: Sizes::Lognormal { median: 70e-6, gsd: 1.3, by: By::Number },
//!     amount: Amount::Count(1000),
//!     ..Plan::single([0.0, 0.025, 0.0], [2.0, 0.0, 0.0], 90e-6, 8940.0)
//! };
//! let injection = Injection::new(1, 0, plan, &Fluid::default())?;
//! let start = injection.particle(17, |_, _| [0.0; 3]);
//! assert_eq!(start, injection.particle(17, |_, _| [0.0; 3]));
//! assert_eq!((start.position, start.weight), ([0.0, 0.025, 0.0], 1.0));
//! # Ok::<(), InjectionError>(())
//! ```

mod aerodynamic;
mod flux;
mod size;
mod source;

pub use aerodynamic::geometric_diameter;
pub use size::{By, Sizes};
pub use source::{Listed, Source};

use crate::flow::{Flow, Fluid};
use crate::force::{Slip, Sphere};
use crate::random::{Purpose, Stream};
use flux::Inflow;
use size::Sampler;
use source::Place;

/// What an injection is to be.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Where.
    pub source: Source,
    /// How fast.
    pub velocity: Start,
    /// Spin, rad/s.
    pub spin: [f64; 3],
    /// Density of the spheres, kg/m³.
    pub density: f64,
    /// How big.
    pub sizes: Sizes,
    /// What the diameters in `sizes` mean.
    pub diameter: Diameter,
    /// When.
    pub window: Window,
    /// How much.
    pub amount: Amount,
}

impl Plan {
    /// One sphere of a diameter (m) and density (kg/m³) at a point, at time 0, without spin.
    pub fn single(position: [f64; 3], velocity: [f64; 3], diameter: f64, density: f64) -> Self {
        Self {
            source: Source::Point(position),
            velocity: Start::Velocity(velocity),
            spin: [0.0; 3],
            density,
            sizes: Sizes::Mono(diameter),
            diameter: Diameter::Geometric,
            window: Window { start: 0.0, stop: 0.0 },
            amount: Amount::Count(1),
        }
    }
}

/// Velocity at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// This one, m/s.
    Velocity([f64; 3]),
    /// The fluid's where the sphere starts.
    Fluid,
}

/// What a diameter is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Diameter {
    /// The sphere's own.
    Geometric,
    /// That of a sphere of 1000 kg/m³ that settles as fast, with this slip correction for both.
    Aerodynamic(Slip),
}

/// A time window, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// First moment.
    pub start: f64,
    /// Last moment; the same as the first for all at once.
    pub stop: f64,
}

/// How much is injected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// So many spheres.
    Count(u64),
    /// A mass in equal parcels.
    Mass {
        /// kg.
        total: f64,
        /// How many parcels.
        parcels: u64,
    },
    /// A mass flow over the window, in equal parcels.
    MassFlow {
        /// kg/s.
        rate: f64,
        /// How many parcels.
        parcels: u64,
    },
}

/// A sphere (or a parcel of like spheres) at its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Injected {
    /// m.
    pub position: [f64; 3],
    /// m/s.
    pub velocity: [f64; 3],
    /// rad/s.
    pub spin: [f64; 3],
    /// Geometric diameter, m.
    pub diameter: f64,
    /// kg/m³.
    pub density: f64,
    /// s.
    pub time: f64,
    /// How many spheres it stands for.
    pub weight: f64,
}

/// A checked injection, ready to make its spheres.
#[derive(Clone, Debug)]
pub struct Injection {
    seed: u64,
    index: u32,
    plan: Plan,
    place: Place,
    inflow: Option<Inflow>,
    sampler: Sampler,
    fluid: Fluid,
    count: u64,
    /// Mass of a parcel, kg; `None` where each is one sphere.
    parcel_mass: Option<f64>,
}

impl Injection {
    /// Checks a plan. `index` tells a run's injections apart.
    ///
    /// # Errors
    /// [`InjectionError`], naming the value that is wrong and what would be right.
    pub fn new(seed: u64, index: u32, plan: Plan, fluid: &Fluid) -> Result<Self, InjectionError> {
        positive("sphere density", plan.density)?;
        finite3("spin", plan.spin)?;
        if let Start::Velocity(v) = plan.velocity {
            finite3("start velocity", v)?;
        }
        let Window { start, stop } = plan.window;
        finite("start time", start)?;
        if !(stop >= start && stop.is_finite()) {
            return Err(InjectionError::value("stop time", stop, "finite and not before the start"));
        }
        let (count, mass) = match plan.amount {
            Amount::Count(n) => (n, None),
            Amount::Mass { total, parcels } => (parcels, Some(total)),
            Amount::MassFlow { rate, parcels } => {
                positive("mass flow", rate)?;
                if stop <= start {
                    return Err(InjectionError::value(
                        "stop time",
                        stop,
                        "after the start: a mass flow needs a time to flow",
                    ));
                }
                (parcels, Some(rate * (stop - start)))
            }
        };
        if count == 0 {
            return Err(InjectionError::value("number of particles", 0.0, "at least 1"));
        }
        let parcel_mass = mass.map(|m| positive("injected mass", m).map(|()| m / count as f64)).transpose()?;
        let by = if parcel_mass.is_some() { By::Mass } else { By::Number };
        let sampler = Sampler::new(&plan.sizes, by)?;
        let place = Place::new(&plan.source)?;
        Ok(Self { seed, index, plan, place, inflow: None, sampler, fluid: *fluid, count, parcel_mass })
    }

    /// The same, with positions in proportion to the velocity with which a flow enters the place: of a disc along its normal, of
    /// a box through its faces, of a patch or a surface the way that more of it goes. Weights stay equal.
    ///
    /// # Errors
    /// [`InjectionError::Shape`] for a point, and where nothing flows in.
    pub fn by_flux(self, flow: &Flow) -> Result<Self, InjectionError> {
        Inflow::new(&self.plan.source, flow).map(|inflow| Self { inflow: Some(inflow), ..self })
    }

    /// Of an injection by flux, what flows out of its place over what flows in, about; only the inflow carries spheres.
    pub fn outflow(&self) -> Option<f64> {
        self.inflow.as_ref().map(Inflow::outflow)
    }

    /// How many particles it makes.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The plan it was made from.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Mass it injects in all, kg; `None` for a count, whose mass is the sum over its spheres.
    pub fn total_mass(&self) -> Option<f64> {
        self.parcel_mass.map(|m| m * self.count as f64)
    }

    /// The start of particle `i`, 0 ≤ `i` < [`Injection::count`];
    /// `fluid_velocity` is asked at its time and place, for [`Start::Fluid`], and wherever an injection by flux tries to start.
    pub fn particle(&self, i: u64, fluid_velocity: impl Fn(f64, [f64; 3]) -> [f64; 3]) -> Injected {
        self.particle_where(i, fluid_velocity, |_, _| true)
    }

    /// Likewise; `fits` says whether there is room for a sphere of a radius (m) at a place. In an opening, starts without room are drawn
    /// again, as an aerosol has none there.
    pub fn particle_where(
        &self,
        i: u64,
        fluid_velocity: impl Fn(f64, [f64; 3]) -> [f64; 3],
        fits: impl Fn([f64; 3], f64) -> bool,
    ) -> Injected {
        /// Draws after which an opening has no room at all.
        const MOST_DRAWS: u32 = 1000;
        let mut draws = Stream::new(self.seed, i, Purpose::Injection, self.index);
        let size = self.sampler.quantile(draws.open_uniform());
        let share = (i as f64 + draws.uniform()) / self.count as f64;
        let Window { start, stop } = self.plan.window;
        let time = start + (stop - start) * share;
        let density = self.plan.density;
        let diameter = match self.plan.diameter {
            Diameter::Geometric => size,
            Diameter::Aerodynamic(slip) => geometric_diameter(size, density, slip, self.fluid.mean_free_path),
        };
        let mut point = || match &self.inflow {
            Some(inflow) => inflow.point(&mut draws, |x| fluid_velocity(time, x)),
            None => self.place.point(&mut draws),
        };
        let (mut position, facing) = point();
        if let Source::Opening { inset, .. } = self.plan.source {
            let radius = 0.5 * diameter;
            let inside = |(x, facing): ([f64; 3], [f64; 3])| [0, 1, 2].map(|c| x[c] + inset * radius * facing[c]);
            position = inside((position, facing));
            for _ in 0..MOST_DRAWS {
                if fits(position, radius) {
                    break;
                }
                position = inside(point());
            }
        }
        let velocity = match self.plan.velocity {
            Start::Velocity(v) => v,
            Start::Fluid => fluid_velocity(time, position),
        };
        if let Source::Listed(list) = &self.plan.source
            && let Some(one) = usize::try_from(i).ok().and_then(|i| list.get(i))
        {
            let (position, time) = (one.position, one.time.unwrap_or(start));
            let velocity = one.velocity.unwrap_or_else(|| match self.plan.velocity {
                Start::Velocity(v) => v,
                Start::Fluid => fluid_velocity(time, position),
            });
            let diameter = one.diameter.unwrap_or(diameter);
            return Injected { position, velocity, spin: self.plan.spin, diameter, density, time, weight: one.weight };
        }
        let weight = self.parcel_mass.map_or(1.0, |m| m / Sphere { diameter, density }.mass());
        Injected { position, velocity, spin: self.plan.spin, diameter, density, time, weight }
    }
}

/// An injection that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InjectionError {
    /// A value out of its range.
    #[error("{name} is {value}; it must be {want}")]
    Value {
        /// What the value is for.
        name: &'static str,
        /// The value, SI.
        value: f64,
        /// What would be right.
        want: &'static str,
    },
    /// Something that has no extent or direction.
    #[error("{name} {what}")]
    Shape {
        /// What it is.
        name: &'static str,
        /// What is wrong with it.
        what: &'static str,
    },
}

impl InjectionError {
    fn value(name: &'static str, value: f64, want: &'static str) -> Self {
        Self::Value { name, value, want }
    }
}

fn positive(name: &'static str, value: f64) -> Result<(), InjectionError> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(InjectionError::value(name, value, "positive and finite"))
    }
}

fn finite(name: &'static str, value: f64) -> Result<(), InjectionError> {
    if value.is_finite() { Ok(()) } else { Err(InjectionError::value(name, value, "finite")) }
}

fn finite3(name: &'static str, value: [f64; 3]) -> Result<(), InjectionError> {
    value.into_iter().try_for_each(|c| finite(name, c))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan() -> Plan {
        Plan::single([0.0; 3], [1.0, 0.0, 0.0], 1e-5, 2000.0)
    }

    fn make(plan: Plan) -> Injection {
        Injection::new(3, 1, plan, &Fluid::default()).unwrap()
    }

    #[test]
    fn a_mass_flow_injects_its_mass_exactly() {
        let injection = make(Plan {
            sizes: Sizes::RosinRammler { mean: 60e-6, spread: 3.5, min: 5e-6, max: 200e-6, by: By::Mass },
            window: Window { start: 1.0, stop: 3.0 },
            amount: Amount::MassFlow { rate: 1e-6, parcels: 5000 },
            ..plan()
        });
        let mass: f64 = (0..injection.count())
            .map(|i| injection.particle(i, |_, x| x))
            .map(|p| p.weight * Sphere { diameter: p.diameter, density: p.density }.mass())
            .sum();
        assert!((mass / 2e-6 - 1.0).abs() < 1e-12, "{mass}");
        assert!((injection.total_mass().unwrap() / 2e-6 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn starts_fill_the_window_in_order() {
        let injection = make(Plan { window: Window { start: 1.0, stop: 3.0 }, amount: Amount::Count(100), ..plan() });
        for i in 0..100 {
            let t = injection.particle(i, |_, x| x).time;
            assert!(t >= 1.0 + 0.02 * i as f64 && t < 1.0 + 0.02 * (i + 1) as f64);
        }
        assert_eq!(make(plan()).particle(0, |_, x| x).time, 0.0);
    }

    #[test]
    fn velocity_of_the_fluid() {
        let source = Source::Box { low: [0.0; 3], high: [1.0; 3] };
        let injection = make(Plan { source, velocity: Start::Fluid, ..plan() });
        let p = injection.particle(0, |_, x| [2.0 * x[1], 0.0, 0.0]);
        assert_eq!(p.velocity, [2.0 * p.position[1], 0.0, 0.0]);
        assert_eq!(p.weight, 1.0);
    }

    #[test]
    fn injections_differ() {
        let source = Source::Box { low: [0.0; 3], high: [1.0; 3] };
        let plan = Plan { source, amount: Amount::Count(10), ..plan() };
        let a = Injection::new(3, 1, plan.clone(), &Fluid::default()).unwrap();
        for (seed, index, i) in [(4, 1, 5), (3, 2, 5), (3, 1, 6)] {
            let b = Injection::new(seed, index, plan.clone(), &Fluid::default()).unwrap();
            assert_ne!(a.particle(5, |_, x| x).position, b.particle(i, |_, x| x).position);
        }
    }

    #[test]
    fn errors_name_the_value() {
        let fails = |plan: Plan, want: &str| {
            let error = Injection::new(0, 0, plan, &Fluid::default()).unwrap_err().to_string();
            assert!(error.contains(want), "{error}");
        };
        fails(Plan { density: -1.0, ..plan() }, "sphere density is -1");
        fails(Plan { sizes: Sizes::Mono(0.0), ..plan() }, "diameter is 0");
        fails(Plan { amount: Amount::Count(0), ..plan() }, "at least 1");
        fails(Plan { amount: Amount::MassFlow { rate: 1.0, parcels: 1 }, ..plan() }, "needs a time to flow");
        fails(Plan { window: Window { start: 1.0, stop: 0.5 }, ..plan() }, "stop time is 0.5");
        fails(Plan { velocity: Start::Velocity([f64::NAN; 3]), ..plan() }, "start velocity is NaN");
        fails(
            Plan { sizes: Sizes::Lognormal { median: 1e-5, gsd: 0.5, by: By::Number }, ..plan() },
            "standard deviation is 0.5",
        );
        let source = Source::Disc { centre: [0.0; 3], normal: [0.0; 3], radius: 1.0 };
        fails(Plan { source, ..plan() }, "disc normal");
    }
}
