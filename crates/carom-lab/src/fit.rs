//! Parameters of a wall law from measured points: bounded least squares with errors, correlations, resampling and doubts.
//!
//! ```
//! use carom::{material::Library, spec::parse_law};
//! use carom_lab::fit::{Data, Free, Key, Options, fit};
//! let law = parse_law("sphere = \"stainless-steel\"\nsurface = \"silicon\"\nnormal = \"ea\"\nfriction = 0\n")?;
//! // made with C_R = 0.15 and C_H = 0.007 s/m, rounded to three digits
//! let csv = "speed,restitution\n0.1,0.805\n0.3,0.926\n1,0.970\n3,0.978\n10,0.964\n20,0.934\n";
//! let data = Data::from_csv("steel.csv", csv, Some(70e-6))?;
//! let free = [Key::RoughnessFactor, Key::HertzDamping].map(Free::new);
//! let found = fit(&law, &free, &data, Library::builtin(), &Options::default())?;
//! assert!((found.parameters[0].value - 0.15).abs() < 0.01 && (found.parameters[1].value - 0.007).abs() < 0.0003);
//! assert!(found.law.to_toml("steel")?.contains("roughness_factor = 0.1"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bootstrap;
mod data;
mod doubts;
mod law_file;
mod parameter;
mod plots;
mod problem;
mod solve;
pub mod survey;
mod uncertainty;

pub use bootstrap::{Bootstrap, BootstrapOptions, Resampling};
pub use carom::spec::Key;
pub use data::{Data, Measurement};
pub use parameter::{Parameter, parameter, parameters};
pub use problem::Free;
pub use uncertainty::Goodness;

use crate::error::LabError;
use crate::experiment::Quantity;
use carom::material::Library;
use carom::spec::LawSpec;
use problem::Problem;
use serde::Serialize;

/// How a fit is done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// How data are drawn again.
    pub bootstrap: BootstrapOptions,
}

/// A parameter as found.
#[derive(Clone, Debug, Serialize)]
pub struct Estimate {
    /// Which.
    pub parameter: Key,
    /// SI unit, empty for a number.
    pub unit: &'static str,
    /// The least-squares value.
    pub value: f64,
    /// None at a bound, or where the data do not tell.
    pub standard_error: Option<f64>,
    /// 95 %, value ± z or t standard errors, cut at the bounds.
    pub interval: Option<(f64, f64)>,
    /// 2.5 to 97.5 % of the fits to resampled data.
    pub bootstrap: Option<(f64, f64)>,
    /// Where it might have lain.
    pub bounds: (f64, f64),
    /// It is at one of them.
    pub at_bound: bool,
}

/// A measured value beside the law's.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Residual {
    /// Line of the file.
    pub line: usize,
    /// What was measured.
    pub quantity: Quantity,
    /// m/s, normal to the wall.
    pub normal_speed: f64,
    /// Degrees from the surface.
    pub angle_deg: f64,
    /// m.
    pub diameter: f64,
    /// The value.
    pub measured: f64,
    /// The fitted law's.
    pub model: f64,
    /// Its standard uncertainty.
    pub sigma: Option<f64>,
}

/// A fit.
#[derive(Clone, Debug, Serialize)]
pub struct Fit {
    /// What was found, in the order asked for.
    pub parameters: Vec<Estimate>,
    /// Between each two, in that order.
    pub correlation: Vec<Vec<f64>>,
    /// How it meets the data.
    pub goodness: Goodness,
    /// What to mind, with what would help.
    pub warnings: Vec<String>,
    /// How data were drawn again.
    pub bootstrap: Option<Bootstrap>,
    /// Every value.
    pub residuals: Vec<Residual>,
    /// The data.
    #[serde(skip)]
    pub data: Data,
    /// The law, with what was found.
    #[serde(skip)]
    pub law: LawSpec,
}

/// Finds the free parameters of a law that fit the data best.
///
/// # Errors
/// A law that cannot be compiled, parameters that do nothing in it, data that cannot tell: what, and what would be right.
pub fn fit(law: &LawSpec, free: &[Free], data: &Data, library: &Library, options: &Options) -> Result<Fit, LabError> {
    let problem = Problem::new(law, free, data, library)?;
    let minimum = solve::solve(&problem, &problem.measured())?;
    let known = uncertainty::uncertainty(&problem, &minimum)?;
    let wanted = options.bootstrap.resamples > 0 && known.idle.is_empty() && known.entangled.is_empty();
    let bootstrap =
        wanted.then(|| bootstrap::bootstrap(&problem, &minimum, &known.leverage, &options.bootstrap)).transpose()?;
    let model = problem.model(&minimum.values)?;
    let parameters = (0..free.len())
        .map(|n| {
            let (value, error) = (minimum.values[n], known.standard_errors[n]);
            let reach = error.map(|e| known.quantile * e).filter(|r| r.is_finite());
            Estimate {
                parameter: free[n].parameter,
                unit: free[n].parameter.info().unit,
                value,
                standard_error: error,
                interval: reach.map(|r| (problem.inside(n, value - r), problem.inside(n, value + r))),
                bootstrap: bootstrap.as_ref().and_then(|b| b.interval(n)),
                bounds: (*free[n].bounds.start(), *free[n].bounds.end()),
                at_bound: minimum.held[n],
            }
        })
        .collect();
    let residuals = problem.observations.iter().zip(&model).map(|(o, m)| Residual {
        line: o.point.line,
        quantity: o.quantity,
        normal_speed: o.point.normal_speed(),
        angle_deg: o.point.angle_deg,
        diameter: o.point.diameter,
        measured: o.value,
        model: *m,
        sigma: o.point.sigma,
    });
    Ok(Fit {
        parameters,
        warnings: doubts::doubts(&problem, &minimum, &model, &known, bootstrap.as_ref()),
        residuals: residuals.collect(),
        correlation: known.correlation,
        goodness: known.goodness,
        bootstrap,
        data: data.clone(),
        law: problem.law_at(&minimum.values),
    })
}
