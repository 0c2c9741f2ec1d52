//! Micro-slip against the measurements of Kharaz, Gorham & Salman (2001), and against the springs integrated, through a whole law.

mod common;

use carom::material::Library;
use carom::pair::{Overrides, Pair};
use carom::tangential::micro_slip::resolved;
use carom::{Contact, Impact, Outcome, WallLaw};
use common::law;
use std::collections::BTreeMap;

const EXPERIMENT: &str = include_str!("../../carom-lab/data/experiments/kharaz-2001.toml");

#[derive(serde::Deserialize)]
struct File {
    law: BTreeMap<String, Inputs>,
    panel: [Panel; 1],
}

#[derive(serde::Deserialize)]
struct Inputs {
    sphere: String,
    surface: String,
    friction: f64,
    restitution: f64,
}

#[derive(serde::Deserialize)]
struct Panel {
    measured: [Measured; 1],
}

#[derive(serde::Deserialize)]
struct Measured {
    angle_from_normal_deg: Vec<f64>,
    value: Vec<f64>,
}

struct Experiment {
    sphere: String,
    surface: String,
    friction: f64,
    restitution: f64,
    measured: Measured,
}

impl Experiment {
    fn read() -> Self {
        let mut file: File = toml::from_str(EXPERIMENT).expect("the experiment's file");
        let Inputs { sphere, surface, friction, restitution } = file.law.remove("rolling").expect("its law");
        let [Panel { measured: [measured] }] = file.panel;
        Self { sphere, surface, friction, restitution, measured }
    }

    fn wall(&self, restitution: f64, tangential: &str) -> WallLaw {
        law(&format!(
            "sphere = \"{}\"\nsurface = \"{}\"\nnormal = \"constant\"\nrestitution = {restitution}\nfriction = {}\ntangential = \"{tangential}\"\n",
            self.sphere, self.surface, self.friction
        ))
    }

    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.measured.angle_from_normal_deg.iter().copied().zip(self.measured.value.iter().copied())
    }

    /// Greatest deviation of `model` (degrees from the normal to e_t).
    fn worst(&self, model: impl Fn(f64) -> f64) -> f64 {
        self.points().map(|(angle, measured)| (model(angle) - measured).abs()).fold(0.0, f64::max)
    }
}

fn hit(wall: &WallLaw, degrees_from_normal: f64) -> Outcome {
    let (s, c) = degrees_from_normal.to_radians().sin_cos();
    wall.impact(&Impact::new(5e-3, [3.9 * s, -3.9 * c, 0.0], [0.0, 1.0, 0.0])).expect("it approaches")
}

fn stiffness_ratio(sphere: &str, surface: &str) -> f64 {
    let library = Library::builtin();
    let get = |name: &str| library.get(name).expect("a material that comes along").clone();
    Pair::new(&get(sphere), &get(surface), &Overrides::default()).stiffness_ratio().expect("E and nu of both")
}

#[test]
fn measured_tangential_restitution_is_met_where_rolling_fails() {
    let experiment = Experiment::read();
    assert_eq!(experiment.points().count(), 8);
    let kappa = stiffness_ratio(&experiment.sphere, &experiment.surface);
    assert!((kappa - 0.859_143_574_9).abs() < 1e-9, "{kappa}");
    for e in [experiment.restitution, 1.0] {
        let closed = experiment.wall(e, "micro-slip");
        let exact = |angle: f64| {
            let psi = angle.to_radians().tan() / experiment.friction;
            1.0 - resolved::impulse(psi, kappa, e, 200) / psi
        };
        let (of_closed, of_exact) =
            (experiment.worst(|a| hit(&closed, a).tangential_restitution), experiment.worst(exact));
        assert!(of_closed < 0.035 && of_exact < 0.035, "e = {e}: {of_closed} {of_exact}");
        for (angle, _) in experiment.points() {
            assert!((hit(&closed, angle).tangential_restitution - exact(angle)).abs() < 5e-3, "{angle}");
        }
    }
    let rolling = experiment.wall(experiment.restitution, "rolling");
    let off = experiment.worst(|a| hit(&rolling, a).tangential_restitution);
    assert!(off > 0.11, "{off}");
}

/// A lossless contact of this pair, by another program for the same mechanism (springs by dimensionality reduction).
#[test]
fn the_integration_gives_the_known_values() {
    let experiment = Experiment::read();
    let known = [0.774, 0.751, 0.643, 0.593, 0.684, 0.775, 0.843, 0.893];
    for ((angle, _), expected) in experiment.points().zip(known) {
        let psi = angle.to_radians().tan() / experiment.friction;
        let got = 1.0 - resolved::impulse(psi, 0.859_143_6, 1.0, 200) / psi;
        assert!((got - expected).abs() < 7e-4, "{angle}: {got} {expected}");
    }
}

#[test]
fn the_stiffness_ratio_of_like_bodies_is_that_of_poissons_ratio() {
    for nu in [0.0, 0.2, 0.49] {
        let bodies = carom::material::Material::from_inline(&format!("E=1GPa,nu={nu}")).expect("fine");
        let pair = Pair::new(&bodies, &bodies, &Overrides { stiffness: Some(7e9), ..Overrides::default() });
        let kappa = pair.stiffness_ratio().expect("E and nu");
        assert!((kappa - 2.0 * (1.0 - nu) / (2.0 - nu)).abs() < 1e-14, "{nu}: {kappa}");
    }
}

#[test]
fn only_the_slip_counts_and_its_direction() {
    let wall = Experiment::read().wall(0.8, "micro-slip");
    let still = hit(&wall, 25.0);
    assert_eq!(still.contact, Contact::MicroSlip);
    let v_t = 3.9 * 25f64.to_radians().sin();
    // the same slip, all of it from spin, and split between both
    for part in [0.0, 0.4, 1.7] {
        let c = 3.9 * 25f64.to_radians().cos();
        let mut impact = Impact::new(5e-3, [part * v_t, -c, 0.0], [0.0, 1.0, 0.0]);
        impact.spin = [0.0, 0.0, (1.0 - part) * v_t / 2.5e-3];
        let out = wall.impact(&impact).expect("it approaches");
        assert!((out.impulse_ratio - still.impulse_ratio).abs() < 1e-14, "{part}");
        assert!((part * v_t - out.velocity[0] - (v_t - still.velocity[0])).abs() < 1e-14, "{part}");
    }
    // glancing: friction on the whole normal impulse
    let glancing = hit(&wall, 80.0);
    assert_eq!((glancing.contact, glancing.impulse_ratio), (Contact::Sliding, 0.092));
}
