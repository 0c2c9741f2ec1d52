//! `carom run`: particles of a case file from injection to fate.

use crate::failure::{Failure, of_file, say};
use crate::law::MaterialsArgs;
use crate::output;
use crate::report::{self, Made};
use carom_report::{Column, Table};
use carom_track::record::ParticleFate;
use carom_track::{About, Case, Progress, RunError, RunOptions, Shard, Summary};
use indicatif::{HumanCount, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLE: &str = "\
Examples:
  carom run examples/wind-tunnel.toml --out out/
  carom run case.toml --out out/ --resume          go on where an interrupted run stopped
  carom run case.toml --out out/ --force           instead of the run that is in the folder
  carom run case.toml --out part2/ --shard 2/8     the second of eight parts, on a machine of its own

The folder then holds report.html, summary.json, every impact (impacts.csv) and every particle's end (fates.csv), the paths
(trajectories.csv, .vtp and .svg) and the deposit (deposition.csv, deposit.vtp). The results do not depend on threads,
interruptions or shards; `carom merge` puts shards together.";

/// Track particles through a flow as a case file describes it
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    /// The case file
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// Folder for the results; only the summary is shown without it
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Threads; 0 for as many as the machine has
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = threads)]
    threads: usize,
    /// Go on where an interrupted run in the folder stopped
    #[arg(long, requires = "out")]
    resume: bool,
    /// Replace the run that is in the folder
    #[arg(long, requires = "out", conflicts_with = "resume")]
    force: bool,
    /// Only the part I of N parts, as I/N
    #[arg(long, value_name = "I/N", requires = "out")]
    shard: Option<Shard>,
    /// Write no report.html; a shard writes none
    #[arg(long)]
    no_report: bool,
    #[command(flatten)]
    materials: MaterialsArgs,
    /// Print the summary as JSON
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// More threads than any machine has would only exhaust it.
fn threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(n) if n <= 4096 => Ok(n),
        _ => Err("a number from 0 to 4096 is wanted".into()),
    }
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<(), Failure> {
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let library = args.materials.library()?;
    let text = output::read(&args.case)?;
    let name = args.case.display().to_string();
    let case = Case::from_toml(&text, &args.case, &library).map_err(|e| Failure::in_file(e, &name, &text))?;
    for note in &case.notes {
        say(&format!("note: {note}"));
    }
    let options = RunOptions {
        threads: args.threads,
        out: args.out.clone(),
        resume: args.resume,
        force: args.force,
        shard: args.shard,
        ..RunOptions::default()
    };
    tell_on_interrupt(args);
    let bar = Bar::new();
    let start = Instant::now();
    let summary = carom_track::run(&case, &options, &bar);
    let took = start.elapsed();
    bar.0.finish_and_clear();
    let summary = summary.map_err(failed)?;
    if let Some(folder) = &args.out {
        let made = (!args.no_report && args.shard.is_none()).then(|| Made::now(Some(took)));
        report::write(&About::of(&case), &summary, folder, made.as_ref())?;
        say(&format!("wrote {}", folder.display()));
    }
    output::print(&if args.json { json(&summary)? } else { tell(&summary)? })
}

/// The summary as JSON.
pub fn json(summary: &Summary) -> Result<String, Failure> {
    summary.to_json().map_err(|e| Failure::Other(format!("JSON: {e}")))
}

/// An interrupted run says how to go on. What is on disk is whole at any time, so there is nothing else to do.
fn tell_on_interrupt(args: &Args) {
    let how = match &args.out {
        Some(out) => {
            let shard = args.shard.map_or(String::new(), |s| format!(" --shard {}/{}", s.index, s.of));
            let (case, out) = (args.case.display(), out.display());
            format!(
                "interrupted; to go on: carom run {case} --out {out}{shard} --resume, with the other options as they were"
            )
        }
        None => "interrupted".to_owned(),
    };
    let told = ctrlc::set_handler(move || {
        say(&format!("\n{how}"));
        std::process::exit(1);
    });
    if let Err(error) = told {
        say(&format!("note: an interruption will end the run without a word ({error}); --resume goes on all the same"));
    }
}

/// Refuses an output folder that cannot be one.
pub fn check_folder(folder: &Path) -> Result<(), Failure> {
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::input(format!("--out {}: a file is there; name a folder", folder.display())));
    }
    Ok(())
}

/// A bar on a terminal, nothing in a pipe.
struct Bar(ProgressBar);

impl Bar {
    fn new() -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        let style =
            ProgressStyle::with_template("{wide_bar} {human_pos} of {human_len} particles, {rate}/s, {eta} left");
        let rate = |state: &ProgressState, out: &mut dyn std::fmt::Write| {
            let _ = write!(out, "{}", HumanCount(state.per_sec() as u64));
        };
        Self(style.map_or_else(|_| bar.clone(), |style| bar.clone().with_style(style.with_key("rate", rate))))
    }
}

impl Progress for Bar {
    fn note(&self, text: &str) {
        self.0.suspend(|| say(&format!("note: {text}")));
    }

    fn particles(&self, done: u64, all: u64) {
        if self.0.length().is_none() {
            // what a resumed run had done before says nothing of the rate
            self.0.set_length(all);
            self.0.set_position(done);
            self.0.reset_eta();
        }
        self.0.set_position(done);
    }
}

/// A run or a merging that failed, as the command shows it.
pub fn failed(error: RunError) -> Failure {
    match &error {
        RunError::Io { path, source } => of_file(&path.display().to_string(), source),
        RunError::Foreign { .. }
        | RunError::Busy { .. }
        | RunError::Occupied { .. }
        | RunError::NoFolder
        | RunError::Shard { .. }
        | RunError::Missing { .. } => Failure::input(error.to_string()),
        _ => Failure::Other(error.to_string()),
    }
}

/// What became of the particles, and what happened at each wall.
pub fn tell(summary: &Summary) -> Result<String, Failure> {
    let mut text = String::new();
    if !summary.title.is_empty() {
        let _ = writeln!(text, "{}\n", summary.title);
    }
    let ended: Vec<String> = ParticleFate::ALL
        .into_iter()
        .filter(|fate| summary.count(*fate) > 0)
        .map(|fate| format!("{} {}", summary.count(fate), fate.name()))
        .collect();
    let count = summary.injected.count;
    let _ = writeln!(text, "{count} {}: {}\n", if count == 1 { "particle" } else { "particles" }, ended.join(", "));
    if summary.stalled > 0 {
        let _ = writeln!(text, "{} of the airborne were left where their steps ran out\n", summary.stalled);
    }
    if summary.strayed > 0 {
        let _ = writeln!(
            text,
            "{} went outside the table of the flow, where the values of its boundary hold\n",
            summary.strayed
        );
    }
    let walls = &summary.walls;
    let mut columns = vec![
        Column::text("wall", walls.iter().map(|w| w.name.as_str())),
        Column::count("impacts", walls.iter().map(|w| w.impacts)),
        Column::count("rebounds", walls.iter().map(|w| w.rebounds)),
    ];
    for fate in ParticleFate::AT_WALLS {
        if summary.count(fate) > 0 {
            columns.push(Column::count(fate.name(), walls.iter().map(|w| w.ends[fate as usize].count)));
        }
    }
    if !walls.is_empty() {
        text += &Table::new(columns)?.to_text();
    }
    let doubts: Vec<String> = summary.doubts().map(|(code, count)| format!("{code} {count}")).collect();
    if !doubts.is_empty() {
        let _ = writeln!(text, "\nimpacts beyond what their law is good for: {}", doubts.join(", "));
    }
    Ok(text)
}
