//! Any bytes as a file of triangles, in each format: triangles with finite corners, or a refusal. `cargo fuzz run triangles`
#![no_main]

use carom_track::geometry::{Mesh, triangles};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (u8, &[u8])| {
    let (kind, bytes) = input;
    let name = ["w.stl", "w.obj", "w.ply"][usize::from(kind % 3)];
    let Ok(read) = triangles::read(name, bytes) else { return };
    assert!(read.triangles.iter().flatten().flatten().all(|c| c.is_finite()));
    assert_eq!(read.solids.iter().map(|s| s.triangles.len()).sum::<usize>(), read.triangles.len());
    let _ = Mesh::with_precision(&read.triangles, read.precision);
});
