//! The command line as a whole.

use crate::failure::Failure;
use crate::{capture, export, fit, impact, info, materials, merge, run, shell, sweep, validate};
use clap::builder::styling::{AnsiColor, Styles};
use clap::{Parser, Subcommand};

const EXAMPLES: &str = "\
Examples:
  carom impact --sphere copper --surface aluminium --diameter 90um --speed 2m/s
  carom sweep --sphere copper --surface aluminium --diameter 90um --over speed=0.01..30 --plot e.svg
  carom capture --sphere copper --surface aluminium --over diameter=1um..1mm
  carom materials copper
  carom fit points.csv --sphere copper --surface glass --diameter 90um --free roughness_factor
  carom info pitzDaily
  carom run examples/wind-tunnel.toml --out out/
  carom validate --out report/
  carom export --format openfoam --wall-law walls.toml:glass --diameter 10um..100um --speed 0.1..30

Quantities take a unit (90um, 2m/s, 190GPa) or are SI numbers. Which law: docs/which-law.md. All flags: `carom SUBCOMMAND --help`.
Exit codes: 0 success, 2 invalid input, 1 any other error.";

/// On a terminal that takes colours; clap looks, and heeds NO_COLOR.
const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

/// Impacts of small particles on walls: capture or rebound, with the speed, angle and spin after the rebound
#[derive(Parser)]
#[command(name = "carom", version, propagate_version = true, after_help = EXAMPLES, max_term_width = 110, styles = STYLES, subcommand_required = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Impact(Box<impact::Args>),
    Sweep(Box<sweep::Args>),
    Capture(Box<capture::Args>),
    Materials(materials::Args),
    Info(info::Args),
    Run(run::Args),
    Merge(merge::Args),
    Fit(Box<fit::Args>),
    Validate(validate::Args),
    Export(Box<export::Args>),
    Completions(shell::Completions),
    Man(shell::Man),
}

impl Cli {
    /// Runs the subcommand.
    pub fn run(&self) -> Result<(), Failure> {
        match &self.command {
            Command::Impact(args) => impact::run(args),
            Command::Sweep(args) => sweep::run(args),
            Command::Capture(args) => capture::run(args),
            Command::Materials(args) => materials::run(args),
            Command::Info(args) => info::run(args),
            Command::Run(args) => run::run(args),
            Command::Merge(args) => merge::merge(args),
            Command::Fit(args) => fit::run(args),
            Command::Validate(args) => validate::run(args),
            Command::Export(args) => export::run(args),
            Command::Completions(args) => shell::completions(args),
            Command::Man(args) => shell::man(args),
        }
    }
}
