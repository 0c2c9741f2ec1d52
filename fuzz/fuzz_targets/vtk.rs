//! Any bytes as a VTK file of a mesh: a mesh that holds together with finite fields, or a refusal. `cargo fuzz run vtk`
#![no_main]

use carom_cfd::vtk::{Options, from_bytes};
use carom_cfd::{Field, check};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (bool, &[u8])| {
    let (named, bytes) = input;
    let options = Options { patches: named.then(|| "zone".to_owned()), ..Options::default() };
    let Ok(snapshot) = from_bytes(bytes.to_vec(), &options) else { return };
    assert_eq!(check::snapshot(&snapshot), Ok(()));
    if let Some(Field::Points(values)) = &snapshot.fields.velocity {
        assert_eq!(values.len(), snapshot.mesh.points.len());
    }
});
