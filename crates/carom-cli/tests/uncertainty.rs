//! Distributions for values: against what is known exactly, and what must hold for every seed.

use carom::material::Library;
use carom::math::normal::normal_probability;
use serde_json::Value;
use std::process::Command;

const PAIR: &str = "--sphere copper --surface silicon";

fn carom(arguments: &str) -> String {
    let out = Command::new(env!("CARGO_BIN_EXE_carom")).args(arguments.split_whitespace()).output().expect("it runs");
    assert!(out.status.success(), "{arguments}: {}", String::from_utf8_lossy(&out.stderr));
    String::from_utf8(out.stdout).expect("text")
}

fn rows(arguments: &str) -> Vec<Value> {
    let text = carom(&format!("{arguments} --json"));
    match serde_json::from_str(&text).unwrap_or_else(|e| panic!("{arguments}: {e}")) {
        Value::Array(rows) => rows,
        other => vec![other],
    }
}

fn column(rows: &[Value], name: &str) -> Vec<f64> {
    rows.iter().map(|r| r[name].as_f64().unwrap_or(f64::NAN)).collect()
}

/// A sphere sticks where it is smaller than the critical diameter of its speed: a lognormal population sticks with the share of it
/// below.
#[test]
fn sticking_is_the_share_of_spheres_below_the_critical_diameter() {
    const SAMPLES: f64 = 4000.0;
    let law = carom::spec::parse_law("sphere = \"copper\"\nsurface = \"silicon\"\nnormal = \"ea\"\nfriction = 0\n");
    let law = law.and_then(|l| l.compile(Library::builtin())).expect("a law");
    let critical = |speed: f64| {
        let (mut low, mut high) = (1e-7f64, 1e-2f64);
        for _ in 0..100 {
            let d = (low * high).sqrt();
            let window = law.window(d, None).expect("in range").expect("it rebounds");
            if window.capture_velocity > speed { low = d } else { high = d }
        }
        low
    };
    for (command, seed) in [("sweep", 1), ("capture", 2)] {
        let arguments = format!(
            "{command} {PAIR} --diameter lognormal(50um,1.3) --over speed=0.15..0.8 --points 12 --samples {SAMPLES} --seed {seed}"
        );
        let rows = rows(&arguments);
        let sticking = column(&rows, "sticking_probability");
        for (speed, p) in column(&rows, "speed").into_iter().zip(&sticking) {
            let exact = normal_probability((critical(speed) / 50e-6).ln() / 1.3f64.ln());
            let error = (exact * (1.0 - exact) / SAMPLES).sqrt();
            assert!((p - exact).abs() < 4.0 * error + 1e-3, "seed {seed}, {speed} m/s: {p}, exactly {exact}");
        }
        // common random numbers: no curve rises where every sphere's falls
        assert!(sticking.windows(2).all(|w| w[0] >= w[1]), "{sticking:?}");
        let (low, high) = (column(&rows, "sticking_low"), column(&rows, "sticking_high"));
        assert!(sticking.iter().zip(low).zip(high).all(|((p, low), high)| low <= *p && *p <= high));
    }
}

#[test]
fn quantiles_of_a_monotone_figure_are_the_figure_of_the_quantiles() {
    let of = |factor: f64| {
        column(&rows(&format!("capture {PAIR} --diameter 50um --roughness-factor {factor}")), "capture_velocity")[0]
    };
    let drawn = rows(&format!("capture {PAIR} --diameter 50um --roughness-factor uniform(0.4,0.8) --samples 20000"));
    for (name, factor) in [("median", 0.6), ("p05", 0.42), ("p95", 0.78)] {
        let got = drawn[0]["capture_velocity"][name].as_f64().expect("a number");
        assert!((got / of(factor) - 1.0).abs() < 0.02, "{name}: {got} {}", of(factor));
    }
    assert_eq!(drawn[0]["never_rebounds"], 0.0);
    // over the diameter the same factors are drawn at every point: v_c is a power of C_R, one ratio
    let rows =
        rows(&format!("capture {PAIR} --roughness-factor uniform(0.4,0.8) --over diameter=10..100um --points 5"));
    let ratio: Vec<f64> = column(&rows, "capture_velocity_p95")
        .iter()
        .zip(column(&rows, "capture_velocity_median"))
        .map(|(a, b)| a / b)
        .collect();
    assert!(ratio.iter().all(|r| (r / ratio[0] - 1.0).abs() < 1e-9), "{ratio:?}");
}

#[test]
fn a_seed_gives_the_same_samples_and_another_gives_others() {
    let run = |seed: u32| {
        carom(&format!(
            "sweep {PAIR} --diameter lognormal(50um,1.3) --over speed=0.2..0.4 --points 4 --seed {seed} --json"
        ))
    };
    assert_eq!(run(1), run(1));
    assert_ne!(run(1), run(2));
    // a second distribution leaves the first one's draws as they are: with C_R all but fixed, the same probabilities
    let with = |factor: &str| {
        column(
            &rows(&format!("sweep {PAIR} --diameter lognormal(50um,1.3) --over speed=0.2..0.4 --points 4 {factor}")),
            "sticking_probability",
        )
    };
    assert_eq!(with("--roughness-factor 0.8"), with("--roughness-factor uniform(0.7999999,0.8000001)"));
}

#[test]
fn a_wall_that_scatters_has_bands_without_distributions() {
    let rows = rows(&format!(
        "sweep {PAIR} --diameter 90um --friction 0.2 --speed 5 --over angle=3..87 --points 3 --roughness-angle 5 --samples 400"
    ));
    let (low, median, high) =
        (column(&rows, "restitution_p05"), column(&rows, "restitution_median"), column(&rows, "restitution_p95"));
    assert!((0..3).all(|i| low[i] < median[i] && median[i] < high[i]));
    assert!(median[0] > 1.5 && (0.8..1.0).contains(&median[2]), "{median:?}");
}

#[test]
fn bands_are_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bands.svg");
    let text = carom(&format!(
        "sweep {PAIR} --diameter lognormal(50um,1.3) --over speed=0.05..1 --plot {}",
        path.to_str().expect("text")
    ));
    assert_eq!(text, "");
    let svg = std::fs::read_to_string(path).expect("a plot");
    for part in ["<polygon", "5–95 %", "median", "sticking probability", "diameter lognormal(50um,1.3)"] {
        assert!(svg.contains(part), "{part}");
    }
}
