//! Files the command writes: tables, plots, histories; and none where it fails.

use std::path::Path;
use std::process::{Command, Output, Stdio};

fn carom(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_carom"));
    command.args(arguments.split_whitespace()).current_dir(folder).output().expect("it runs")
}

fn entries(folder: &Path) -> Vec<String> {
    let names = std::fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").file_name());
    let mut names: Vec<String> = names.map(|n| n.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

const SWEEP: &str = "sweep --sphere copper --surface silicon --diameter 90um --over speed=0.01..30";

#[test]
fn tables_have_a_row_for_each_point_in_every_format() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["t.csv", "t.json", "t.parquet"] {
        let out = carom(folder.path(), &format!("{SWEEP} --points 11 --out {name}"));
        assert!(out.status.success() && out.stdout.is_empty(), "{name}");
        assert_eq!(String::from_utf8_lossy(&out.stderr), format!("wrote {name}\n"));
    }
    assert_eq!(entries(folder.path()), ["t.csv", "t.json", "t.parquet"]);
    let csv = std::fs::read_to_string(folder.path().join("t.csv")).expect("text");
    assert_eq!(csv.lines().count(), 12);
    assert_eq!(
        csv.lines().next(),
        Some(
            "speed (m/s),fate,restitution,normal_speed_out (m/s),tangential_speed_out (m/s),spin_out (rad/s),angle_out_deg,impulse_ratio,\
             tangential_restitution,contact,energy_adhesion,energy_adhesion_damping,energy_hertz_damping,\
             energy_plastic,energy_other,energy_friction,energy_captured,energy_kept,validity"
        )
    );
    let json = std::fs::read_to_string(folder.path().join("t.json")).expect("text");
    let rows: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(rows.as_array().map(Vec::len), Some(11));
    assert!(std::fs::read(folder.path().join("t.parquet")).expect("bytes").starts_with(b"PAR1"));
}

#[test]
fn a_table_goes_to_standard_output_and_back_into_a_fit() {
    let folder = tempfile::tempdir().expect("a folder");
    let law = "--sphere copper --surface silicon --roughness-factor 0.1";
    for name in ["-", "/dev/stdout"] {
        let out = carom(
            folder.path(),
            &format!("sweep {law} --over speed=0.1..5 --by diameter=50,90um --points 5 --out {name}"),
        );
        assert!(out.status.success() && out.stderr.is_empty(), "{}", String::from_utf8_lossy(&out.stderr));
        let csv = String::from_utf8_lossy(&out.stdout).into_owned();
        assert!(csv.starts_with("diameter (um),speed (m/s),fate,restitution,"), "{csv}");
        assert!(csv.contains("\n90.0,5.0,rebound,"), "{csv}");
        std::fs::write(folder.path().join("s.csv"), csv).expect("a file");
    }
    let fit = carom(
        folder.path(),
        "fit s.csv --sphere copper --surface silicon --free roughness_factor --bootstrap 0 --json",
    );
    let told = String::from_utf8_lossy(&fit.stderr).into_owned();
    assert!(fit.status.success() && told.contains("note: s.csv: not used: fate,"), "{told}");
    let found: serde_json::Value = serde_json::from_slice(&fit.stdout).expect("JSON");
    assert!(found.to_string().contains("0.1"), "{found}");
    let both = carom(folder.path(), &format!("sweep {law} --diameter 9um --over speed=1..2 --out - --json"));
    assert_eq!(both.status.code(), Some(2));
}

#[test]
fn a_number_of_the_law_that_is_a_result_too_has_a_column_of_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let law = "--sphere copper --surface silicon --diameter 90um";
    let both = [
        (
            "sweep --law constant --speed 1 --angle 30 --tangential-restitution 0.5 --over restitution=0.2..0.8",
            "restitution",
        ),
        (
            "sweep --law constant --speed 1 --angle 30 --restitution 0.5 --over tangential-restitution=0.2..0.8",
            "tangential_restitution",
        ),
        ("capture --law tabor --meyer-index 2.29 --over yield-velocity=0.01..0.02", "yield_velocity"),
    ];
    for (n, (command, name)) in both.into_iter().enumerate() {
        let out = carom(folder.path(), &format!("{command} {law} --points 3 --out {n}.csv"));
        assert!(out.status.success(), "{command}: {}", String::from_utf8_lossy(&out.stderr));
        let text = std::fs::read_to_string(folder.path().join(format!("{n}.csv"))).expect("text");
        let columns: Vec<_> = text.lines().next().expect("a header").split(',').map(|c| c.split(' ').next()).collect();
        let given = format!("given_{name}");
        assert_eq!(columns[0], Some(given.as_str()), "{columns:?}");
        assert_eq!(columns.iter().filter(|c| **c == Some(name)).count(), 1, "{columns:?}");
    }
}

#[test]
fn plots_have_units_a_legend_and_a_log_scale() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = carom(folder.path(), &format!("{SWEEP} --by law=ea,eap --plot e.svg"));
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let svg = std::fs::read_to_string(folder.path().join("e.svg")).expect("text");
    for text in ["speed (m/s)", "restitution", "copper on silicon, 90 µm", ">\nea\n<", ">\neap\n<"] {
        assert!(svg.contains(text), "{text} is not in the plot");
    }
    // decades of a log scale
    for text in ["0.01", "0.1", "10"] {
        assert!(svg.contains(&format!(">\n{text}\n<")), "{text} is not on the axis");
    }
    let out = carom(folder.path(), &format!("{SWEEP} --plot e.png --out e.csv"));
    assert!(out.status.success());
    assert!(std::fs::read(folder.path().join("e.png")).expect("bytes").starts_with(b"\x89PNG"));
    assert_eq!(entries(folder.path()), ["e.csv", "e.png", "e.svg"]);
}

#[test]
fn a_single_curve_shows_its_capture_velocity() {
    let folder = tempfile::tempdir().expect("a folder");
    let law = "--sphere copper --surface steel --law eap --roughness-factor 0.1 --diameter 90um";
    assert!(carom(folder.path(), &format!("sweep {law} --over speed=0.001..30 --plot e.svg")).status.success());
    let svg = std::fs::read_to_string(folder.path().join("e.svg")).expect("text");
    assert!(svg.contains("capture velocity") && svg.contains("yield velocity"));
}

#[test]
fn capture_draws_a_curve_over_diameter() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = carom(
        folder.path(),
        "capture --sphere copper --over diameter=1..1000um --by surface=silicon,steel --plot c.svg --out c.csv",
    );
    assert!(out.status.success());
    let svg = std::fs::read_to_string(folder.path().join("c.svg")).expect("text");
    assert!(svg.contains("diameter (µm)") && svg.contains("capture velocity (m/s)"));
    let csv = std::fs::read_to_string(folder.path().join("c.csv")).expect("text");
    assert!(
        csv.starts_with("surface,diameter (um),capture_velocity (m/s),exhausted_velocity (m/s),yield_velocity (m/s),tabor_parameter,regime\nsilicon,1.0,")
    );
    assert_eq!(csv.lines().count(), 401);
}

#[test]
fn the_resolved_contact_has_a_history() {
    let folder = tempfile::tempdir().expect("a folder");
    let law = "--sphere copper --surface silicon --diameter 9um --speed 4 --angle 60 --friction 0.1 --law resolved";
    let out = carom(folder.path(), &format!("impact {law} --history h.csv --plot h.svg --json"));
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let answer: serde_json::Value = serde_json::from_slice(&out.stdout).expect("JSON");
    let csv = std::fs::read_to_string(folder.path().join("h.csv")).expect("text");
    assert!(csv.starts_with("time (s),overlap (m),speed (m/s),hertz_force (N),net_force (N),slip (m/s)\n"));
    let last: Vec<f64> = csv.lines().last().expect("rows").split(',').map(|v| v.parse().expect("a number")).collect();
    let normal = answer["rebound"]["normal"].as_f64().expect("a number");
    // it leaves as fast as the impact says
    assert!((last[2] + normal).abs() < 1e-7 * normal, "{last:?} and {normal}");
    assert!(std::fs::read_to_string(folder.path().join("h.svg")).expect("text").contains("time (ns)"));
}

#[test]
fn nothing_is_written_where_something_is_wrong() {
    let folder = tempfile::tempdir().expect("a folder");
    for wrong in [
        "sweep --sphere coppre --surface silicon --diameter 90um --over speed=1..2 --out t.csv --plot t.svg",
        "sweep --sphere copper --surface silicon --diameter 90um --over speed=1..2 --out t.csv --plot t.pdf",
        "sweep --sphere copper --surface silicon --diameter 90um --over speed=1..2 --out t.csv --plot no/t.svg",
        "sweep --sphere copper --surface silicon --diameter 90um --over speed=1..2 --out t.svg --plot t.svg",
        "sweep --sphere copper --surface silicon --over speed=1..2 --by diameter=1um,1kg --out t.csv",
        "sweep --sphere copper --surface silicon --surface-curvature -20um --over diameter=1..90um --out t.csv",
        "impact --sphere copper --surface silicon --diameter 9um --speed 2 --history t.csv",
        "impact --sphere copper --surface silicon --diameter 9um --speed 2 --law resolved --history t.xls",
        "capture --sphere copper --surface silicon --over diameter=1..2 --by friction=x --out t.csv",
    ] {
        let out = carom(folder.path(), wrong);
        assert_eq!(out.status.code(), Some(2), "{wrong}");
        assert!(out.stdout.is_empty() && out.stderr.starts_with(b"error: "), "{wrong}");
        assert_eq!(entries(folder.path()), [""; 0], "{wrong}");
    }
}

#[test]
fn values_at_the_edge_are_refused_or_answered_but_never_a_panic() {
    let folder = tempfile::tempdir().expect("a folder");
    for edge in [
        "--diameter 1e-10m --speed 1e-149m/s",
        "--diameter 10m --speed 9.9e8",
        "--diameter 9um --speed 2 --stiffness 1e300Pa",
        "--diameter 9um --speed 2 --stiffness 1e-300Pa",
        "--diameter 9um --speed 2 --work-of-adhesion 1e300",
        "--diameter 9um --speed 2 --work-of-adhesion 0",
        "--diameter 9um --speed 2 --adhesion-damping 1e300 --hertz-damping 1e300",
        "--diameter 9um --speed 2 --law eap --plastic-constant 1e-300",
        "--diameter 9um --speed 2 --law eap --plastic-constant 1e300",
        "--diameter 9um --speed 2 --law resolved --hertz-damping 1e6",
        "--diameter 9um --speed 2 --law resolved --work-of-adhesion 1e300",
        "--diameter 9um --speed 2 --roughness 1m",
        "--diameter 9um --speed 2 --angle 1e-300 --friction 0.1",
        "--diameter 9um --speed 2 --angle 1e-6 --friction 1e300",
        "--diameter 9um --speed 2 --spin 9e99 --friction 0.1",
        "--diameter 9um --speed 2 --surface-curvature 1e-300m",
        "--diameter 9um --speed 2 --interfacial-parameter 1e300",
    ] {
        let out = carom(folder.path(), &format!("impact --sphere copper --surface silicon {edge} --json"));
        let code = out.status.code();
        assert!(code == Some(0) || code == Some(2), "{edge}: {code:?} {}", String::from_utf8_lossy(&out.stderr));
        if code == Some(0) {
            let answer: serde_json::Value = serde_json::from_slice(&out.stdout).expect(edge);
            let e = answer["restitution"].as_f64();
            assert!(e.is_some_and(|e| (0.0..=1.0).contains(&e)), "{edge}: {answer}");
        }
    }
}

#[test]
fn a_closed_pipe_ends_it_quietly() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_carom"))
        .args(format!("{SWEEP} --points 100000").split_whitespace())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it runs");
    drop(child.stdout.take());
    let out = child.wait_with_output().expect("it ends");
    assert_eq!(out.status.code(), Some(0));
    assert!(out.stderr.is_empty(), "{}", String::from_utf8_lossy(&out.stderr));
}

#[test]
fn nothing_is_coloured_in_a_pipe() {
    let folder = tempfile::tempdir().expect("a folder");
    for arguments in
        ["--help", "impact --help", "materials copper", "impact --frction 2", "materials --materials x.toml"]
    {
        let out = carom(folder.path(), arguments);
        assert!(!out.stdout.contains(&b'\x1b') && !out.stderr.contains(&b'\x1b'), "{arguments}");
    }
}

#[test]
fn long_help_has_an_example_of_each() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["impact", "sweep", "capture", "materials"] {
        let out = carom(folder.path(), &format!("{name} --help"));
        let help = String::from_utf8(out.stdout).expect("text");
        assert!(out.status.success() && help.contains(&format!("\n  carom {name} ")), "{name}: {help}");
    }
    let version = carom(folder.path(), "--version");
    assert_eq!(String::from_utf8_lossy(&version.stdout), format!("carom {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn measured_points_lie_over_a_prediction_and_a_title_names_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let (points, plot) = (folder.path().join("p.csv"), folder.path().join("p.svg"));
    std::fs::write(&points, "speed,restitution,sigma\n1,0.8,0.05\n5,0.6,0.03\n").expect("written");
    let base = ["sweep", "--sphere", "copper", "--surface", "glass", "--diameter", "90um", "--over", "speed=0.1..30"];
    let run = |more: &[&str]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_carom"));
        command.args(base).arg("--data").arg(&points).args(more).output().expect("it runs")
    };
    let plot_text = plot.to_str().expect("a path");
    assert!(run(&["--plot", plot_text, "--title", "My <own> data"]).status.success());
    let svg = std::fs::read_to_string(&plot).expect("a plot");
    assert!(
        svg.contains("measured") && svg.contains("My &lt;own> data") | svg.contains("My &lt;own&gt; data"),
        "{svg}"
    );
    // points have no such quantity; without a plot there is nothing to draw on
    assert_eq!(run(&["--plot", plot_text, "--quantity", "angle-out"]).status.code(), Some(2));
    assert_eq!(run(&[]).status.code(), Some(2));
}

#[test]
fn two_ranges_make_a_map_of_capture_rebound_and_yield() {
    let folder = tempfile::tempdir().expect("a folder");
    let (table, plot) = (folder.path().join("m.csv"), folder.path().join("m.svg"));
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_carom"));
    command.args(["sweep", "--sphere", "copper", "--surface", "silicon", "--law", "eap", "--points", "12"]);
    command
        .args(["--over", "speed=0.1..30", "--over", "diameter=1..100um", "--out"])
        .arg(&table)
        .arg("--plot")
        .arg(&plot);
    assert!(command.output().expect("it runs").status.success());
    let table = std::fs::read_to_string(&table).expect("a table");
    assert_eq!(table.lines().count(), 1 + 12 * 12);
    assert!(table.contains("capture") && table.contains("rebound"));
    let svg = std::fs::read_to_string(&plot).expect("a map");
    let named = |class: &str| svg.lines().any(|line| line.trim() == class);
    assert!(["capture", "rebound", "rebound with yield"].into_iter().all(named), "{svg}");
}

#[test]
fn info_goes_by_what_a_file_holds() {
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = "# vtk DataFile Version 3.0\nan unstructured_grid by title\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n\
        0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\nVECTORS U double\n1 0 0 1 0 0 1 0 0 1 0 0\n";
    let grid =
        "# vtk DataFile Version 3.0\nno dataset unstructured_grid\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n\
        ORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 8\nVECTORS U double\n"
            .to_owned() + &"1 0 0\n".repeat(8);
    let pieces = "<?xml version=\"1.0\"?><!-- of \"one\" --><VTKFile version=\"1.0\" type='vtkPartitionedDataSet'>\
        <vtkPartitionedDataSet><DataSet index=\"0\" file=\"none.vtu\"/></vtkPartitionedDataSet></VTKFile>";
    let times = "<VTKFile type=\"Collection\"><Collection/></VTKFile>";
    let told = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("a file");
        let out = carom(folder.path(), &format!("info {name}"));
        String::from_utf8_lossy(&out.stdout).into_owned() + &String::from_utf8_lossy(&out.stderr)
    };
    assert!(told("mesh.data", mesh).contains("1 tetrahedra"));
    assert!(told("grid.vtk", &grid).contains("flow table"));
    assert!(told("pieces.vtpd", pieces).contains("none.vtu"));
    assert!(told("times.pvd", times).contains("name the file of one time"));
}

#[cfg(feature = "fluent")]
#[test]
fn what_info_says_of_an_axisymmetric_case_of_fluent_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("../carom-cfd/tests/fluent");
    for name in ["flat.cas.h5", "flat.dat.h5"] {
        std::fs::copy(stored.join(name), folder.path().join(name)).expect("a copy");
    }
    let out = carom(folder.path(), "info flat.cas.h5 --axisymmetric x");
    let told = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(told.contains("front  wedge") && told.contains("a wedge of 5 degrees"), "{told}");
    let (_, tables) = told.split_once("For a case file:\n").expect("tables to paste");
    let rest = "\n[[injection]]\ndensity = 1000\ndiameter = \"50 um\"\ncount = 20\nposition = { box = [[0.1, 0.2, 0], [0.3, 0.8, 0]] }\n\
                velocity = [1, 0, 0]\n[run]\nuntil = \"10 s\"\n";
    std::fs::write(folder.path().join("case.toml"), format!("{tables}{rest}")).expect("a case");
    let out = carom(folder.path(), "run case.toml");
    let told = String::from_utf8_lossy(&out.stdout).into_owned() + &String::from_utf8_lossy(&out.stderr);
    // its swirl of 100 m/s throws all to the wall
    assert!(out.status.success() && told.contains("20 particles: 20 trapped"), "{told}");
    for (arguments, want) in [
        ("info case.toml --axisymmetric x", "--axisymmetric is of a mesh of VTK or Fluent"),
        ("info flat.cas.h5 --axisymmetric r", "x, y or z is wanted"),
        ("info flat.cas.h5", "axisymmetric = \"x\""),
    ] {
        let out = carom(folder.path(), arguments);
        assert_eq!(out.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&out.stderr).contains(want), "{arguments}");
    }
}
