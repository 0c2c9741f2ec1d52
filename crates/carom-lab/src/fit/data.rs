//! Measured points of a fit.

use crate::error::LabError;
use crate::points::{Row, read};
use carom::LawError;
use serde::Serialize;

/// A measured impact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Measurement {
    /// Line of the file, 0 where there is none.
    pub line: usize,
    /// m/s.
    pub speed: f64,
    /// Degrees from the surface.
    pub angle_deg: f64,
    /// m.
    pub diameter: f64,
    /// e; 0 for a sphere that stayed.
    pub restitution: Option<f64>,
    /// e_t of the centre.
    pub tangential_restitution: Option<f64>,
    /// Standard uncertainty of the measured values.
    pub sigma: Option<f64>,
}

impl Measurement {
    /// Speed normal to the wall, m/s.
    pub fn normal_speed(&self) -> f64 {
        if self.angle_deg == 90.0 { self.speed } else { self.speed * self.angle_deg.to_radians().sin() }
    }
}

/// Measured impacts: all with a standard uncertainty, or none.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Data {
    /// Name of the file.
    pub name: String,
    /// What its comments say.
    pub said: String,
    /// Columns that nothing reads.
    pub left_out: Vec<String>,
    /// The impacts.
    pub points: Vec<Measurement>,
}

impl Data {
    /// Reads a CSV text: `speed` and `restitution` (or `tangential_restitution`), where wanted `diameter` (else `diameter` is every
    /// sphere's), `angle` and `sigma`. The form is that of [`crate::points::read`].
    ///
    /// # Errors
    /// What is wrong, with its place.
    ///
    /// ```
    /// let data = carom_lab::fit::Data::from_csv("d.csv", "speed,restitution\n1,0.9\n2,0.95\n", Some(90e-6))?;
    /// assert_eq!((data.points.len(), data.points[1].line), (2, 3));
    /// let error = carom_lab::fit::Data::from_csv("d.csv", "speed,restitution\n1,1.9\n", Some(90e-6)).unwrap_err();
    /// assert!(error.to_string().starts_with("d.csv:2:3: restitution 1.9"));
    /// # Ok::<(), carom_lab::LabError>(())
    /// ```
    pub fn from_csv(name: &str, text: &str, diameter: Option<f64>) -> Result<Self, LabError> {
        let wrong = |error| LabError::Data { name: name.to_owned(), text: text.to_owned(), error: Box::new(error) };
        let rows = read(text).map_err(wrong)?;
        let mut points = Vec::with_capacity(rows.rows.len());
        for row in &rows.rows {
            points.push(measurement(row, text, diameter).map_err(wrong)?);
        }
        if points.is_empty() {
            let help = "a line of column names such as speed,restitution and a line for each impact are wanted";
            return Err(wrong(LawError::new("no points").help(help)));
        }
        let with = points.iter().filter(|p| p.sigma.is_some()).count();
        if let Some(row) = rows.rows.iter().find(|r| r.sigma.is_none()).filter(|_| with > 0) {
            return Err(wrong(row.wrong("no sigma here, but in other lines", "give one for each point, or none")));
        }
        let mut left_out = rows.left_out;
        if rows.rows.iter().any(|r| r.impulse_ratio.is_some()) {
            left_out.push("impulse_ratio (restitution and tangential_restitution are fitted)".to_owned());
        }
        Ok(Self { name: name.to_owned(), said: rows.said, left_out, points })
    }

    /// Whether every point has a standard uncertainty.
    pub fn has_sigma(&self) -> bool {
        self.points.iter().all(|p| p.sigma.is_some())
    }

    /// The diameters, m, from the smallest; those within 2 % count as one.
    pub fn diameters(&self) -> Vec<f64> {
        let mut all: Vec<f64> = self.points.iter().map(|p| p.diameter).collect();
        all.sort_by(f64::total_cmp);
        all.dedup_by(|b, a| *b / *a - 1.0 <= 0.02);
        all
    }
}

fn measurement(row: &Row, text: &str, diameter: Option<f64>) -> Result<Measurement, LawError> {
    let speed = row.speed.as_ref().ok_or_else(|| row.wrong("a point without a speed", "give one, in m/s"))?;
    let given = row.diameter.as_ref().map(|d| d.value).or(diameter);
    let diameter = given.ok_or_else(|| {
        row.wrong("a point without a diameter", "add a column diameter, in m, or give one diameter for all points")
    })?;
    for (value, name, low) in
        [(&row.restitution, "restitution", 0.0), (&row.tangential_restitution, "tangential_restitution", -1.0)]
    {
        // noise may lift a value a little above 1
        if let Some(at) = value.as_ref().filter(|at| !(low..=1.2).contains(&at.value)) {
            let help = format!("it lies between {low} and 1 (0: the sphere stayed), up to noise");
            return Err(LawError::new(format!("{name} {}", at.value)).help(help).at(at.span.clone()));
        }
    }
    if row.restitution.is_none() && row.tangential_restitution.is_none() {
        return Err(row.wrong("a point without a restitution", "give restitution, tangential_restitution or both"));
    }
    let angle_deg = row.angle.as_ref().map_or(90.0, |a| a.value);
    if let Some(at) = row.tangential_restitution.as_ref().filter(|_| angle_deg == 90.0) {
        let help = "give the angle from the surface, in degrees, or leave the value out";
        return Err(LawError::new("a tangential restitution at 90 degrees, where nothing moves along the wall")
            .help(help)
            .at(at.span.clone()));
    }
    Ok(Measurement {
        line: LawError::new("").at(Some(row.span.clone())).line_column(text).map_or(0, |(line, _)| line),
        speed: speed.value,
        angle_deg,
        diameter,
        restitution: row.restitution.as_ref().map(|r| r.value),
        tangential_restitution: row.tangential_restitution.as_ref().map(|r| r.value),
        sigma: row.sigma.as_ref().map(|s| s.value),
    })
}
