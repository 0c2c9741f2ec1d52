//! Numbers: rows, maps, histories and figures of a law, as the command computes them.

use crate::words::{self, Fields};
use carom::impact::components;
use carom::material::Library;
use carom::normal::{NormalLaw, Size};
use carom::plane::{Met, Motion};
use carom::resolved::Scales;
use carom::spec::{Key, LawSpec, parse_law};
use carom::study::{Sampling, sampled};
use carom::tangential::{Contact, Tangential};
use carom::{Fate, Impact, ImpactError, Outcome, Validity, WallLaw};
use std::borrow::Cow;

/// Numbers of a row: the swept value, fate (1 rebound, 0 capture), restitution, normal and tangential speed out, spin out, angle out
/// (degrees), impulse ratio, tangential restitution, contact (0 none, 1 sliding, 2 rolling, 3 micro-slip), the eight shares of energy
/// in the order of [`carom::Energy::named`], bits of validity.
pub const COLUMNS: usize = 19;

/// Moments of a contact at least.
const MOMENTS: usize = 600;

/// A law that answers, and what was written.
#[derive(Clone, Debug)]
pub struct Slot {
    /// The compiled law.
    pub wall: WallLaw,
    spec: LawSpec,
    oblique: bool,
}

/// What runs along a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Swept {
    /// m/s
    Speed,
    /// m
    Diameter,
    /// degrees
    Angle,
    /// A number of the law, in SI units.
    Key(Key),
}

impl Swept {
    /// 0 the speed, 1 the diameter, 2 the angle, from 3 on the law's keys in their order.
    pub(crate) fn of(number: u32) -> Option<Self> {
        let number = number as usize;
        let keys = || Key::ALL.get(number - 3).map(|key| Self::Key(*key));
        [Self::Speed, Self::Diameter, Self::Angle].get(number).copied().or_else(keys)
    }

    fn at(self, value: f64, motion: &Motion) -> Motion {
        match self {
            Self::Speed => Motion { speed: value, ..*motion },
            Self::Diameter => Motion { diameter: value, ..*motion },
            Self::Angle => Motion { angle: value, ..*motion },
            Self::Key(_) => *motion,
        }
    }
}

fn contact(contact: Contact) -> f64 {
    match contact {
        Contact::None => 0.0,
        Contact::Sliding => 1.0,
        Contact::Rolling => 2.0,
        Contact::MicroSlip => 3.0,
    }
}

fn fate(out: &Outcome) -> f64 {
    if out.fate == Fate::Rebound { 1.0 } else { 0.0 }
}

impl Slot {
    /// Reads and compiles a law.
    ///
    /// # Errors
    /// What is wrong, in the words of the page.
    pub fn read(text: &str, oblique: bool) -> Result<Self, String> {
        let spec = parse_law(text).map_err(|e| e.said_in(&Fields))?;
        Self::compile(spec, oblique)
    }

    fn compile(spec: LawSpec, oblique: bool) -> Result<Self, String> {
        let said = |e: carom::LawError| e.said_in(&Fields);
        let wall = spec.compile(Library::builtin()).map_err(said)?;
        if oblique {
            wall.require_friction().map_err(said)?;
        }
        Ok(Self { wall, spec, oblique })
    }

    /// The law with another value of a key.
    fn with(&self, key: Key, value: f64) -> Result<Self, String> {
        let mut spec = self.spec.clone();
        if !spec.set_number(key, value) {
            return Err(format!("the field '{}' is no number that could run", key.name().replace('_', " ")));
        }
        Self::compile(spec, self.oblique)
    }

    fn meet(&self, motion: &Motion) -> Result<Met, String> {
        motion.meet(&self.wall).map_err(|e| words::refused(e, motion))
    }

    /// The impact of 18 numbers, see [`crate::impact`].
    pub(crate) fn impact(&self, numbers: &[f64]) -> Result<Vec<f64>, String> {
        let [diameter, density, rest @ ..] = numbers else { return Err("an impact is 18 numbers".to_owned()) };
        let (vectors, rest) = rest.as_chunks::<3>();
        let ([velocity, spin, normal, wall_velocity, first], [last]) = (vectors, rest) else {
            return Err("an impact is 18 numbers".to_owned());
        };
        let mut impact = Impact::new(*diameter, *velocity, *normal);
        impact.density = (!density.is_nan()).then_some(*density);
        (impact.spin, impact.wall_velocity) = (*spin, *wall_velocity);
        impact.draws = [first[0], first[1], first[2], *last];
        let out = self.wall.impact(&impact).map_err(|e| e.to_string())?;
        let mut row = vec![fate(&out)];
        row.extend(out.velocity.iter().chain(&out.spin));
        row.extend([out.restitution, out.impulse_ratio, out.tangential_restitution, contact(out.contact)]);
        row.extend(out.energy.named().map(|(_, share)| share));
        row.push(f64::from(out.validity.bits()));
        Ok(row)
    }

    /// A row of [`COLUMNS`] numbers for each value.
    ///
    /// # Errors
    /// The first value at which there is no impact.
    pub fn sweep(&self, swept: Swept, values: &[f64], motion: &Motion) -> Result<Vec<f64>, String> {
        let mut rows = Vec::with_capacity(values.len() * COLUMNS);
        for &value in values {
            let motion = swept.at(value, motion);
            let met = match swept {
                Swept::Key(key) => self.with(key, value)?.meet(&motion)?,
                _ => self.meet(&motion)?,
            };
            let out = &met.outcome;
            rows.extend([value, fate(out), out.restitution, met.normal, met.tangential, met.spin, met.angle()]);
            rows.extend([out.impulse_ratio, out.tangential_restitution, contact(out.contact)]);
            rows.extend(out.energy.named().map(|(_, share)| share));
            rows.push(f64::from(out.validity.bits()));
        }
        Ok(rows)
    }

    /// What a wall that scatters makes of `samples` spheres at each value, as the command's `--samples` with its own seed: rows of the
    /// value, the probability of sticking, and median, 5 % and 95 % of restitution, tangential restitution, impulse ratio.
    ///
    /// # Errors
    /// A law that does not scatter, a key that runs, or no impact.
    pub fn spread(&self, swept: Swept, values: &[f64], motion: &Motion, samples: u32) -> Result<Vec<f64>, String> {
        if self.wall.scatter().is_none() || matches!(swept, Swept::Key(_)) {
            return Err(
                "spreads are those of a law with a roughness angle, along a speed, a diameter or an angle".to_owned()
            );
        }
        let sampling = Sampling { samples, seed: 1 };
        let law = |_| Ok::<_, String>(Cow::Borrowed(&self.wall));
        let found = sampled(&sampling, values.len(), law, |wall, sample, point| {
            let motion = swept.at(values[point], motion);
            let met = motion.meet_drawn(wall, sampling.impact(sample)).map_err(|e| words::refused(e, &motion))?;
            let out = &met.outcome;
            Ok((!met.rebounds(), [out.restitution, out.tangential_restitution, out.impulse_ratio]))
        })?;
        let row = |(n, value): (usize, &f64)| {
            let bands = found.bands.iter().flat_map(move |b| [b[n].median, b[n].low, b[n].high]);
            [*value, found.sticking[n].value].into_iter().chain(bands)
        };
        Ok(values.iter().enumerate().flat_map(row).collect())
    }

    /// Region and bits of validity for each speed, diameter by diameter.
    ///
    /// # Errors
    /// A cell that is no impact.
    pub fn map(&self, speeds: &[f64], diameters: &[f64], angle: f64, spin: f64) -> Result<Vec<f64>, String> {
        let mut cells = Vec::with_capacity(2 * speeds.len() * diameters.len());
        for &diameter in diameters {
            let own = self.wall.yield_velocity(diameter, None).ok().flatten();
            for &speed in speeds {
                let motion = Motion { diameter, speed, angle, spin };
                let out = self.meet(&motion)?.outcome;
                let yields = || {
                    own.is_some_and(|v| components(speed, angle).0 > v) || out.validity.contains(Validity::ABOVE_YIELD)
                };
                let region = match out.fate {
                    Fate::Capture => 0.0,
                    Fate::Rebound if yields() => 2.0,
                    Fate::Rebound => 1.0,
                };
                cells.extend([region, f64::from(out.validity.bits())]);
            }
        }
        Ok(cells)
    }

    /// The contact in time.
    ///
    /// # Errors
    /// A law that is not `resolved`, or whose slip is not followed.
    pub fn history(&self, motion: &Motion) -> Result<Vec<f64>, String> {
        let (NormalLaw::Resolved(resolved), Some(pair)) = (self.wall.normal(), self.wall.pair()) else {
            return Err("the contact in time is what the law resolved follows".to_owned());
        };
        let said = |e: carom::LawError| e.said_in(&Fields);
        let scales = Scales { stiffness: pair.stiffness().map_err(said)?, density: pair.density().map_err(said)? };
        // what is no impact has no history
        self.meet(motion)?;
        let radius = 0.5 * motion.diameter;
        let curvature = self.spec.surface_curvature.as_ref().map_or(0.0, |r| 1.0 / r.value.0);
        let size = Size { kappa: 1.0 / (1.0 + radius * curvature), ..Size::flat(radius) };
        let friction = match self.wall.tangential() {
            Tangential::Friction { friction, .. } => *friction,
            Tangential::MicroSlip(_) => {
                return Err("the slip in time is followed with the tangential law rolling alone".to_owned());
            }
            _ => 0.0,
        };
        let (normal, tangential) = components(motion.speed, motion.angle);
        let moments = resolved.history(normal, &size, &scales, tangential - radius * motion.spin, friction, MOMENTS);
        Ok(moments.iter().flat_map(|m| [m.time, m.overlap, m.speed, m.hertz_force, m.net_force, m.slip]).collect())
    }

    /// The figures of [`crate::figures`].
    pub(crate) fn figures(&self, motion: &Motion) -> Result<Vec<f64>, String> {
        let said = |e: ImpactError| words::refused(e, motion);
        let window = self.wall.window(motion.diameter, None).map_err(said)?;
        let numbers = self.wall.adhesion_numbers(motion.diameter).map_err(said)?;
        let own = self.wall.yield_velocity(motion.diameter, None).map_err(said)?;
        // the yield velocity does not depend on the speed, and is told above it
        let theirs = self.wall.above_yield(1e8, motion.diameter, None).map_err(said)?;
        let angle = match self.spec.is_given(Key::Friction) {
            true => self.wall.critical_angle(motion.diameter, None, motion.speed).map_err(said)?,
            false => None,
        };
        let pair = self.wall.pair();
        let found = [
            window.map(|w| w.capture_velocity),
            window.map(|w| w.exhausted_velocity).filter(|v| v.is_finite()),
            own,
            theirs.map(|y| y.yield_velocity),
            angle.map(f64::to_degrees),
            Some(self.wall.roughness_factor()),
            numbers.as_ref().map(|n| n.tabor),
            numbers.as_ref().and_then(|n| n.adhesion_parameter),
            pair.and_then(|p| p.stiffness().ok()),
            pair.and_then(|p| p.work_of_adhesion().ok()),
            pair.and_then(|p| p.plastic_constant().ok()),
            pair.and_then(|p| p.density().ok()),
        ];
        Ok(found.map(|v| v.unwrap_or(f64::NAN)).to_vec())
    }

    /// The warnings of an impact, as a list in JSON of code and words.
    pub(crate) fn warnings(&self, motion: &Motion) -> Result<String, String> {
        let out = self.meet(motion)?.outcome;
        let normal = components(motion.speed, motion.angle).0;
        let numbers = self.wall.above_yield(normal, motion.diameter, None).ok().flatten();
        Ok(words::warnings(out.validity, numbers.as_ref()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: &str =
        "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nroughness_factor = 0.15\nfriction = 0.2\n";
    const MOTION: Motion = Motion { diameter: 70e-6, speed: 2.0, angle: 35.0, spin: 100.0 };

    fn law(rest: &str) -> Slot {
        Slot::read(&format!("{STEEL}{rest}\n"), true).expect("it compiles")
    }

    #[test]
    fn a_row_is_the_cores_impact() {
        let slot = law("normal = \"ea\"");
        let row = slot.sweep(Swept::Speed, &[3.0], &MOTION).expect("it approaches");
        let out = slot.wall.impact(&Motion { speed: 3.0, ..MOTION }.impact()).expect("it approaches");
        assert_eq!(row.len(), COLUMNS);
        assert_eq!([row[2], row[3], row[4], row[5]], [out.restitution, out.velocity[1], out.velocity[0], -out.spin[2]]);
        let shares: f64 = row[10..18].iter().sum();
        assert!((shares - 1.0).abs() < 1e-12, "{shares}");
    }

    #[test]
    fn a_key_runs_as_if_it_were_written() {
        let rows = law("normal = \"ea\"").sweep(Swept::Key(Key::RoughnessFactor), &[0.3, 0.9], &MOTION).expect("rows");
        let written = |c: f64| {
            let text = STEEL.replace("0.15", &c.to_string()) + "normal = \"ea\"\n";
            Slot::read(&text, true).and_then(|s| s.meet(&MOTION)).expect("it approaches").outcome.restitution
        };
        assert_eq!([rows[2], rows[COLUMNS + 2]], [written(0.3), written(0.9)]);
        assert!(rows[2] > rows[COLUMNS + 2], "less contact, less adhesion");
        let refused = law("normal = \"ea\"").sweep(Swept::Key(Key::YieldVelocity), &[1.0], &MOTION);
        assert!(refused.is_err_and(|e| e.contains("yield velocity")));
    }

    #[test]
    fn a_wall_that_scatters_has_a_spread_and_a_smooth_one_has_none() {
        assert!(law("normal = \"ea\"").spread(Swept::Speed, &[1.0], &MOTION, 10).is_err());
        let rows = law("normal = \"ea\"\nroughness_angle = \"5 deg\"")
            .spread(Swept::Speed, &[1.0, 5.0], &MOTION, 200)
            .expect("rows");
        assert_eq!(rows.len(), 2 * 11);
        for row in rows.chunks(11) {
            assert!((0.0..=1.0).contains(&row[1]) && row[3] <= row[2] && row[2] <= row[4], "{row:?}");
        }
        assert!(rows[11 + 4] > rows[11 + 3], "it spreads");
    }

    #[test]
    fn the_map_turns_where_the_figures_say() {
        let slot = law("normal = \"eap\"");
        let figures = slot.figures(&MOTION).expect("figures");
        let (capture, yielding) = (figures[0], figures[2]);
        assert!(0.0 < capture && capture < 50.0 && yielding > 0.0);
        let speeds = [0.999 * capture, 1.001 * capture, 1.001 * capture.max(yielding)];
        let cells = slot.map(&speeds, &[70e-6], 90.0, 0.0).expect("cells");
        assert_eq!(cells[0], 0.0);
        assert!(cells[2] >= 1.0);
        assert_eq!(cells[4], 2.0);
    }

    #[test]
    fn only_a_resolved_contact_has_a_history_and_it_ends_as_the_impact_does() {
        assert!(law("normal = \"ea\"").history(&MOTION).is_err());
        let slot = law("normal = \"resolved\"");
        let moments = slot.history(&MOTION).expect("it has one");
        let last = &moments[moments.len() - 6..];
        let out = slot.wall.impact(&MOTION.impact()).expect("it approaches");
        assert!((-last[2] - out.velocity[1]).abs() < 1e-8, "{} {}", last[2], out.velocity[1]);
    }

    #[test]
    fn mistakes_are_told_in_the_pages_words() {
        let said = |text: &str, oblique| Slot::read(text, oblique).err().unwrap_or_default();
        assert_eq!(
            said("sphere = \"coper\"\nsurface = \"glass\"\nnormal = \"ea\"\n", false),
            "unknown material 'coper'; did you mean copper? the list of the field shows all; properties may be given in place as rho=...,E=...,nu=..."
        );
        let friction = said("sphere = \"copper\"\nsurface = \"glass\"\nnormal = \"ea\"\n", true);
        assert!(friction.contains("give friction: 0.2"), "{friction}");
        assert!(said("normal = 3 4", false).len() > 10);
    }
}
