//! Any bytes as an STL file: triangles with finite corners, or a refusal. `cargo +nightly fuzz run stl`
#![no_main]

use carom_track::geometry::{Mesh, stl};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(read) = stl::read(bytes) else { return };
    assert!(read.triangles.iter().flatten().flatten().all(|c| c.is_finite()));
    assert_eq!(read.solids.iter().map(|s| s.triangles.len()).sum::<usize>(), read.triangles.len());
    let _ = Mesh::with_precision(&read.triangles, read.precision);
});
