//! The same impacts as `cost.c` from Rust, over and over; `benches/c-interface.sh` counts and times them.

use carom::material::Library;
use carom::{Impact, Outcome};

const ROWS: usize = 512;
const WALL: &str = r#"
sphere = "stainless-steel"
surface = "silicon"
normal = "ea"
friction = 0.2
roughness_factor = 0.15
adhesion_damping = 1.3
hertz_damping = 0.007
"#;

fn main() {
    let rounds: usize = std::env::args().nth(1).and_then(|a| a.parse().ok()).unwrap_or(1000);
    let spec = carom::spec::parse_law(WALL).unwrap_or_else(|e| panic!("{e}"));
    let law = spec.compile(Library::builtin()).unwrap_or_else(|e| panic!("{e}"));
    let at = |i: usize, k: usize| ((i * 2_654_435_761 + k * 40_503 * (i % 97 + 1)) % 65_536) as f64 / 65_536.0;
    let ins: Vec<Impact> = (0..ROWS)
        .map(|i| {
            let velocity = [10.0 * at(i, 2), -0.1 - 10.0 * at(i, 3), 0.0];
            let mut impact = Impact::new(20e-6 + 100e-6 * at(i, 1), velocity, [0.0, 1.0, 0.0]);
            impact.spin[2] = 2e4 * (at(i, 4) - 0.5);
            impact
        })
        .collect();
    let mut outs: Vec<Option<Outcome>> = vec![None; ROWS];
    let mut sum = 0.0;
    for round in 0..rounds {
        for (impact, out) in ins.iter().zip(&mut outs) {
            *out = law.impact(impact).ok();
        }
        sum += outs[round % ROWS].map_or(0.0, |o| o.velocity[1]);
    }
    println!("sum {sum:.9}");
}
