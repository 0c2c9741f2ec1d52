//! Runs a case file without the command: `cargo run --example track -- CASE.toml OUT`.

use carom::material::Library;
use carom_track::{Case, RunOptions, Silent, run};
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(file), out) = (args.next(), args.next()) else { return Err("a case file is needed".into()) };
    let text = std::fs::read_to_string(&file)?;
    let case =
        Case::from_toml(&text, &file, &Library::builtin()).map_err(|e| e.located(&file.to_string_lossy(), &text))?;
    let summary = run(&case, &RunOptions { out, ..RunOptions::default() }, &Silent)?;
    print!("{}", summary.to_json());
    Ok(())
}
