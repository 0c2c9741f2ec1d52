//! Laws of every kind, and helpers of the property tests.

// each test file uses its own part
#![allow(dead_code)]

pub mod motion;

use carom::material::Library;
use carom::{Impact, Outcome, Vec3, WallLaw};
use std::sync::LazyLock;

static ALL: LazyLock<Vec<(String, WallLaw)>> = LazyLock::new(combine);

/// Compiles a law, with the message of what is wrong if it fails.
pub fn law(text: &str) -> WallLaw {
    let spec = carom::spec::parse_law(text).unwrap_or_else(|e| panic!("{}", e.located("law", text)));
    spec.compile(Library::builtin()).unwrap_or_else(|e| panic!("{}", e.located("law", text)))
}

const STEEL: &str = "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nroughness_factor = 0.15\n";
const ALUMINA: &str = "sphere = \"aluminium-oxide\"\nsurface = \"aluminium-gorham-kharaz\"\n";
/// What micro-slip needs beside a table: two rubbery bodies, nearly incompressible, so that κ is near its least.
const BARE: &str = "sphere = \"rho=1100,E=5MPa,nu=0.48\"\nsurface = \"E=3MPa,nu=0.49\"\n";

/// Normal laws of every kind, without a tangential law.
pub fn normal_laws() -> Vec<String> {
    let steel = |rest: &str| format!("{STEEL}{rest}\n");
    let alumina = |rest: &str| format!("{ALUMINA}work_of_adhesion = 0.5\n{rest}\n");
    let dry = |rest: &str| format!("{ALUMINA}{rest}\n");
    let table = |rest: &str| format!("{BARE}{rest}\n");
    vec![
        steel("normal = \"ea\""),
        steel("normal = \"ea\"\nadhesion_damping = 1.3\nhertz_damping = 0.007"),
        steel("normal = \"ea\"\nsurface_curvature = \"1 mm\""),
        steel("normal = [\"adhesion-damping\", \"hertz-damping\"]\nadhesion_damping = 1.3\nhertz_damping = 0.01"),
        alumina("normal = \"eap\""),
        alumina("normal = \"eap\"\nhertz_damping = 0.001\nsurface_curvature = \"-20 mm\""),
        dry("normal = [\"plastic-kadomtsev\"]"),
        alumina("normal = \"thornton-ning\""),
        alumina("normal = [\"adhesion-work\", \"plastic-thornton-ning\", \"hertz-damping\"]\nhertz_damping = 0.002"),
        dry("normal = \"tabor\"\nyield_velocity = 0.09\nmeyer_index = 2.29"),
        alumina("normal = [\"plastic-tabor\", \"adhesion-jkr\"]\nyield_velocity = 0.09\nmeyer_index = 2.29"),
        alumina("normal = [\"plastic-bons\", \"adhesion-work\"]"),
        dry("normal = [\"plastic-bons\", \"hertz-damping\"]\nhertz_damping = 0.002"),
        alumina("normal = [\"plastic-bons\", \"adhesion-jkr\"]\nplastic_constant = \"3 MPa\""),
        table("normal = \"constant\"\nrestitution = 0.7"),
        table("normal = \"by-angle\"\nrestitution = \"grant-tabakoff\""),
        table("normal = \"by-angle\"\nrestitution = { angle_deg = [10, 45, 90], value = [0.9, 0.7, 0.6] }"),
        "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nnormal = \"ea\"\nroughness = \"1 nm\"\nroughness_model = \"fuller-tabor\"\nasperity_radius = \"50 nm\"\n".into(),
        steel("normal = \"resolved\""),
        steel("normal = \"resolved\"\nadhesion = \"reversible\"\nadhesion_damping = 1.3\nhertz_damping = 0.007"),
        table("normal = \"dahneke\"\nrestitution = 0.95\nwell_depth = \"1e-16 J\"\nwell_depth_out = \"3e-16 J\""),
        table("normal = \"dahneke\"\nrestitution = 0.9\nhamaker_constant = \"1e-19 J\"\nequilibrium_spacing = \"0.4 nm\""),
    ]
}

/// Tangential laws of every kind.
pub fn tangential_laws() -> Vec<&'static str> {
    vec![
        "friction = 0.2",
        "friction = 0",
        "friction = 5",
        "tangential = \"walton\"\nwalton_beta = 0.4\nfriction = 0.3",
        "tangential = \"walton\"\nwalton_beta = 1\nfriction = 5",
        "tangential = \"micro-slip\"\nfriction = 0.2",
        "tangential = \"micro-slip\"\nfriction = 2",
        "tangential = \"micro-slip\"\nfriction = 0",
        "tangential_restitution = 0.9",
        "tangential_restitution = \"grant-tabakoff\"",
    ]
}

/// Every normal law with every tangential one.
pub fn all_laws() -> &'static [(String, WallLaw)] {
    &ALL
}

fn combine() -> Vec<(String, WallLaw)> {
    let mut laws = Vec::new();
    for normal in normal_laws() {
        for tangential in tangential_laws() {
            let text = format!("{normal}{tangential}\n");
            let wall = law(&text);
            laws.push((text, wall));
        }
    }
    laws
}

/// Kinetic energy per mass relative to a wall of the given velocity, translation plus spin.
pub fn energy(diameter: f64, velocity: &Vec3, spin: &Vec3, wall: &Vec3) -> f64 {
    let relative: f64 = (0..3).map(|i| (velocity[i] - wall[i]).powi(2)).sum();
    let spins: f64 = spin.iter().map(|w| w * w).sum();
    0.5 * relative + 0.2 * (0.5 * diameter).powi(2) * spins
}

/// Energy kept by an outcome, as a fraction, computed from its motion alone.
pub fn kept(impact: &Impact, outcome: &Outcome) -> f64 {
    let after = energy(impact.diameter, &outcome.velocity, &outcome.spin, &impact.wall_velocity);
    after / energy(impact.diameter, &impact.velocity, &impact.spin, &impact.wall_velocity)
}
