//! ns per impact on one core: batches of 4 096 rows in cache, one scalar call, the resolved equation.
//!
//! Batches run on every instruction set the machine has; how to read the numbers: `docs/benchmarks.md`.

use carom::batch::{Incidence, InstructionSet, Rebound};
use carom::material::Library;
use carom::{Impact, WallLaw};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

const ROWS: usize = 4096;

fn law(normal: &str) -> WallLaw {
    let text = format!(
        "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nfriction = 0.2\nroughness_factor = 0.15\n{normal}"
    );
    let spec = carom::spec::parse_law(&text).unwrap_or_else(|e| panic!("{}", e.located("bench", &text)));
    spec.compile(Library::builtin()).unwrap_or_else(|e| panic!("{e}"))
}

/// Spread over the ranges of the paper: 0.1 to 30 m/s, 20 to 120 µm, all angles, spins either way.
fn rows() -> [Vec<f64>; 4] {
    let at = |i: usize, k: usize| ((i * 2_654_435_761 + k * 40_503) % 65_536) as f64 / 65_536.0;
    [
        (0..ROWS).map(|i| 0.1 * 300f64.powf(at(i, 1))).collect(),
        (0..ROWS).map(|i| 10.0 * at(i, 2)).collect(),
        (0..ROWS).map(|i| 2e4 * (at(i, 3) - 0.5)).collect(),
        (0..ROWS).map(|i| 20e-6 + 100e-6 * at(i, 4)).collect(),
    ]
}

const DAMPED: &str = "adhesion_damping = 1.3\nhertz_damping = 0.007\n";

fn batches(c: &mut Criterion) {
    let [normal, tangential, spin, diameter] = rows();
    let incidence = Incidence { normal: &normal, tangential: &tangential, spin: &spin, diameter: &diameter };
    let (mut n, mut t, mut w) = (vec![0.0; ROWS], vec![0.0; ROWS], vec![0.0; ROWS]);
    let mut group = c.benchmark_group("batch");
    group.throughput(Throughput::Elements(ROWS as u64));
    for (name, text) in [
        ("ea", format!("normal = \"ea\"\n{DAMPED}")),
        ("eap", "normal = \"eap\"\n".to_owned()),
        ("thornton-ning", "normal = [\"plastic-thornton-ning\", \"adhesion-work\"]\n".to_owned()),
        ("ea, micro-slip", format!("normal = \"ea\"\n{DAMPED}tangential = \"micro-slip\"\n")),
    ] {
        let law = law(&text);
        for set in InstructionSet::available() {
            group.bench_function(format!("{name}/{set:?}"), |b| {
                b.iter(|| law.impact_batch_on(set, black_box(&incidence), &mut Rebound::new(&mut n, &mut t, &mut w)));
            });
        }
    }
    group.finish();
}

fn scalar(c: &mut Criterion) {
    let [normal, tangential, spin, diameter] = rows();
    let mut group = c.benchmark_group("scalar");
    group.throughput(Throughput::Elements(ROWS as u64));
    for (name, text) in [
        ("ea", format!("normal = \"ea\"\n{DAMPED}")),
        ("eap", "normal = \"eap\"\n".to_owned()),
        ("ea, micro-slip", format!("normal = \"ea\"\n{DAMPED}tangential = \"micro-slip\"\n")),
        ("ea, rough", format!("normal = \"ea\"\n{DAMPED}roughness_angle = \"5 deg\"\n")),
        ("constant", "normal = \"constant\"\nrestitution = 0.9\n".to_owned()),
        ("resolved", format!("normal = \"resolved\"\n{DAMPED}")),
    ] {
        let law = law(&text);
        let impacts: Vec<Impact> = (0..ROWS)
            .map(|i| {
                let mut impact =
                    Impact::new(diameter[i], [0.6 * tangential[i], -normal[i], 0.8 * tangential[i]], [0.0, 1.0, 0.0]);
                impact.spin = [0.5 * spin[i], 0.3 * spin[i], -spin[i]];
                impact.draws = [1, 2, 3, 4].map(|k| ((i * 7_919 + k * 104_729) % 65_521) as f64 / 65_521.0);
                impact
            })
            .collect();
        group.bench_function(name, |b| {
            b.iter(|| {
                for impact in &impacts {
                    let out = law.impact(black_box(impact));
                    black_box(&out);
                }
            });
        });
    }
    group.finish();
}

criterion_group!(benches, batches, scalar);
criterion_main!(benches);
