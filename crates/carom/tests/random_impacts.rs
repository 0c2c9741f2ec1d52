//! Random legal impacts of every registered law: finite numbers, 0 ≤ e ≤ 1 (walls that scatter aside), energies that sum to 1, none
//! gained. `CAROM_IMPACTS=10000000 cargo test --release -p carom --test random_impacts` tries as many of each law,
//! on all cores; `CAROM_SEED` repeats one.

mod common;

use carom::normal::Loss;
use carom::{Fate, Impact, Outcome, WallLaw};
use common::{energy, law};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Philox-free and small: SplitMix64 (Steele, Lea & Flood 2014).
struct Draws(u64);

impl Draws {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Even in the logarithm.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    fn signed(&mut self, most: f64) -> f64 {
        most * (2.0 * self.unit() - 1.0)
    }

    fn vector(&mut self, length: f64) -> [f64; 3] {
        [0; 3].map(|_| self.signed(length))
    }

    fn impact(&mut self) -> Impact {
        let normal = loop {
            let normal = self.vector(1.0);
            if normal.iter().map(|c| c * c).sum::<f64>() > 0.01 {
                break normal;
            }
        };
        let diameter = self.decades(1e-9, 1e-2);
        let (along, down) = (self.decades(1e-6, 1e3), self.decades(1e-9, 1e3));
        let velocity = self.vector(along);
        let length2: f64 = normal.iter().map(|c| c * c).sum();
        let dot: f64 = velocity.iter().zip(&normal).map(|(v, n)| v * n).sum();
        let wall_velocity = if self.unit() < 0.3 { self.vector(along) } else { [0.0; 3] };
        // tangential as drawn, approaching at `down`
        let velocity = [0, 1, 2]
            .map(|i| velocity[i] - (dot / length2) * normal[i] - down * normal[i] / length2.sqrt() + wall_velocity[i]);
        let spin = if self.unit() < 0.5 { [0.0; 3] } else { self.vector(along / diameter) };
        let density = (self.unit() < 0.2).then(|| 1000.0 * self.decades(0.1, 10.0));
        let draws = [0; 4].map(|_| self.unit());
        Impact { density, spin, wall_velocity, draws, ..Impact::new(diameter, velocity, normal) }
    }
}

/// Every normal law with every tangential one, and walls that scatter.
fn laws() -> Vec<(String, WallLaw)> {
    let mut laws = common::all_laws().to_vec();
    let rough = "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nroughness_angle = \"5 deg\"\n";
    for rest in [
        "normal = \"ea\"\nfriction = 0.2\n",
        "normal = \"constant\"\nrestitution = 0.8\ntangential_restitution = 0.9\n",
        "normal = \"ea\"\ntangential = \"micro-slip\"\nfriction = 0.3\n",
    ] {
        let text = format!("{rough}{rest}");
        laws.push((text.clone(), law(&text)));
    }
    laws
}

fn check(text: &str, scatters: bool, impact: &Impact, out: &Outcome) {
    let fail = |what: &str| panic!("{what}: {impact:?}\n{out:?}\n{text}");
    let motion = out.velocity.iter().chain(&out.spin).all(|c| c.is_finite());
    if !(motion && out.restitution.is_finite()) {
        fail("not finite");
    }
    if !(out.restitution >= 0.0 && (scatters || out.restitution <= 1.0)) {
        fail("restitution outside 0 to 1");
    }
    let shares = out.energy.named();
    if !shares.iter().all(|(_, share)| (-1e-12..=1.0 + 1e-12).contains(share)) {
        fail("a share of energy outside 0 to 1");
    }
    if (shares.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() > 1e-12 {
        fail("energies do not sum to 1");
    }
    // relative to the wall, whose speed costs digits where it is much larger than the sphere's own
    let before = energy(impact.diameter, &impact.velocity, &impact.spin, &impact.wall_velocity);
    let after = energy(impact.diameter, &out.velocity, &out.spin, &impact.wall_velocity);
    let speed: f64 = impact.wall_velocity.iter().map(|c| c.abs()).sum::<f64>() + (2.0 * before).sqrt();
    if after > before * (1.0 + 1e-12) + 1e-14 * speed * (2.0 * before).sqrt() {
        fail("energy gained");
    }
    let still = out.spin == [0.0; 3] && out.velocity == impact.wall_velocity;
    if out.fate == Fate::Capture && !still {
        fail("a captured sphere moves");
    }
}

#[test]
fn every_law_keeps_its_invariants() {
    let number = |name: &str, default: u64| std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(default);
    let seed = number("CAROM_SEED", 20_261_126);
    let laws = laws();
    // the resolved equation takes microseconds an impact: fewer of those
    let each = number("CAROM_IMPACTS", 1000);
    println!("seed {seed}, {each} impacts of each of {} laws", laws.len());
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some((text, law)) = laws.get(next.fetch_add(1, Ordering::Relaxed)) {
                    keeps_its_invariants(text, law, seed, each);
                }
            });
        }
    });
}

fn keeps_its_invariants(text: &str, law: &WallLaw, seed: u64, each: u64) {
    // the same impacts whichever laws there are besides
    let own = text.bytes().fold(seed, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    let mut draws = Draws(own);
    let count = if text.contains("resolved") { each / 20 } else { each };
    let mut met = 0;
    for _ in 0..count {
        let impact = draws.impact();
        if let Ok(out) = law.impact(&impact) {
            check(text, law.scatter().is_some(), &impact, &out);
            met += 1;
        }
    }
    assert!(met > count / 2, "only {met} of {count} were impacts, seed {seed}: {text}");
}

#[test]
fn every_registered_loss_is_among_the_laws() {
    for loss in Loss::ALL {
        let tried = common::all_laws().iter().any(|(_, law)| {
            matches!(law.normal(), carom::normal::NormalLaw::Ledger(l) if l.terms().any(|t| t.loss() == *loss))
        });
        assert!(tried || *loss == Loss::AdhesionDamping, "{} is in no law of tests/common", loss.name());
    }
}
