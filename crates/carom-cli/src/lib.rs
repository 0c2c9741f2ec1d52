//! The `carom` command as a library: one file per subcommand. It reads flags and files, asks the core, and shows the answer.
//!
//! [`main()`] is the whole command, for programs that bring it along; [`told`] and [`write_report`] are what it prints of an impact and
//! writes of a run, for other fronts to show.

mod capture;
mod cli;
mod export;
mod failure;
mod figures;
mod fit;
mod grid;
mod history;
mod impact;
mod info;
mod law;
mod materials;
mod merge;
mod motion;
mod output;
mod removal;
mod report;
mod run;
mod samples;
mod shell;
mod study;
mod sweep;
mod text;
mod told;
mod trajectories;
mod validate;
mod values;
mod warnings;

pub use told::{told, write_report};

use clap::{CommandFactory as _, FromArgMatches as _};
use std::ffi::OsString;
use std::process::ExitCode;

/// Runs the command with these words, the command's own name first, and gives its exit code.
pub fn main(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    let reports = miette::set_hook(Box::new(|_| {
        Box::new(miette::MietteHandlerOpts::new().terminal_links(false).context_lines(1).build())
    }));
    // the only hook: it cannot have been set before
    drop(reports);
    // a value may begin with a sign: --spin -100rad/s
    let command = cli::Cli::command().mut_subcommands(|sub| {
        sub.mut_args(|arg| if takes_quantity(&arg) { arg.allow_hyphen_values(true) } else { arg })
    });
    let parsed = command.try_get_matches_from(words).and_then(|m| cli::Cli::from_arg_matches(&m));
    match parsed {
        Ok(cli) => cli.run().map_or_else(failure::Failure::report, |()| ExitCode::SUCCESS),
        // clap's own: help and version to standard output with 0, mistakes to standard error with 2
        Err(error) => {
            let _ = error.print();
            ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
        }
    }
}

fn takes_quantity(arg: &clap::Arg) -> bool {
    arg.get_action().takes_values() && arg.get_long().is_some() && arg.get_value_names().is_none_or(|n| n != ["FILE"])
}
