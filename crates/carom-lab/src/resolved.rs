//! The algebraic form (Kim & Dunn 2007, Eqs 21–24) against the equation of motion that it stands for (Eqs 4, 8–12), for the
//! pair and the damping that the paper prints: 70 µm stainless steel on silicon, C_R = 0.15, C_A = 1.3 s/m, C_H = 0.007 s/m.
//!
//! Without damping and with adhesion acting while the surfaces separate, both are the same to the integrator's tolerance. With
//! damping the algebraic form is a quadrature of first order: it counts 0.907 C_H v of Hertzian damping where the motion loses
//! 4/3 C_H v, and Ψ_A C_A v of adhesion damping where it loses 0.757 of that (limits for weak adhesion).

use crate::error::LabError;
use carom::material::Library;
use carom::spec::parse_law;
use carom::{Impact, WallLaw};
use carom_report::plot::Legend;
use carom_report::{Axis, Plot, Series};
use serde::Serialize;

/// Diameter, m.
pub const DIAMETER: f64 = 70e-6;

/// The laws' common part.
pub const INPUTS: &str = "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nroughness_factor = 0.15\nfriction = 0.2\n\
                          work_of_adhesion = \"3.03 J/m2\"\n";

/// The damping that Kim & Dunn 2007 print with Fig. 8.
pub const DAMPING: &str = "adhesion_damping = \"1.3 s/m\"\nhertz_damping = \"0.007 s/m\"\n";

/// Restitution at a speed, in every form.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Row {
    /// m/s.
    pub speed: f64,
    /// Algebraic, undamped.
    pub algebraic: f64,
    /// Resolved, adhesion while separating, undamped.
    pub resolved: f64,
    /// Algebraic, damped.
    pub algebraic_damped: f64,
    /// Resolved, adhesion while separating, damped.
    pub resolved_damped: f64,
    /// Resolved, adhesion always (Eq. 4 as printed), damped.
    pub reversible_damped: f64,
}

/// The forms along the speed.
#[derive(Clone, Debug, Serialize)]
pub struct Forms {
    /// The rows of the table, and of the plot.
    pub rows: Vec<Row>,
    /// Greatest |algebraic − resolved| without damping (separation-only).
    pub undamped: f64,
    /// The same with damping, from 0.03 to 0.1 m/s, near capture.
    pub damped_slow: f64,
    /// From 0.1 to 25 m/s.
    pub damped: f64,
    /// From 25 to 100 m/s, where the damping's own range ends.
    pub damped_fast: f64,
    /// Greatest |algebraic − reversible| with damping, from 0.1 to 25 m/s.
    pub reversible: f64,
}

struct Laws([WallLaw; 5]);

impl Laws {
    fn new(library: &Library) -> Result<Self, LabError> {
        let law = |normal: &str, damping: &str| {
            let text = format!("{INPUTS}{normal}{damping}");
            let law = parse_law(&text).and_then(|l| l.compile(library));
            law.map_err(|error| LabError::Experiment { name: "the resolved form".into(), text, error })
        };
        let (ea, separation) = ("normal = \"ea\"\n", "normal = \"resolved\"\n");
        let reversible = "normal = \"resolved\"\nadhesion = \"reversible\"\n";
        Ok(Self([
            law(ea, "")?,
            law(separation, "")?,
            law(ea, DAMPING)?,
            law(separation, DAMPING)?,
            law(reversible, DAMPING)?,
        ]))
    }

    fn row(&self, speed: f64) -> Result<Row, LabError> {
        let mut e = [0.0; 5];
        for (law, e) in self.0.iter().zip(&mut e) {
            let out = law.impact(&Impact::new(DIAMETER, [0.0, -speed, 0.0], [0.0, 1.0, 0.0]));
            *e = out.map_err(|e| LabError::Model(format!("the resolved form at {speed} m/s: {e}")))?.restitution;
        }
        let [algebraic, resolved, algebraic_damped, resolved_damped, reversible_damped] = e;
        Ok(Row { speed, algebraic, resolved, algebraic_damped, resolved_damped, reversible_damped })
    }
}

/// Computes the forms from 0.03 to 100 m/s.
///
/// # Errors
/// Materials that the library lacks.
pub fn forms(library: &Library) -> Result<Forms, LabError> {
    let laws = Laws::new(library)?;
    let rows = (0..=84)
        .map(|n| laws.row(0.03 * (100.0f64 / 0.03).powf(f64::from(n) / 84.0)))
        .collect::<Result<Vec<_>, _>>()?;
    let worst = |from: f64, to: f64, get: fn(&Row) -> f64| {
        rows.iter().filter(|r| (from..=to).contains(&r.speed)).map(|r| get(r).abs()).fold(0.0, f64::max)
    };
    let damped = |from: f64, to: f64| worst(from, to, |r| r.algebraic_damped - r.resolved_damped);
    Ok(Forms {
        undamped: worst(0.0, f64::INFINITY, |r| r.algebraic - r.resolved),
        damped_slow: damped(0.0, 0.1),
        damped: damped(0.1, 25.0),
        damped_fast: damped(25.0, f64::INFINITY),
        reversible: worst(0.1, 25.0, |r| r.algebraic_damped - r.reversible_damped),
        rows,
    })
}

/// Restitution of every form.
pub fn plot(forms: &Forms) -> Plot {
    let line = |label: &str, get: fn(&Row) -> f64| {
        Series::line(label, forms.rows.iter().map(|r| r.speed), forms.rows.iter().map(get))
    };
    Plot::new(
        "Stainless steel on silicon, 70 µm",
        Axis::new("normal approach speed", "m/s").log().range(0.02, 100.0),
        Axis::new("restitution", "").range(0.0, 1.05),
    )
    .with(line("algebraic", |r| r.algebraic))
    .with(line("resolved, adhesion while separating", |r| r.resolved).dotted())
    .with(line("algebraic, damped", |r| r.algebraic_damped))
    .with(line("resolved, adhesion while separating, damped", |r| r.resolved_damped).dashed())
    .with(line("resolved, adhesion always (Eq. 4), damped", |r| r.reversible_damped).dashed())
    .legend(Legend::LowerRight)
}

/// Algebraic minus resolved.
pub fn difference(forms: &Forms) -> Plot {
    let line = |label: &str, get: fn(&Row) -> f64| {
        Series::line(label, forms.rows.iter().map(|r| r.speed), forms.rows.iter().map(get))
    };
    Plot::new(
        "How far off the algebraic form is",
        Axis::new("normal approach speed", "m/s").log().range(0.02, 100.0),
        Axis::new("restitution, algebraic minus resolved", ""),
    )
    .with(line("undamped, adhesion while separating", |r| r.algebraic - r.resolved))
    .with(line("damped, adhesion while separating", |r| r.algebraic_damped - r.resolved_damped))
    .with(line("damped, adhesion always (Eq. 4)", |r| r.algebraic_damped - r.reversible_damped))
}
