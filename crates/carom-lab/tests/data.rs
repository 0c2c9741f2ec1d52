//! What the crate embeds is all there is, and the same as what lies in the repository's folders.

use std::fs;
use std::path::Path;

#[test]
fn every_experiment_of_the_folder_is_embedded() {
    let mut embedded: Vec<String> = carom_lab::builtin().expect("they read").into_iter().map(|e| e.name).collect();
    embedded.sort();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/experiments");
    let files = carom_lab::from_folder(&folder).expect("they read");
    let mut names: Vec<String> = files.into_iter().map(|e| e.name).collect();
    names.sort();
    assert_eq!(embedded, names);
}

#[test]
fn the_wind_tunnel_is_the_one_of_the_examples() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in ["wind-tunnel.toml", "wind-tunnel-upward.toml"] {
        let text = |folder: &str| fs::read_to_string(root.join(folder).join(name)).expect(name);
        assert_eq!(text("data/cases"), text("../../examples"), "{name}: copy the example over the crate's file");
    }
}
