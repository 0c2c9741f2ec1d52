//! `carom merge`: the shards of a run put together.

use crate::failure::{Failure, say};
use crate::report::{self, Made};
use crate::{output, run};
use std::path::PathBuf;

const EXAMPLE: &str = "\
Example, a run in two parts:
  carom run case.toml --out part1/ --shard 1/2
  carom run case.toml --out part2/ --shard 2/2
  carom merge part1/ part2/ --out whole/

The folder then holds what `carom run case.toml --out whole/` would have written, to the bit.";

/// Merge the shards of a run
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    /// The folders of all shards, in any order
    #[arg(value_name = "DIR", required = true)]
    shards: Vec<PathBuf>,
    /// Folder for the whole
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Replace the run that is in the folder
    #[arg(long)]
    force: bool,
    /// Write no report.html
    #[arg(long)]
    no_report: bool,
    /// Print the summary as JSON
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// Runs the subcommand.
pub fn merge(args: &Args) -> Result<(), Failure> {
    run::check_folder(&args.out)?;
    let (summary, about) = carom_track::merge(&args.shards, &args.out, args.force).map_err(run::failed)?;
    let made = (!args.no_report).then(|| Made::now(None));
    report::write(&about, &summary, &args.out, made.as_ref())?;
    say(&format!("wrote {}", args.out.display()));
    output::print(&if args.json { run::json(&summary)? } else { run::tell(&summary)? })
}
