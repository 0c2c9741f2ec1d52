//! `carom completions` and `carom man`: what a shell and its manual know of the command, made from its own flags.

use crate::cli::Cli;
use crate::failure::Failure;
use crate::output;
use clap::CommandFactory as _;
use clap_complete::Shell;

/// Completions of the command's flags for a shell, to standard output
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  carom completions bash > ~/.local/share/bash-completion/completions/carom
  carom completions zsh > ~/.zfunc/_carom
  carom completions fish > ~/.config/fish/completions/carom.fish")]
pub struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// The manual page, to standard output
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  carom man > carom.1
  carom man sweep > carom-sweep.1")]
pub struct Man {
    /// The page of a subcommand instead of the whole
    subcommand: Option<String>,
}

/// Prints the completions.
pub fn completions(args: &Completions) -> Result<(), Failure> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "carom", &mut text);
    output::print(&String::from_utf8_lossy(&text))
}

/// Prints the manual page.
pub fn man(args: &Man) -> Result<(), Failure> {
    let mut command = Cli::command();
    command.build();
    let page = match &args.subcommand {
        None => command,
        Some(name) => {
            let known: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
            let Some(sub) = command.find_subcommand(name) else {
                return Err(Failure::input(format!("no subcommand '{name}'; known are {}", known.join(", "))));
            };
            sub.clone()
        }
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(page).render(&mut text).map_err(|e| Failure::Other(e.to_string()))?;
    output::print(&String::from_utf8_lossy(&text))
}
