//! `carom capture --removal`: the friction velocities that take a captured sphere off the wall again.

use crate::failure::Failure;
use crate::law::Law;
use crate::text::{Lines, quantity, scaled};
use carom::removal::{Criterion, Fluid, Removal};
use carom::units::{Density, Viscosity};

/// The flags.
#[derive(clap::Args, Clone, Debug)]
pub struct RemovalArgs {
    /// Also the friction velocities at which a flow rolls, slides or lifts the captured sphere off
    #[arg(long, help_heading = "Removal")]
    removal: bool,
    /// Density of the fluid [default: air at 24 degC]
    #[arg(long, value_name = "DENSITY", help_heading = "Removal", requires = "removal")]
    fluid_density: Option<Density>,
    /// Dynamic viscosity of the fluid [default: air at 24 degC]
    #[arg(long, value_name = "VISCOSITY", help_heading = "Removal", requires = "removal")]
    fluid_viscosity: Option<Viscosity>,
}

/// The answer, keys as in the JSON.
#[derive(serde::Serialize)]
pub struct Answer {
    pull_off_force: f64,
    contact_radius: f64,
    adhesion_moment: f64,
    fluid_density: f64,
    fluid_viscosity: f64,
    rolling: Mode,
    sliding: Option<Mode>,
    lifting: Mode,
}

#[derive(serde::Serialize)]
struct Mode {
    friction_velocity: f64,
    wall_units: f64,
}

impl From<Criterion> for Mode {
    fn from(c: Criterion) -> Self {
        Self { friction_velocity: c.friction_velocity, wall_units: c.wall_units }
    }
}

impl RemovalArgs {
    /// Was it asked for?
    pub fn wanted(&self) -> bool {
        self.removal
    }

    /// The answer for a diameter in m.
    pub fn answer(&self, law: &Law, diameter: f64) -> Result<Option<Answer>, Failure> {
        if !self.removal {
            return Ok(None);
        }
        let fluid = self.fluid()?;
        let refused = |e: carom::ImpactError| Failure::input(format!("--diameter {}: {e}", scaled(diameter, "m")));
        let removal = law.wall.removal(diameter, &fluid).map_err(refused)?.ok_or_else(|| {
            Failure::input("--removal: nothing holds this sphere; give a sphere and a surface that adhere")
        })?;
        let Removal { pull_off_force, contact_radius, adhesion_moment, rolling, sliding, lifting } = removal;
        Ok(Some(Answer {
            pull_off_force,
            contact_radius,
            adhesion_moment,
            fluid_density: fluid.density,
            fluid_viscosity: fluid.viscosity,
            rolling: rolling.into(),
            // a friction that was not given is no friction of zero
            sliding: sliding.filter(|_| law.has_friction).map(Mode::from),
            lifting: lifting.into(),
        }))
    }

    fn fluid(&self) -> Result<Fluid, Failure> {
        let air = carom_track::flow::Fluid::default();
        let fluid = Fluid {
            density: self.fluid_density.map_or(air.density, |d| d.0),
            viscosity: self.fluid_viscosity.map_or(air.viscosity, |v| v.0),
        };
        for (flag, value) in [("--fluid-density", fluid.density), ("--fluid-viscosity", fluid.viscosity)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Failure::input(format!("{flag} {value}: a positive value is wanted")));
            }
        }
        Ok(fluid)
    }
}

impl Answer {
    /// Adds it as lines.
    pub fn tell(&self, lines: &mut Lines) {
        let held = format!(
            "pull-off {}, contact radius {}",
            scaled(self.pull_off_force, "N"),
            scaled(self.contact_radius, "m")
        );
        lines.add("held by", held);
        let mode = |m: &Mode| {
            let place = if m.wall_units < 5.0 {
                String::new()
            } else {
                format!(" (d+ = {:.1}, outside the viscous sublayer: an extrapolation)", m.wall_units)
            };
            format!("friction velocity {}{place}", quantity(m.friction_velocity, "m/s"))
        };
        lines.add("rolls off at", mode(&self.rolling));
        lines.add("slides off at", self.sliding.as_ref().map_or_else(|| "needs --friction".to_owned(), mode));
        lines.add("lifts off at", mode(&self.lifting));
    }
}
