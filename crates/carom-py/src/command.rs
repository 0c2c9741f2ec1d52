//! The `carom` command, which the wheel brings along.

use pyo3::prelude::*;
use std::ffi::OsString;
use std::process::{ExitCode, Termination as _};

/// Runs the command and ends the process, as the command's own program does.
#[pyfunction]
pub fn command(py: Python<'_>, words: Vec<OsString>) {
    let code: ExitCode = py.detach(|| carom_cli::main(words));
    // `ExitCode` has no number that can be asked for; the process ends with it
    std::process::exit(i32::from(number(code)));
}

/// 0, 1 or 2: all that the command gives.
fn number(code: ExitCode) -> u8 {
    let code = code.report();
    (0..=2).find(|n| ExitCode::from(*n) == code).unwrap_or(1)
}
