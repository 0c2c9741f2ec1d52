//! What a step computes has the same bits on every machine: one fingerprint over flows, forces, draws and starts.

use carom::instructions::InstructionSet;
use carom::material::Library;
use carom_track::Case;
use carom_track::flow::{Channel, Flow, Fluid, Pipe, Profile, SlotJet};
use carom_track::force::{Drag, Forces, NearWall, RandomWalk, Slip, Sphere};
use carom_track::injection::{Amount, By, Diameter, Injection, Plan, Sizes, Source, Start, Window};
use carom_track::record::{End, ImpactRecord, Sink};
use carom_track::tracker::Particle;
use std::path::Path;

/// FNV-1a over the bits.
fn fingerprint(values: impl IntoIterator<Item = f64>) -> u64 {
    // a NaN's sign and payload are the processor's own affair
    let bits = |v: f64| if v.is_nan() { 1 } else { v.to_bits() };
    let bytes = values.into_iter().flat_map(|v| bits(v).to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, b| (hash ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
}

fn flows() -> [Flow; 3] {
    let air = Fluid::default();
    [
        Flow::Channel(Channel::new(Profile::Turbulent, 0.03, 2.0, &air).unwrap()),
        Flow::Pipe(Pipe::new(Profile::Turbulent, [0.0; 3], [1.0, 2.0, 3.0], 0.02, 5.0, &air).unwrap()),
        Flow::SlotJet(SlotJet::new(0.03, 2.0).unwrap()),
    ]
}

fn injected() -> Vec<f64> {
    let plan = Plan {
        source: Source::Disc { centre: [0.0, 0.01, 0.0], normal: [1.0, 1.0, 0.0], radius: 0.005 },
        velocity: Start::Fluid,
        sizes: Sizes::RosinRammler { mean: 6e-5, spread: 3.5, min: 5e-6, max: 2e-4, by: By::Mass },
        diameter: Diameter::Aerodynamic(Slip::AllenRaabe),
        window: Window { start: 0.0, stop: 1.0 },
        amount: Amount::MassFlow { rate: 1e-6, parcels: 50 },
        ..Plan::single([0.0; 3], [0.0; 3], 1e-5, 2500.0)
    };
    let by_mass = Injection::new(1, 2, plan.clone(), &Fluid::default()).unwrap();
    let by_number = Injection::new(1, 3, Plan { amount: Amount::Count(50), ..plan }, &Fluid::default()).unwrap();
    let starts = (0..50).flat_map(|i| [&by_mass, &by_number].map(|n| n.particle(i, |_, x| flows()[0].velocity(x))));
    starts.flat_map(|p| p.position.into_iter().chain(p.velocity).chain([p.diameter, p.time, p.weight])).collect()
}

fn stepped() -> Vec<f64> {
    let forces = Forces { saffman: true, magnus: true, rotational_drag: true, slip: Slip::Davies, ..Forces::default() };
    let air = Fluid::default();
    let sphere = Sphere { diameter: 2e-5, density: 2500.0 };
    let mut out = Vec::new();
    for (n, flow) in flows().iter().enumerate() {
        for i in 0..200 {
            let s = f64::from(i);
            let x = [1e-4 * s, 7e-5 * s, -5e-5 * s];
            let local = flow.sample(x);
            let rates = forces.rates(&air, &sphere, &local, [0.01 * s, 0.3, -0.1], [s, 2.0 * s, -300.0]);
            let near_wall = [NearWall::WangJames, NearWall::KallioReeks, NearWall::Isotropic][n];
            let walk = RandomWalk { near_wall, ..RandomWalk::default() };
            let nu = air.kinematic_viscosity();
            let u = walk.fluctuation([0.3, -1.2, 0.7], &local, nu);
            let place = walk.surroundings(|x| flow.sample(x), x, nu, 1e-4);
            out.extend(place.drift);
            out.extend(rates.acceleration.into_iter().chain(rates.spin).chain(u).chain(local.gradient[0]));
            out.extend([local.k, local.epsilon, Drag::MorsiAlexander.factor(s), walk.crossing(1e-3, 0.1, 0.2)]);
        }
    }
    out
}

#[test]
fn starts_and_steps_have_fixed_bits() {
    let (starts, steps) = (injected(), stepped());
    assert!(starts.iter().chain(&steps).all(|v| v.is_finite()));
    // these change only when a formula does, and then on every machine alike
    assert_eq!([fingerprint(starts), fingerprint(steps)], [0x3c6c_c139_68d0_30d9, 0xc028_6fef_569f_eec1]);
}

/// What was told, particle by particle.
struct Told(Vec<Vec<f64>>);

impl Sink for Told {
    fn start(&mut self, _: &Particle) -> bool {
        false
    }
    fn impact(&mut self, i: &ImpactRecord) {
        let all = &mut self.0[i.particle as usize];
        all.extend([i.time, i.normal_speed_in, i.tangential_speed_in, i.spin_in, i.restitution, i.impulse_ratio]);
        all.extend([i.normal_speed_out, i.tangential_speed_out, i.spin_out, i.wall as f64]);
        all.extend(i.position.iter().chain(&i.normal));
        all.extend(i.energy.named().map(|(_, share)| share));
    }
    fn point(&mut self, _: u64, _: f64, _: [f64; 3], _: [f64; 3], _: [f64; 3]) {}
    fn end(&mut self, end: &End) {
        let all = &mut self.0[end.particle.number as usize];
        all.extend([end.time, end.steps as f64, end.particle.mass()]);
        all.extend(end.position.iter().chain(&end.velocity).chain(&end.spin));
    }
    fn stalled(&mut self) {}
}

/// These change only when a formula or the walk does, and then on every machine alike.
const FLIGHTS: [u64; 5] =
    [0x72cf_977c_13c2_7e2b, 0x0b99_78fc_21b5_7083, 0x5dd9_aaab_2df6_5696, 0x6f17_b171_c84e_d72b, 0xf7ce_f57b_d873_c537];

#[test]
fn flights_have_fixed_bits_on_every_instruction_set() {
    let cases = [
        ("pipe", include_str!("bits/pipe.toml")),
        ("plate", include_str!("bits/plate.toml")),
        ("box", include_str!("bits/box.toml")),
        ("brownian", include_str!("bits/brownian.toml")),
        ("small", include_str!("bits/small.toml")),
    ];
    for set in InstructionSet::available() {
        let got = cases.map(|(name, text)| {
            let case = Case::from_toml(text, Path::new(name), Library::builtin())
                .unwrap_or_else(|e| panic!("{}", e.located(name, text)));
            let mut told = Told(vec![Vec::new(); case.count() as usize]);
            case.tracker().run_on(set, &mut (0..case.count()).filter_map(|n| case.particle(n)), &mut told).unwrap();
            let values = told.0.concat();
            println!("{name} on {set:?}: {} numbers", values.len());
            fingerprint(values)
        });
        assert_eq!(got, FLIGHTS, "{set:?}: {got:#018x?}");
    }
}
