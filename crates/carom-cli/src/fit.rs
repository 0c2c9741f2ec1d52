//! `carom fit`: parameters of a wall law from measured points, for one pair of materials or for several.

mod show;
mod survey;

use crate::failure::{Failure, say};
use crate::law::LawArgs;
use crate::output::{self, check_folder};
use crate::values;
use carom_lab::LabError;
use carom_lab::fit::{BootstrapOptions, Data, Fit, Free, Key, Options, Parameter as _, Resampling, fit, parameter};
use carom_report::plot::ImageFormat;
use std::ops::RangeInclusive;
use std::path::PathBuf;

const EXAMPLE: &str = "\
Examples:
  carom fit points.csv --sphere stainless-steel --surface silicon --diameter 70um \\
      --free adhesion_damping,hertz_damping,roughness_factor --plot fit.svg --out fitted.toml
  carom fit points.csv --wall-law walls.toml:glass --free roughness_factor,friction --bounds friction=0.05..0.6
  carom fit --survey walls.toml --plot damping.svg       each [law.NAME] with the points of NAME.csv beside it
  carom fit --survey data/experiments/wall-1990.toml     an experiment with its points beside it

A file of points is CSV: speed (m/s), restitution (0 for a sphere that stayed), and where known diameter (m), angle (degrees from the
surface), tangential_restitution, sigma (standard uncertainty of both restitutions). Lines that begin with # say where they come from.";

/// Fit parameters of a wall law to measured restitution, with their uncertainty
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    /// Measured points, CSV
    #[arg(value_name = "DATA", required_unless_present = "survey")]
    data: Option<PathBuf>,
    /// What to find: adhesion_damping, hertz_damping, roughness_factor, work_of_adhesion, plastic_constant, friction
    #[arg(long, value_name = "NAMES", help_heading = "Fit", value_delimiter = ',', value_parser = key, required_unless_present = "survey")]
    free: Vec<Key>,
    /// Where one may lie, NAME=LOW..HIGH (repeatable) [default: 0 and more, C_R 0..1]
    #[arg(long, value_name = "RANGE", help_heading = "Fit", value_parser = bounds)]
    bounds: Vec<(Key, RangeInclusive<f64>)>,
    /// Diameter of the spheres, where the points have no column for it
    #[arg(long, value_name = "LENGTH", help_heading = "Fit", value_parser = values::diameter)]
    diameter: Option<f64>,
    /// Several pairs: law files with NAME.csv beside them for each [law.NAME], or experiments; C_A and C_H against Young's modulus
    #[arg(long, value_name = "FILE", help_heading = "Fit", num_args = 1.., conflicts_with = "data")]
    survey: Vec<PathBuf>,
    /// Fits to resampled data, 0 for none [default: 1000; none for a survey]
    #[arg(long, value_name = "N", help_heading = "Fit", value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    bootstrap: Option<u32>,
    /// What is drawn again: residuals about the fit, or pairs (whole points)
    #[arg(long, value_name = "WHAT", help_heading = "Fit", default_value = "residuals", value_parser = resampling)]
    resample: Resampling,
    /// Seed of the draws
    #[arg(long, value_name = "N", help_heading = "Fit", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    law: LawArgs,
    /// Law file to write, TOML; with --survey a table, CSV, Parquet or JSON
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    out: Option<PathBuf>,
    /// Plot of the fitted curve with the data (SVG or PNG); with --survey C_A and C_H against Young's modulus
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    plot: Option<PathBuf>,
    /// Plot of what is left between data and fit
    #[arg(long, value_name = "FILE", help_heading = "Output", conflicts_with = "survey")]
    residuals: Option<PathBuf>,
    /// Print everything as JSON
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// `friction=0.1..0.6`; an end may be left out.
fn bounds(text: &str) -> Result<(Key, RangeInclusive<f64>), String> {
    let right = "a parameter and its range are wanted, such as friction=0.1..0.6";
    let (name, range) = text.split_once('=').ok_or(right)?;
    let parameter = key(name)?;
    let (low, high) = range.split_once("..").ok_or(right)?;
    let natural = parameter.natural_bounds();
    let end = |text: &str, absent: f64| {
        if text.trim().is_empty() {
            return Ok(absent);
        }
        parameter.read(text).map_err(|e| e.to_string())
    };
    let (low, high) = (end(low, *natural.start())?, end(high, *natural.end())?);
    let fits = low < high && natural.contains(&low) && natural.contains(&high);
    if !fits {
        let (from, to) = (natural.start(), natural.end());
        return Err(format!("{text}: two numbers are wanted, the smaller first, within {from} to {to}"));
    }
    Ok((parameter, low..=high))
}

fn key(text: &str) -> Result<Key, String> {
    parameter(text).map_err(|e| e.to_string())
}

fn resampling(text: &str) -> Result<Resampling, String> {
    match text {
        "residuals" => Ok(Resampling::Residuals),
        "pairs" => Ok(Resampling::Pairs),
        _ => Err("residuals or pairs".into()),
    }
}

impl Args {
    /// The free parameters, `default` where none is named.
    fn free(&self, default: &[Key]) -> Result<Vec<Free>, Failure> {
        let named = if self.free.is_empty() { default } else { &self.free };
        let mut free: Vec<Free> = named.iter().copied().map(Free::new).collect();
        for (parameter, range) in &self.bounds {
            let Some(found) = free.iter_mut().find(|f| f.parameter == *parameter) else {
                let error = format!("--bounds {parameter}: it is not free; name it in --free, or leave the bounds out");
                return Err(Failure::input(error));
            };
            found.bounds = range.clone();
        }
        Ok(free)
    }

    fn options(&self, resamples: u32) -> Options {
        let resamples = self.bootstrap.unwrap_or(resamples);
        Options { bootstrap: BootstrapOptions { resamples, seed: self.seed, resampling: self.resample } }
    }
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<(), Failure> {
    match &args.data {
        Some(path) => one(args, path),
        None => survey::run(args),
    }
}

fn one(args: &Args, path: &std::path::Path) -> Result<(), Failure> {
    check_files(args)?;
    let free = args.free(&[])?;
    let library = args.law.materials.library()?;
    let data = Data::from_csv(&path.display().to_string(), &output::read_points(path)?, args.diameter)?;
    crate::validate::tell_left_out(&data.name, &data.left_out);
    let oblique = data.points.iter().any(|p| p.tangential_restitution.is_some());
    let law = args.law.compile_with(oblique, &library, |spec| {
        for one in &free {
            let start = one.parameter.start(spec, &library).clamp(*one.bounds.start(), *one.bounds.end());
            one.parameter.set(spec, start);
        }
    })?;
    let mut found = fit(&law.spec, &free, &data, &library, &args.options(BootstrapOptions::default().resamples))?;
    let materials = law.materials().unwrap_or_else(|| "sphere".to_owned());
    let tangential = law.spec.tangential.as_ref().map_or("rolling", |t| t.value.name());
    let tangential = if oblique { format!(", {tangential}") } else { String::new() };
    let title = format!("{materials}, {}{tangential}", law.normal_name());
    let mut plots = Vec::new();
    if let Some(path) = &args.plot {
        plots.push((path, found.plot(&title, &library)?));
    }
    if let Some(path) = &args.residuals {
        plots.push((path, found.residual_plot(&title)));
    }
    if let Some(path) = &args.out {
        if !law.has_friction {
            found.law.friction = None;
        }
        let text = found.law_file(args.law.name().unwrap_or("fitted"), &library)?;
        std::fs::write(path, text).map_err(|source| Failure::from(LabError::File { path: path.clone(), source }))?;
        say(&format!("wrote {}", path.display()));
    }
    for (path, plot) in plots {
        plot.write(path)?;
        say(&format!("wrote {}", path.display()));
    }
    show::one(&found, &title, args.json)
}

/// Refuses, before anything is computed, what could not be written.
fn check_files(args: &Args) -> Result<(), Failure> {
    if let Some(path) = &args.out {
        if path.extension().is_none_or(|e| e != "toml") {
            let name = path.display();
            return Err(Failure::input(format!("--out {name}: a law file ends in .toml, such as fitted.toml")));
        }
        check_folder(path)?;
    }
    for path in [&args.plot, &args.residuals].into_iter().flatten() {
        ImageFormat::from_path(path)?;
        check_folder(path)?;
    }
    if args.plot.is_some() && args.plot == args.residuals {
        return Err(Failure::input("--plot and --residuals go to one file; name two"));
    }
    Ok(())
}

/// Counts and names as a reader wants them.
fn points(fit: &Fit) -> String {
    let (all, informative) = (fit.residuals.len(), fit.goodness.informative);
    let stayed =
        if informative < all { format!(", {} of spheres that stayed", all - informative) } else { String::new() };
    format!("{all} values{stayed}")
}
