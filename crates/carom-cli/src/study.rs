//! Sampled impacts along a range: the probability of sticking, and bands of what rebounds come to.

use crate::failure::Failure;
use crate::grid::{Curve, Grid};
use crate::law::Law;
use crate::motion::{ImpactArgs, Met, Motion, refused};
use carom::study::{Band, Distribution, Sampling, Share, sampled};
use carom_report::Column;
use std::borrow::Cow;

/// What bands are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    Restitution,
    ReboundSpeed,
    ImpulseRatio,
    TangentialRestitution,
    AngleOut,
}

impl Figure {
    /// All of them, in the order of the columns.
    pub const ALL: [Self; 5] =
        [Self::Restitution, Self::ReboundSpeed, Self::ImpulseRatio, Self::TangentialRestitution, Self::AngleOut];

    /// Its value for one impact: captured spheres have restitution and speed 0 and nothing else.
    pub fn of(self, met: &Met) -> f64 {
        match self {
            Self::Restitution => met.outcome.restitution,
            Self::ReboundSpeed => met.speed(),
            Self::ImpulseRatio => met.outcome.impulse_ratio,
            Self::TangentialRestitution => met.outcome.tangential_restitution,
            Self::AngleOut => met.angle(),
        }
    }

    /// Start of its columns' names, and their unit.
    fn column(self) -> (&'static str, &'static str) {
        match self {
            Self::Restitution => ("restitution", ""),
            Self::ReboundSpeed => ("rebound_speed", "m/s"),
            Self::ImpulseRatio => ("impulse_ratio", ""),
            Self::TangentialRestitution => ("tangential_restitution", ""),
            Self::AngleOut => ("angle_out_deg", ""),
        }
    }
}

/// A row for each point of each curve.
pub struct Study {
    /// Probability of sticking.
    pub sticking: Vec<Share>,
    /// Bands in the order of [`Figure::ALL`].
    bands: [Vec<Band>; 5],
    /// Each curve's law at the medians.
    pub laws: Vec<Law>,
}

/// Most samples times points of a curve: their values are sorted in memory.
const MOST: usize = 5_000_000;

/// Whether any value is a distribution.
pub fn is_drawn(case: &ImpactArgs) -> bool {
    drawn(case).next().is_some()
}

/// The flags that are distributions.
pub fn drawn(case: &ImpactArgs) -> impl Iterator<Item = (&'static str, &Distribution)> {
    let diameter = case.motion.diameter.as_ref().and_then(|d| d.distribution()).map(|d| ("diameter", d));
    diameter.into_iter().chain(case.law.drawn())
}

impl Study {
    /// Samples every curve of a grid.
    pub fn new(grid: &Grid, sampling: &Sampling) -> Result<Self, Failure> {
        fits(grid, sampling)?;
        let mut study = Self { sticking: Vec::new(), bands: Default::default(), laws: Vec::new() };
        for curve in &grid.curves {
            study.add(grid, curve, sampling)?;
        }
        Ok(study)
    }

    fn add(&mut self, grid: &Grid, curve: &Curve, sampling: &Sampling) -> Result<(), Failure> {
        let population = curve.args.law.population(grid.is_oblique(curve))?;
        let middle = population.middle()?;
        let varies = curve.args.law.drawn().next().is_some();
        let scatters = middle.wall.scatter().is_some();
        if !is_drawn(&curve.args) && !scatters {
            return Err(Failure::input(NOTHING));
        }
        let motions = motions(grid, curve)?;
        let law = |sample| {
            let drawn = varies.then(|| population.law(|flag| sampling.draw(sample, flag))).transpose()?;
            Ok::<_, Failure>(drawn.map_or(Cow::Borrowed(&middle.wall), Cow::Owned))
        };
        let study = sampled(sampling, motions.len(), law, |wall, sample, point| {
            let draws = if scatters { sampling.impact(sample) } else { [0.5; 4] };
            let motion = motions[point];
            let diameter = curve.diameter(grid.quantity(), sampling.draw(sample, 0));
            let motion = Motion { diameter: diameter.unwrap_or(motion.diameter), ..motion };
            let met = motion.meet_drawn(wall, draws).map_err(|e| refused(e, &motion))?;
            Ok((!met.rebounds(), Figure::ALL.map(|figure| figure.of(&met))))
        })?;
        self.sticking.extend(study.sticking);
        for (bands, new) in self.bands.iter_mut().zip(study.bands) {
            bands.extend(new);
        }
        self.laws.push(middle);
        Ok(())
    }

    /// The bands of a figure.
    pub fn bands(&self, figure: Figure) -> &[Band] {
        &self.bands[figure as usize]
    }

    /// Columns of the probability of sticking and what the number of samples leaves open.
    pub fn sticking_columns(&self) -> Vec<Column> {
        let column = |name: &str, get: fn(&Share) -> f64| Column::float(name, "", self.sticking.iter().map(get));
        vec![
            column("sticking_probability", |s| s.value),
            column("sticking_low", |s| s.low),
            column("sticking_high", |s| s.high),
        ]
    }

    /// Median and band of a figure as columns.
    pub fn band_columns(&self, figure: Figure) -> Vec<Column> {
        let (name, unit) = figure.column();
        band_columns(name, unit, self.bands(figure))
    }
}

/// What is wrong where nothing is left to chance.
pub const NOTHING: &str = "--samples: nothing is drawn here; make a value a distribution, such as \
    --diameter 'lognormal(50um, 1.3)', or the wall scatter with --roughness-angle 5";

/// `NAME_median`, `NAME_p05`, `NAME_p95`.
pub fn band_columns(name: &str, unit: &str, bands: &[Band]) -> Vec<Column> {
    let column = |end: &str, get: fn(&Band) -> f64| Column::float(format!("{name}_{end}"), unit, bands.iter().map(get));
    vec![column("median", |b| b.median), column("p05", |b| b.low), column("p95", |b| b.high)]
}

/// Refuses what would not fit into memory.
pub fn fits(grid: &Grid, sampling: &Sampling) -> Result<(), Failure> {
    if grid.points.len().saturating_mul(sampling.samples as usize) > MOST {
        return Err(Failure::input(format!(
            "{} samples of {} points are too many; samples times points may be {MOST} at most",
            sampling.samples,
            grid.points.len()
        )));
    }
    Ok(())
}

/// A curve's motion at every point; a diameter that is drawn is put in later.
fn motions(grid: &Grid, curve: &Curve) -> Result<Vec<Motion>, Failure> {
    let at = |point: &f64| {
        let motion = curve.at(grid.quantity(), *point);
        let diameter = motion.wanted_diameters()?.at(0.5);
        motion.with_diameter(diameter)
    };
    grid.points.iter().map(at).collect()
}
