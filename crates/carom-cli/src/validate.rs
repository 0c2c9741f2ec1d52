//! `carom validate`: every experiment against the models, as a table and a report.

use crate::failure::{Failure, say};
use crate::law::MaterialsArgs;
use crate::output;
use carom::error::did_you_mean;
use carom_lab::{Experiment, LabError, points};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

const EXAMPLE: &str = "\
Examples:
  carom validate
  carom validate --out report/                          report.html and report.json
  carom validate --points wall-1990.csv --out report/   with measured points of an experiment that comes along
  carom validate --experiments data/experiments --out report/

A file of points is named after its experiment, wall-1990.csv for wall-1990. A folder of experiments holds a file AUTHOR-YEAR.toml each. Measured points go into AUTHOR-YEAR.csv beside it, with the columns
speed and restitution, and where wanted diameter, angle, sigma and panel.";

/// Compare the models with experiments: a table, and a report with every plot
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    /// Folder for report.html and report.json
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Folder of experiments instead of those that come along
    #[arg(long, value_name = "DIR")]
    experiments: Option<PathBuf>,
    /// Measured points to add, CSV, each named after its experiment: wall-1990.csv
    #[arg(long, value_name = "FILE", num_args = 1..)]
    points: Vec<PathBuf>,
    #[command(flatten)]
    materials: MaterialsArgs,
    /// Print everything as JSON
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<(), Failure> {
    if let Some(folder) = args.out.as_ref().filter(|f| f.exists() && !f.is_dir()) {
        return Err(Failure::input(format!("--out {}: a file is there; name a folder", folder.display())));
    }
    let experiments = args.experiments.as_deref().map_or_else(carom_lab::builtin, carom_lab::from_folder);
    let folder = args.experiments.as_deref();
    let failed = |e| self::failed(e, folder);
    let mut experiments = experiments.map_err(failed)?;
    args.points.iter().try_for_each(|path| add_points(&mut experiments, path))?;
    let found = carom_lab::validate(experiments, &args.materials.library()?).map_err(failed)?;
    if let Some(folder) = &args.out {
        found.write(folder).map_err(failed)?;
        say(&format!("wrote {}", folder.join("report.html").display()));
    }
    if args.json {
        return output::print(&found.to_json().map_err(failed)?);
    }
    let mut text = found.summary().map_err(failed)?.to_text();
    let counted: Vec<_> = found.claims.iter().filter(|c| c.counts()).collect();
    let missed: Vec<_> = counted.iter().filter(|c| !c.holds).collect();
    let _ = writeln!(
        text,
        "\n{} of {} claims of the paper are not reproduced from their own inputs:",
        missed.len(),
        counted.len()
    );
    for claim in missed {
        let _ = writeln!(text, "- {}: computed {}", claim.says, carom_report::significant(claim.computed, 3));
    }
    output::print(&text)
}

/// Adds a file of points to the experiment of its name.
fn add_points(experiments: &mut [Experiment], path: &Path) -> Result<(), Failure> {
    let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let file = path.display().to_string();
    let names: Vec<String> = experiments.iter().map(|e| e.name.clone()).collect();
    let Some(experiment) = experiments.iter_mut().find(|e| e.name == stem) else {
        let near = did_you_mean(&stem, names.iter().map(String::as_str)).map_or(String::new(), |n| format!("{n} "));
        let known = names.join(", ");
        return Err(Failure::input(format!("--points {file}: no experiment '{stem}'; {near}known are {known}")));
    };
    let text = output::read_points(path)?;
    points::add(experiment, &file, &text)?;
    tell_left_out(&file, &points::read(&text).map(|rows| rows.left_out).unwrap_or_default());
    Ok(())
}

/// Says which columns of a file of points nothing reads.
pub fn tell_left_out(file: &str, columns: &[String]) {
    if !columns.is_empty() {
        say(&format!("note: {file}: not used: {}", columns.join(", ")));
    }
}

fn failed(error: LabError, folder: Option<&Path>) -> Failure {
    match error {
        LabError::Experiment { name, text, error } => {
            let path = folder.map_or_else(|| PathBuf::from(&name), |f| f.join(&name));
            Failure::in_file(error, &path.display().to_string(), &text)
        }
        other => other.into(),
    }
}
