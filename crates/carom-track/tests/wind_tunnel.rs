//! The example of the wind tunnel does what its comments say.

use carom::material::Library;
use carom_track::{Case, RunOptions, Silent, run};
use std::path::Path;

#[test]
fn the_wind_tunnel_is_as_its_comments_say() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/wind-tunnel.toml");
    let text = std::fs::read_to_string(&file).expect("the example");
    let case = Case::from_toml(&text, &file, Library::builtin()).expect("a good case");
    let out = tempfile::tempdir().expect("a folder");
    let options = RunOptions { out: Some(out.path().to_owned()), ..RunOptions::default() };
    let summary = run(&case, &options, &Silent).expect("the run");
    assert_eq!((summary.injected.count, summary.lost()), (2, 0));
    let mut rows = csv::Reader::from_path(out.path().join("impacts.csv")).expect("impacts");
    let rows: Vec<csv::StringRecord> = rows.records().collect::<Result<_, _>>().expect("rows");
    let landing = |particle: &str| -> f64 {
        let first = rows.iter().find(|r| &r[0] == particle).expect("an impact");
        first[2].parse().expect("x")
    };
    assert!((landing("0") - 0.070).abs() < 0.001, "{}", landing("0"));
    assert!((landing("1") - 0.14).abs() < 0.005, "{}", landing("1"));
}
