//! `carom validate`: every experiment against the models, as a table and a report.

use crate::failure::{Failure, of_file, say};
use crate::law::MaterialsArgs;
use crate::output;
use carom_lab::LabError;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

const EXAMPLE: &str = "\
Examples:
  carom validate
  carom validate --out report/                          report.html and report.json
  carom validate --experiments data/experiments --out report/

A folder of experiments holds a file AUTHOR-YEAR.toml each. Measured points go into AUTHOR-YEAR.csv beside it, with the columns
speed and restitution, and where wanted diameter, angle, sigma and panel.";

/// How far the models are from experiments: a table, and a report with every plot
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    /// Folder for report.html and report.json
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Folder of experiments instead of those that come along
    #[arg(long, value_name = "DIR")]
    experiments: Option<PathBuf>,
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
    let found = carom_lab::validate(experiments.map_err(failed)?, &args.materials.library()?).map_err(failed)?;
    if let Some(folder) = &args.out {
        found.write(folder).map_err(failed)?;
        say(&format!("wrote {}", folder.join("report.html").display()));
    }
    if args.json {
        return output::print(&found.to_json().map_err(failed)?);
    }
    let mut text = found.summary().map_err(failed)?.to_text();
    let missed: Vec<_> = found.claims.iter().filter(|c| !c.holds).collect();
    let _ = writeln!(
        text,
        "\n{} of {} claims of the paper are not reproduced from their own inputs:",
        missed.len(),
        found.claims.len()
    );
    for claim in missed {
        let _ = writeln!(text, "- {}: computed {}", claim.says, carom_report::significant(claim.computed, 3));
    }
    output::print(&text)
}

fn failed(error: LabError, folder: Option<&Path>) -> Failure {
    match error {
        LabError::Experiment { name, text, error } => {
            let path = folder.map_or_else(|| PathBuf::from(&name), |f| f.join(&name));
            Failure::in_file(error, &path.display().to_string(), &text)
        }
        LabError::File { path, source } => of_file(&path.display().to_string(), &source),
        LabError::Report(error) => error.into(),
        LabError::Points(message) => Failure::input(message),
        other => Failure::Other(other.to_string()),
    }
}
