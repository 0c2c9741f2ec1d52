//! Plots of curves: where they turn, what their titles say, and none that would be empty.

use std::path::Path;
use std::process::{Command, Output};

fn carom(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_carom"));
    command.args(arguments.split_whitespace()).current_dir(folder).output().expect("it runs")
}

fn drawn(arguments: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let out = carom(folder.path(), &format!("{arguments} --plot p.svg"));
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    std::fs::read_to_string(folder.path().join("p.svg")).expect("a plot")
}

/// The points of the curves, in tenths of a pixel.
fn curves(svg: &str) -> Vec<Vec<[i64; 2]>> {
    let lines = svg.lines().filter(|l| l.starts_with("<polyline") && l.contains("stroke-width=\"20\""));
    let points = lines.filter_map(|l| l.split_once("points=\"")?.1.strip_suffix(" \"/>"));
    let numbers = |p: &str| {
        p.split(' ')
            .filter_map(|p| p.split_once(','))
            .map(|(x, y)| [x, y].map(|v| v.parse().expect("a number")))
            .collect()
    };
    points.map(numbers).collect()
}

#[test]
fn a_curve_steps_at_its_capture_velocity_however_few_its_points() {
    let svg = drawn("sweep --sphere copper --surface silicon --diameter 90um --over speed=0.001..30 --points 5");
    let curves = curves(&svg);
    let points = curves.first().expect("a curve");
    assert!(points.windows(2).any(|p| p[0][0] == p[1][0] && p[0][1] > p[1][1]), "an upright step: {points:?}");
}

#[test]
fn an_empty_plot_is_refused_with_the_reason() {
    let folder = tempfile::tempdir().expect("a folder");
    let head_on =
        "sweep --sphere copper --surface glass --diameter 10um --over speed=1..10 --quantity tangential-restitution";
    let out = carom(folder.path(), &format!("{head_on} --plot p.svg --out t.csv"));
    assert_eq!(out.status.code(), Some(2));
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(
        said.contains("p.svg: not written") && said.contains("head-on impacts have no tangential restitution"),
        "{said}"
    );
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 0);
}

#[test]
fn titles_say_what_all_curves_have_in_common() {
    let svg = drawn("capture --sphere copper --over diameter=1um..100um --by surface=glass,steel --points 9");
    assert!(svg.contains("\ncopper spheres, ea\n"));
    let svg = drawn("capture --sphere copper --surface glass --over diameter=1um..100um --by law=ea,eap --points 9");
    assert!(svg.contains("\ncopper on soda-lime-glass\n"));
}
