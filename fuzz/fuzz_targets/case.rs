//! Any text as a case file: it is read or refused, never a panic. `cargo fuzz run case`
#![no_main]

use carom::material::Library;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|text: &str| {
    let _ = carom_track::Case::from_toml(text, Path::new("case.toml"), Library::builtin());
});
