//! The bits of outcomes, law by law: a change of arithmetic, of processor or of instruction set must not move one.

mod common;

use carom::batch::{Incidence, InstructionSet, Rebound};
use carom::{Impact, Outcome, WallLaw};

/// FNV-1a over 64-bit words.
struct Hash(u64);

impl Hash {
    fn add(&mut self, value: f64) {
        // a NaN's sign and payload are the processor's own affair, and zeros are equal
        let word = if value.is_nan() { 1 } else { (value + 0.0).to_bits() };
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    fn outcome(&mut self, out: &Outcome) {
        for value in out.velocity.iter().chain(&out.spin) {
            self.add(*value);
        }
        for value in [out.restitution, out.impulse_ratio, out.tangential_restitution] {
            self.add(value);
        }
        for (_, share) in out.energy.named() {
            self.add(share);
        }
        self.add(f64::from(u8::from(out.contact.name() == "sliding")));
    }
}

/// Impacts over many decades, in a fixed order: all directions, spins, sizes, moving walls, other densities.
fn impacts(n: usize) -> impl Iterator<Item = Impact> {
    let at = |i: usize, k: usize| ((i * 7_919 + k * 104_729) % 65_521) as f64 / 65_521.0;
    (0..n).map(move |i| {
        let normal = [at(i, 1) - 0.5, at(i, 2) - 0.5, at(i, 3) + 0.1];
        let decade = [1e-3, 1e-2, 0.1, 1.0, 10.0, 50.0][i % 6];
        let velocity = [decade * (at(i, 4) - 0.5), decade * (at(i, 5) - 0.5), -decade * (0.2 + at(i, 6))];
        let diameter = [3e-7, 2e-6, 1e-5, 7e-5, 5e-4][i % 5] * (0.5 + at(i, 7));
        let mut impact = Impact::new(diameter, velocity, normal);
        impact.spin = [0, 1, 2].map(|k| if i % 3 == 0 { 0.0 } else { 1e4 * decade * (at(i, 8 + k) - 0.5) });
        if i % 4 == 1 {
            impact.wall_velocity = [0.3 * decade * at(i, 11), 0.2 * decade, 0.0];
        }
        if i % 7 == 3 {
            impact.density = Some(2000.0 + 1000.0 * at(i, 12));
        }
        impact.draws = [13, 14, 15, 16].map(|k| at(i, k));
        impact
    })
}

fn hash_of<'a>(laws: impl Iterator<Item = &'a WallLaw>, n: usize) -> u64 {
    let mut hash = Hash(0xcbf2_9ce4_8422_2325);
    for law in laws {
        for impact in impacts(n) {
            if let Ok(out) = law.impact(&impact) {
                hash.outcome(&out);
            }
        }
    }
    hash.0
}

/// One number for each normal law, over all tangential laws.
const SMOOTH: [u64; 22] = [
    0x8e2cf51aeb48254b,
    0x75c0e49dc45a82a6,
    0x06f3d22d5eebb085,
    0xd558e8f42732a76f,
    0x0f48e5c7b872d0d7,
    0x11207ebfd9e19cb0,
    0x0abb269e3e1de9ba,
    0xf865cd2130281d4c,
    0x4cdfb02d5839d897,
    0x0e6dc727fb2189d1,
    0xb99505e3987cc691,
    0x2cdc7a105c5c0aee,
    0x515d786431d6c2e4,
    0x2d6bc77817c31d04,
    0x443fc2cf0ee8ba0d,
    0x3745a6b642f4006f,
    0x9e22406ec23d3fc7,
    0xe81b56ae96625af0,
    0xf2e8654a6fb0cff8,
    0xe7ecf191189f0f4e,
    0xb598c60a6d712ded,
    0x6f8f11633152acb9,
];

/// The same on a wall that scatters, a few laws.
const ROUGH: [u64; 3] = [0xcc07220814c4ba37, 0x6ff5e33e1f9e84cf, 0x84b5b2f8b6b72f8a];

#[test]
fn outcomes_have_their_bits() {
    let laws = common::all_laws();
    let each = common::tangential_laws().len();
    let got: Vec<u64> = laws.chunks(each).map(|group| hash_of(group.iter().map(|(_, law)| law), 300)).collect();
    assert_eq!(got, SMOOTH, "{got:#x?}");
}

#[test]
fn outcomes_on_a_wall_that_scatters_have_their_bits() {
    let steel = "sphere = \"stainless-steel\"\nsurface = \"silicon\"\nroughness_angle = \"5 deg\"\nfriction = 0.2\n";
    let laws = [
        "normal = \"ea\"\nadhesion_damping = 1.3\nhertz_damping = 0.007\n",
        "normal = \"constant\"\nrestitution = 0.8\n",
        "normal = \"eap\"\nplastic_constant = \"155 MPa\"\ntangential = \"micro-slip\"\n",
    ];
    let got: Vec<u64> = laws.iter().map(|law| hash_of([common::law(&format!("{steel}{law}"))].iter(), 60)).collect();
    assert_eq!(got, ROUGH, "{got:#x?}");
}

/// Two chunks of rows; some in the first leave the range where a fused multiply-add is exact without branches.
fn batch_hash(set: InstructionSet, laws: &[(String, WallLaw)]) -> u64 {
    const ROWS: usize = 131;
    let at = |i: usize, k: usize| ((i * 7_919 + k * 104_729) % 65_521) as f64 / 65_521.0;
    let column = |f: &dyn Fn(usize) -> f64| (0..ROWS).map(f).collect::<Vec<f64>>();
    let incidence = Incidence {
        normal: &column(&|i| if i == 7 { 1e-149 } else { [1e-3, 0.1, 3.0, 80.0][i % 4] * (0.1 + at(i, 1)) }),
        tangential: &column(&|i| if i % 17 == 0 { 0.0 } else { 20.0 * (at(i, 2) - 0.3) }),
        spin: &column(&|i| {
            if i % 5 == 0 { 0.0 } else { [4e5, if i < 64 { 1e-300 } else { 1.0 }, 10.0][i % 3] * (at(i, 3) - 0.5) }
        }),
        diameter: &column(&|i| [5e-7, 1e-5, 6e-4][i % 3] * (0.1 + at(i, 4))),
    };
    let mut hash = Hash(0xcbf2_9ce4_8422_2325);
    // every third combination has every normal and every tangential law
    for (_, law) in laws.iter().step_by(3) {
        let mut columns = [const { [0.0; ROWS] }; 5];
        let [n, t, w, e, ratio] = &mut columns;
        let mut rebound = Rebound { restitution: Some(e), impulse_ratio: Some(ratio), ..Rebound::new(n, t, w) };
        law.impact_batch_on(set, &incidence, &mut rebound).expect("every row approaches");
        columns.as_flattened().iter().for_each(|v| hash.add(*v));
    }
    hash.0
}

#[test]
fn batches_have_their_bits_on_every_instruction_set() {
    for set in InstructionSet::available() {
        println!("{set:?}");
        let (first, dahneke) = common::all_laws().split_at(200);
        assert_eq!(batch_hash(set, first), 0x3029_3494_6bc6_34e1, "{set:?}");
        assert_eq!(batch_hash(set, dahneke), 0x4c28_ff77_b403_5afd, "{set:?}");
    }
}
