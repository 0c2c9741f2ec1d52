//! How the sphere comes: its size, speed, angle and spin; and what one impact makes of it.

use crate::failure::Failure;
use crate::law::{Law, LawArgs};
use crate::text::scaled;
use crate::values;
use carom::ImpactError;
pub use carom::plane::{Met, Motion};
use carom::study::{Distribution, Given};

/// The flags of an impact: a wall law and a motion.
#[derive(clap::Args, Clone, Debug, Default)]
pub struct ImpactArgs {
    #[command(flatten)]
    pub motion: MotionArgs,
    #[command(flatten)]
    pub law: LawArgs,
}

/// The motion's flags.
#[derive(clap::Args, Clone, Debug, Default)]
pub struct MotionArgs {
    /// Diameter of the sphere, such as 90um; `carom sweep` and `capture` take a distribution too
    #[arg(long, value_name = "LENGTH", help_heading = "Impact", value_parser = values::diameters)]
    pub diameter: Option<Given>,
    /// Speed of approach, such as 2m/s
    #[arg(long, value_name = "SPEED", help_heading = "Impact", value_parser = values::speed)]
    pub speed: Option<f64>,
    /// Angle of approach from the surface, degrees; 90 is head-on [default: 90]
    #[arg(long, value_name = "DEG", help_heading = "Impact", value_parser = values::angle)]
    pub angle: Option<f64>,
    /// Spin before the impact, rad/s; positive rolls forward along the tangential velocity [default: 0]
    #[arg(long, value_name = "SPIN", help_heading = "Impact", value_parser = values::spin)]
    pub spin: Option<f64>,
}

impl MotionArgs {
    /// The motion, complete.
    pub fn complete(&self) -> Result<Motion, Failure> {
        self.with_diameter(self.wanted_diameter()?)
    }

    /// The motion of a sphere of that diameter.
    pub fn with_diameter(&self, diameter: f64) -> Result<Motion, Failure> {
        Ok(Motion {
            diameter,
            speed: self.speed.ok_or_else(|| {
                Failure::input("--speed is missing; give the speed of approach, such as --speed 2m/s")
            })?,
            angle: self.angle.unwrap_or(90.0),
            spin: self.spin.unwrap_or(0.0),
        })
    }

    /// The diameter alone.
    pub fn wanted_diameter(&self) -> Result<f64, Failure> {
        match self.wanted_diameters()? {
            Given::One(diameter) => Ok(*diameter),
            Given::Drawn(d) => Err(one_wanted("diameter", d)),
        }
    }

    /// The diameter, or its distribution.
    pub fn wanted_diameters(&self) -> Result<&Given, Failure> {
        self.diameter
            .as_ref()
            .ok_or_else(|| Failure::input("--diameter is missing; give the sphere's diameter, such as --diameter 90um"))
    }

    /// Does friction act: is there a tangential speed or a spin?
    pub fn is_oblique(&self) -> bool {
        self.angle.is_some_and(|a| a != 90.0) || self.spin.is_some_and(|s| s != 0.0)
    }
}

/// A distribution where one value is wanted.
pub fn one_wanted(flag: &str, distribution: &Distribution) -> Failure {
    Failure::input(format!(
        "--{flag} {distribution}: one value is wanted here; distributions go with `carom sweep` and `carom capture`"
    ))
}

/// An impact the core refused, in terms of the flags.
pub fn refused(error: ImpactError, motion: &Motion) -> Failure {
    let Motion { diameter, speed, angle, spin } = *motion;
    let what = match error {
        ImpactError::NotApproaching => format!("--speed {speed} at --angle {angle}"),
        ImpactError::Curvature | ImpactError::Diameter => format!("--diameter {}", scaled(diameter, "m")),
        ImpactError::NotFinite => format!("--speed {speed}, --spin {spin}"),
        ImpactError::Density => "the sphere's density".to_owned(),
        ImpactError::FrictionNotGiven => "an oblique impact needs --friction".to_owned(),
        _ => "this impact".to_owned(),
    };
    Failure::input(format!("{what}: {error}"))
}

/// The critical angle in degrees, `None` where friction was not given or does not rule.
pub fn critical_angle(law: &Law, motion: &Motion) -> Option<f64> {
    if !law.has_friction {
        return None;
    }
    law.wall.critical_angle(motion.diameter, None, motion.speed).ok().flatten().map(f64::to_degrees)
}
