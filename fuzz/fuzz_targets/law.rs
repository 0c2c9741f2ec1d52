//! Any text as a wall law: it is refused, or it answers within its invariants. `cargo fuzz run law`
#![no_main]

use carom::{Impact, material::Library, spec::parse_law};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(law) = parse_law(text).and_then(|law| law.compile(Library::builtin())) else { return };
    if let Ok(out) = law.impact(&Impact::new(7e-5, [1.0, -2.0, 0.0], [0.0, 1.0, 0.0])) {
        assert!((0.0..=1.0).contains(&out.restitution));
        assert!(out.energy.kept <= 1.0 + 1e-9);
    }
});
