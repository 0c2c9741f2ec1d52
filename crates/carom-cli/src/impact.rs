//! `carom impact`: one impact, told in a few lines or as JSON.

use crate::failure::Failure;
use crate::law::Law;
use crate::motion::{ImpactArgs, Met, Motion, critical_angle, refused};
use crate::output::{self, Files};
use crate::text::{Lines, number, percent, quantity};
use crate::warnings::{Warnings, Yielding};
use crate::{figures, history};
use carom::WallLaw;
use std::fmt::Write as _;
use std::path::PathBuf;

const EXAMPLE: &str = "\
Examples:
  carom impact --sphere copper --surface aluminium --diameter 90um --speed 2 --angle 30 --friction 0.2
  carom impact --sphere rho=2500,E=70GPa,nu=0.22 --surface silicon --work-of-adhesion 0.1J/m2 \
    --diameter 10um --speed 1m/s
  carom impact --wall-law walls.toml:glass --diameter 90um --speed 2 --json

Quantities take a unit (90um, 2m/s, 190GPa) or are SI numbers; angles are degrees from the surface.";

/// Compute one impact: capture or rebound, with the speed, angle and spin after the rebound
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    #[command(flatten)]
    case: ImpactArgs,
    /// Print one JSON object, SI units, angles in degrees
    #[arg(long, help_heading = "Output")]
    json: bool,
    /// Resolved law: write the contact's time history (.csv, .parquet or .json)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    history: Option<PathBuf>,
    /// Resolved law: draw the force over the contact's time (.svg or .png)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<(), Failure> {
    let motion = args.case.motion.complete()?;
    let files = Files::check(args.history.as_ref(), args.plot.as_ref())?;
    if files.to_stdout() {
        return Err(Failure::input("--history -: the answer goes to standard output; name a file"));
    }
    let law = args.case.law.compile(args.case.motion.is_oblique())?;
    let met = motion.meet(&law.wall).map_err(|e| refused(e, &motion))?;
    let answer = Answer::new(&law, &motion, &met)?;
    if files.any() {
        let moments = history::moments(&law, &motion)?;
        files.write(|| history::table(&moments), || history::plot(&moments, &law, &motion))?;
    }
    if args.json { output::print_json(&answer) } else { output::print(&tell(&answer, &law, &motion, &met)) }
}

/// The answer in a few lines, for other fronts.
pub fn printed(law: &Law, motion: &Motion, met: &Met) -> Result<String, Failure> {
    Ok(tell(&Answer::new(law, motion, met)?, law, motion, met))
}

/// The object that `--json` prints; its keys are a contract.
#[derive(serde::Serialize)]
struct Answer {
    fate: &'static str,
    restitution: f64,
    impulse_ratio: f64,
    tangential_restitution: f64,
    contact: &'static str,
    rebound: Rebound,
    capture_velocity: Option<f64>,
    exhausted_velocity: Option<f64>,
    yield_velocity: Option<f64>,
    critical_angle_deg: Option<f64>,
    energy: Energy,
    validity: Vec<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    above_yield: Option<Yielding>,
    law: String,
    roughness_factor: f64,
    adhesion_numbers: Option<figures::AdhesionNumbers>,
    pair: Option<figures::Pair>,
    incidence: Incidence,
}

/// Shares by name, in their order.
struct Energy(carom::Energy);

impl serde::Serialize for Energy {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.named())
    }
}

#[derive(serde::Serialize)]
struct Rebound {
    normal: f64,
    tangential: f64,
    spin: f64,
    angle_deg: f64,
}

#[derive(serde::Serialize)]
struct Incidence {
    diameter: f64,
    speed: f64,
    angle_deg: f64,
    normal: f64,
    tangential: f64,
    spin: f64,
}

impl Answer {
    fn new(law: &Law, motion: &Motion, met: &Met) -> Result<Self, Failure> {
        let out = &met.outcome;
        let figures = figures::Figures::new(&law.wall, motion.diameter)?;
        let (normal, tangential) = motion.components();
        Ok(Self {
            fate: out.fate.name(),
            restitution: out.restitution,
            impulse_ratio: out.impulse_ratio,
            tangential_restitution: out.tangential_restitution,
            contact: out.contact.name(),
            rebound: Rebound { normal: met.normal, tangential: met.tangential, spin: met.spin, angle_deg: met.angle() },
            capture_velocity: figures.capture_velocity,
            exhausted_velocity: figures.exhausted_velocity,
            yield_velocity: figures.yield_velocity,
            critical_angle_deg: critical_angle(law, motion),
            energy: Energy(out.energy),
            validity: out.validity.codes().collect(),
            above_yield: warnings(law, motion, met).yielding(),
            law: law.normal_name(),
            roughness_factor: figures.roughness_factor,
            adhesion_numbers: figures.adhesion_numbers,
            pair: figures.pair,
            incidence: Incidence {
                diameter: motion.diameter,
                speed: motion.speed,
                angle_deg: motion.angle,
                normal,
                tangential,
                spin: motion.spin,
            },
        })
    }
}

fn warnings(law: &Law, motion: &Motion, met: &Met) -> Warnings {
    Warnings::new(&law.wall, met.outcome.validity, motion.components().0, motion.diameter)
}

/// The answer in a few lines.
fn tell(answer: &Answer, law: &Law, motion: &Motion, met: &Met) -> String {
    let plastic = |eap: &WallLaw| {
        let met = motion.meet(eap).ok()?;
        Some(if met.rebounds() {
            format!("restitution {}", number(met.outcome.restitution))
        } else {
            "capture".to_owned()
        })
    };
    let mut text = format!("{}{}\n\n", law.heading(motion.diameter), law.by_default(plastic));
    let verdict = if met.rebounds() { "It rebounds" } else { "It is captured" };
    let _ = writeln!(text, "{verdict}: restitution {}\n", number(answer.restitution));
    text += &before_and_after(answer, motion, met);
    text.push('\n');
    let mut lines = Lines::default();
    if met.rebounds() && (answer.impulse_ratio != 0.0 || answer.contact != "none") {
        let mut contact = match answer.contact {
            "none" => String::new(),
            way => format!("{way}, "),
        };
        let _ = write!(contact, "impulse ratio {}", number(answer.impulse_ratio));
        if answer.tangential_restitution.is_finite() {
            let _ = write!(contact, ", tangential restitution {}", number(answer.tangential_restitution));
        }
        lines.add("contact", contact);
    }
    if let Some(angle) = answer.critical_angle_deg {
        lines.add("critical angle", format!("{} (without spin, it slides to the end below)", quantity(angle, "deg")));
    }
    figures::Figures::new(&law.wall, motion.diameter).map(|f| f.tell(&mut lines)).ok();
    if let Some(scatter) = law.wall.scatter() {
        let angle = quantity(scatter.deviation().to_degrees(), "deg");
        lines.add("rough", format!("roughness angle {angle}: this is the impact on the median facet; e and the angles are against the mean wall"));
    }
    lines.add("energy", shares(met));
    if let Some(typical) = law.typical() {
        lines.add("typical", typical);
    }
    warnings(law, motion, met).tell(&mut lines);
    text + &lines.to_string()
}

fn before_and_after(answer: &Answer, motion: &Motion, met: &Met) -> String {
    let i = &answer.incidence;
    let mut rows = vec![["".to_owned(), "before".to_owned(), "after".to_owned()]];
    let mut row = |label: &str, before: f64, after: f64, unit: &str| {
        let after = if after.is_nan() { "-".to_owned() } else { quantity(after, unit) };
        rows.push([label.to_owned(), quantity(before, unit), after]);
    };
    row("speed", motion.speed, met.speed(), "m/s");
    if i.tangential != 0.0 || met.tangential != 0.0 {
        row("normal", i.normal, met.normal, "m/s");
        row("tangential", i.tangential, met.tangential, "m/s");
        row("angle", motion.angle, met.angle(), "deg");
    }
    if motion.spin != 0.0 || met.spin != 0.0 {
        row("spin", motion.spin, met.spin, "rad/s");
    }
    let width = |column: usize| rows.iter().map(|r| r[column].chars().count()).max().unwrap_or(0);
    let (first, second) = (width(0), width(1));
    rows.iter().map(|[a, b, c]| format!("{}\n", format!("{a:first$}  {b:second$}  {c}").trim_end())).collect()
}

/// The shares of the energy that are more than rounding, what is kept first.
fn shares(met: &Met) -> String {
    let mut named = met.outcome.energy.named();
    named.rotate_right(1);
    let shares = named.into_iter().filter(|(_, share)| *share > 1e-9);
    shares.map(|(name, share)| format!("{} {}", name.replace('_', " "), percent(share))).collect::<Vec<_>>().join(", ")
}
