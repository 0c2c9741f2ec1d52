//! Distributions of diameter.
//!
//! - Lognormal: ln d is normal about ln(median) with standard deviation ln σ_g; its mass is lognormal too, with
//!   the same σ_g and median e^{3 ln²σ_g} times the number's (Hatch & Choate 1929).
//! - Rosin–Rammler: the fraction larger than d is e^{−(d/d̄)^n} (Rosin & Rammler 1933, J. Inst. Fuel 7, 29–36), by mass as a rule,
//!   cut at a least and a greatest diameter.
//! - Table: sizes with their shares.
//!
//! Number and mass are converted by d³. Draws invert the cumulative distribution: one uniform a draw.

use super::{InjectionError, finite, positive};
use crate::random::normal_quantile;
use carom::math::{exp, ln, pow};

/// What a distribution counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// Spheres.
    Number,
    /// Their mass.
    Mass,
}

/// A distribution of diameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Sizes {
    /// All alike, m.
    Mono(f64),
    /// Lognormal.
    Lognormal {
        /// Median, m.
        median: f64,
        /// Geometric standard deviation, ≥ 1.
        gsd: f64,
        /// Whose median.
        by: By,
    },
    /// Rosin–Rammler.
    RosinRammler {
        /// d̄, the diameter that 1/e of the whole exceeds, m.
        mean: f64,
        /// Exponent n.
        spread: f64,
        /// Least diameter, m.
        min: f64,
        /// Greatest diameter, m.
        max: f64,
        /// What the fractions are of.
        by: By,
    },
    /// Sizes and their shares.
    Table {
        /// (diameter in m, share); shares need not add up to 1.
        rows: Vec<(f64, f64)>,
        /// What the shares are of.
        by: By,
    },
}

/// A distribution ready to be drawn from, by number or by mass.
#[derive(Clone, Debug)]
pub(super) enum Sampler {
    Mono(f64),
    Lognormal {
        ln_median: f64,
        ln_gsd: f64,
    },
    /// d = d̄ t^{1/n}, t exponential between two bounds: e^{−t} = high − u (high − low).
    RosinRammler {
        mean: f64,
        per_spread: f64,
        high: f64,
        range: f64,
        bounds: [f64; 2],
    },
    /// Cumulative shares of ln d.
    Curve(Vec<(f64, f64)>),
    Steps(Vec<(f64, f64)>),
}

impl Sampler {
    pub fn new(sizes: &Sizes, by: By) -> Result<Self, InjectionError> {
        match sizes {
            Sizes::Mono(d) => positive("diameter", *d).map(|()| Self::Mono(*d)),
            Sizes::Lognormal { median, gsd, by: given } => lognormal(*median, *gsd, cubes(*given, by)),
            Sizes::RosinRammler { mean, spread, min, max, by: given } => {
                rosin_rammler(*mean, *spread, [*min, *max], cubes(*given, by))
            }
            Sizes::Table { rows, by: given } => steps(rows, cubes(*given, by)),
        }
    }

    /// The diameter that a share `u` in (0, 1) does not exceed, m.
    pub fn quantile(&self, u: f64) -> f64 {
        match self {
            Self::Mono(d) => *d,
            Self::Lognormal { ln_median, ln_gsd } => exp(ln_median + ln_gsd * normal_quantile(u)),
            Self::RosinRammler { mean, per_spread, high, range, bounds: [min, max] } => {
                let t = (-ln(high - u * range)).max(1e-300);
                (mean * pow(t, *per_spread)).clamp(*min, *max)
            }
            Self::Curve(points) => {
                let i = points.partition_point(|(share, _)| *share < u).clamp(1, points.len() - 1);
                let ((a, x), (b, y)) = (points[i - 1], points[i]);
                exp(x + (y - x) * ((u - a) / (b - a)).clamp(0.0, 1.0))
            }
            Self::Steps(steps) => steps[steps.partition_point(|(share, _)| *share < u).min(steps.len() - 1)].1,
        }
    }
}

/// The power of d that turns shares of one kind into the other.
fn cubes(given: By, wanted: By) -> f64 {
    match (given, wanted) {
        (By::Number, By::Mass) => 3.0,
        (By::Mass, By::Number) => -3.0,
        _ => 0.0,
    }
}

fn lognormal(median: f64, gsd: f64, power: f64) -> Result<Sampler, InjectionError> {
    positive("median diameter", median)?;
    if !(gsd >= 1.0 && gsd.is_finite()) {
        return Err(InjectionError::value("geometric standard deviation", gsd, "1 or more"));
    }
    let ln_gsd = ln(gsd);
    Ok(Sampler::Lognormal { ln_median: ln(median) + power * ln_gsd * ln_gsd, ln_gsd })
}

fn rosin_rammler(mean: f64, spread: f64, [min, max]: [f64; 2], power: f64) -> Result<Sampler, InjectionError> {
    positive("Rosin-Rammler mean diameter", mean)?;
    positive("Rosin-Rammler spread", spread)?;
    positive("least diameter", min)?;
    if !(max > min && max.is_finite()) {
        return Err(InjectionError::value("greatest diameter", max, "finite and above the least"));
    }
    let t = |d: f64| pow(d / mean, spread);
    if power == 0.0 {
        let (high, low) = (exp(-t(min)), exp(-t(max)));
        let range = high - low;
        if range <= 0.0 {
            return Err(InjectionError::value(
                "least diameter",
                min,
                "such that some of the distribution lies above it",
            ));
        }
        return Ok(Sampler::RosinRammler { mean, per_spread: 1.0 / spread, high, range, bounds: [min, max] });
    }
    // ∫ e^{−t} d^power dt with t = (d/d̄)^n, in s = ln d: the density of s is n t e^{−t} d^power
    const CELLS: usize = 8192;
    let (first, h) = (ln(min), ln(max / min) / CELLS as f64);
    // d^power relative to the least diameter's, so that nothing overflows
    let density = |s: f64| {
        let x = s - ln(mean);
        let exponent = spread * x - exp(spread * x) + power * (x - ln(min / mean));
        if exponent < -700.0 { 0.0 } else { exp(exponent) }
    };
    let mut points = vec![(0.0, first)];
    let mut sum = 0.0;
    for i in 0..CELLS {
        let s = first + i as f64 * h;
        let simpson = (density(s) + 4.0 * density(s + 0.5 * h) + density(s + h)) * h / 6.0;
        sum += simpson;
        points.push((sum, s + h));
    }
    if !(sum > 0.0 && sum.is_finite()) {
        return Err(InjectionError::value("least diameter", min, "such that some of the distribution lies above it"));
    }
    points.iter_mut().for_each(|p| p.0 /= sum);
    // cells too empty to move the sum would divide by zero
    points.dedup_by(|b, a| b.0 <= a.0);
    Ok(Sampler::Curve(points))
}

fn steps(rows: &[(f64, f64)], power: f64) -> Result<Sampler, InjectionError> {
    let mut rows = rows.to_vec();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut sum = 0.0;
    for (d, share) in &mut rows {
        positive("diameter in the table of sizes", *d)?;
        finite("share in the table of sizes", *share)?;
        if *share < 0.0 {
            return Err(InjectionError::value("share in the table of sizes", *share, "zero or positive"));
        }
        // a ratio, since a cubed micrometre is 1e-18 and shares may be small
        sum += *share * if power == 0.0 { 1.0 } else { exp(power * ln(*d / 1e-6)) };
        *share = sum;
    }
    if !(sum > 0.0 && sum.is_finite()) {
        return Err(InjectionError::value("sum of the shares in the table of sizes", sum, "positive and finite"));
    }
    let steps: Vec<(f64, f64)> = rows.into_iter().map(|(d, share)| (share / sum, d)).collect();
    Ok(Sampler::Steps(steps))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean of d^p by the midpoint rule over the quantiles.
    fn moment(sampler: &Sampler, p: f64) -> f64 {
        let n = 400_000;
        (0..n).map(|i| sampler.quantile((f64::from(i) + 0.5) / f64::from(n)).powf(p) / f64::from(n)).sum()
    }

    #[test]
    fn lognormal_quantiles_and_hatch_choate() {
        let sizes = Sizes::Lognormal { median: 5e-6, gsd: 2.0, by: By::Number };
        let number = Sampler::new(&sizes, By::Number).unwrap();
        assert!((number.quantile(0.5) / 5e-6 - 1.0).abs() < 1e-14);
        // one standard deviation up is a factor σ_g
        assert!((number.quantile(0.841_344_746_068_542_9) / 1e-5 - 1.0).abs() < 1e-13);
        assert!((number.quantile(0.158_655_253_931_457_07) / 2.5e-6 - 1.0).abs() < 1e-13);
        let mass = Sampler::new(&sizes, By::Mass).unwrap();
        let want = 5e-6 * (3.0 * 2.0f64.ln().powi(2)).exp();
        assert!((mass.quantile(0.5) / want - 1.0).abs() < 1e-13);
    }

    #[test]
    fn rosin_rammler_mean_and_median() {
        let sizes = Sizes::RosinRammler { mean: 60e-6, spread: 2.0, min: 1e-9, max: 1e-2, by: By::Mass };
        let mass = Sampler::new(&sizes, By::Mass).unwrap();
        assert!((mass.quantile(0.5) / (60e-6 * 2.0f64.ln().sqrt()) - 1.0).abs() < 1e-9);
        // d̄ Γ(1 + 1/n), Γ(3/2) = √π/2
        let want = 60e-6 * std::f64::consts::PI.sqrt() / 2.0;
        assert!((moment(&mass, 1.0) / want - 1.0).abs() < 1e-5);
    }

    #[test]
    fn rosin_rammler_by_number_has_the_same_mass() {
        // mean mass-weighted diameter from the number distribution: E[d⁴]/E[d³]
        let sizes = Sizes::RosinRammler { mean: 60e-6, spread: 3.5, min: 2e-5, max: 2e-4, by: By::Mass };
        let (number, mass) = (Sampler::new(&sizes, By::Number).unwrap(), Sampler::new(&sizes, By::Mass).unwrap());
        let by_number = moment(&number, 4.0) / moment(&number, 3.0);
        assert!((by_number / moment(&mass, 1.0) - 1.0).abs() < 1e-5, "{by_number}");
        assert!(number.quantile(1e-12) >= 2e-5 * (1.0 - 1e-9) && number.quantile(1.0 - 1e-12) <= 2e-4 * (1.0 + 1e-9));
        assert!((1.0 / moment(&mass, -3.0) / moment(&number, 3.0) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn tables_by_number_and_mass() {
        // half the spheres each, but 8/9 of the mass in the larger
        let sizes = Sizes::Table { rows: vec![(2e-6, 3.0), (1e-6, 3.0)], by: By::Number };
        let share = |by| {
            let s = Sampler::new(&sizes, by).unwrap();
            (0..9000).filter(|i| s.quantile((f64::from(*i) + 0.5) / 9000.0) == 2e-6).count()
        };
        assert_eq!((share(By::Number), share(By::Mass)), (4500, 8000));
        assert!(Sampler::new(&Sizes::Table { rows: vec![], by: By::Mass }, By::Mass).is_err());
        assert!(Sampler::new(&Sizes::Table { rows: vec![(1e-6, -1.0)], by: By::Mass }, By::Mass).is_err());
    }

    #[test]
    fn refuses_empty_ranges() {
        let sizes = |min, max| Sizes::RosinRammler { mean: 1e-6, spread: 3.0, min, max, by: By::Mass };
        for (min, max) in [(0.0, 1.0), (1e-6, 1e-6), (1e-4, 1e-3), (1e-6, f64::INFINITY)] {
            for by in [By::Mass, By::Number] {
                assert!(Sampler::new(&sizes(min, max), by).is_err(), "{min} {max} {by:?}");
            }
        }
    }
}
