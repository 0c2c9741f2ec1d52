use super::*;
use crate::testing::runge_kutta;

const D: f64 = 1e-3;
const U: f64 = 10.0;

fn jet() -> RoundJet {
    RoundJet::new(D, U).unwrap()
}

/// Points within every piece.
const INSIDE: [([f64; 3], usize); 5] = [
    ([1e-4, 2e-4, 3e-4], TURN),
    ([-2e-4, 1e-5, 0.0], TURN),
    ([1e-4, 3e-3, -2e-4], PLUG),
    ([2e-3, 1e-4, -3e-3], ALONG),
    ([3e-3, 2e-3, 0.0], OUTSIDE),
];

#[test]
fn gradients_are_the_velocitys_and_nothing_is_made_or_lost() {
    for (x, piece) in INSIDE {
        assert_eq!(jet().piece(x).index(), piece, "{x:?}");
        let local = jet().sample(x);
        for j in 0..3 {
            let (mut a, mut b) = (x, x);
            a[j] += 1e-8;
            b[j] -= 1e-8;
            let (a, b) = (jet().velocity(a), jet().velocity(b));
            for i in 0..3 {
                let fd = (a[i] - b[i]) / 2e-8;
                assert!((local.gradient[i][j] - fd).abs() < 1e-5 * 2e4, "{x:?} {i}{j} {fd} {:?}", local.gradient);
            }
        }
        let trace: f64 = (0..3).map(|i| local.gradient[i][i]).sum();
        assert!(trace.abs() < 1e-12 * 2e4);
    }
    // a = 1.75 U/D at the stagnation point
    assert!((jet().sample([0.0; 3]).gradient[0][0] - 1.75 * U / D).abs() < 1e-9);
}

#[test]
fn nowhere_faster_than_the_jet_and_all_of_it_flows_out() {
    let jet = jet();
    for i in 0..400 {
        for j in 0..400 {
            let x = [2.5e-6 * f64::from(i) * (1.0 + f64::from(i) / 20.0), 2.5e-6 * f64::from(j), 0.0];
            let u = jet.velocity(x);
            assert!(u[0].hypot(u[1]) <= U * (1.0 + 1e-12), "{x:?} {u:?}");
        }
    }
    for r in [0.6e-3, 1e-3, 5e-3, 17e-3, 50e-3] {
        let n = 200_000;
        let h = jet.thickness() / f64::from(n);
        let flux: f64 = (0..n).map(|i| jet.velocity([r, h * (f64::from(i) + 0.5), 0.0])[0] * h).sum();
        let flux = flux * 2.0 * std::f64::consts::PI * r;
        let jets = 0.25 * std::f64::consts::PI * D * D * U;
        assert!((flux / jets - 1.0).abs() < 1e-4, "{r}: {}", flux / jets);
    }
}

#[test]
fn a_path_leaves_a_piece_where_the_piece_ends() {
    let jet = jet();
    let mut seen = [false; 4];
    for k in 0..4000 {
        let draw =
            |m: u32| f64::from((k * 2_654_435_761u64 % 4_294_967_291 * u64::from(m) % 1_000_003) as u32) / 1_000_003.0;
        let start = [2e-3 * draw(17) - 1e-3, 1.2e-3 * draw(29), 2e-3 * draw(41) - 1e-3];
        let change = [2e-3 * draw(53) - 1e-3, 1e-3 * draw(67) - 5e-4, 2e-3 * draw(79) - 1e-3];
        let path = Path::straight(start, change);
        let piece = jet.piece(start);
        seen[piece.index()] = true;
        let exit = jet.exit(piece, &path);
        let end = exit.map_or(1.0, |e| e.theta);
        for i in 0..=2000 {
            let theta = f64::from(i) / 2000.0;
            if theta < end - 1e-9 {
                assert_eq!(jet.piece(path.at(theta)), piece, "{k} {theta} {end}");
            }
        }
        if let Some(exit) = exit.filter(|e| e.theta < 1.0 - 1e-9) {
            assert_eq!(jet.piece(path.at(exit.theta + 1e-9)), exit.into, "{k} {exit:?}");
        }
    }
    assert_eq!(seen, [true; 4]);
}

/// Whether a sphere of τ U/D = `stokes`/2 and a radius of D/1000 that starts with the jet at r = `start`·D reaches the plate:
/// Stokes drag, classical Runge–Kutta.
fn lands(stokes: f64, start: f64) -> bool {
    let jet = RoundJet::new(1.0, 1.0).unwrap();
    let tau = 0.5 * stokes;
    let rate = |s: [f64; 4]| {
        let u = jet.velocity([s[0], s[1], 0.0]);
        [s[2], s[3], (u[0] - s[2]) / tau, (u[1] - s[3]) / tau]
    };
    let h = 0.005;
    let mut s = [start, 1.0, 0.0, -1.0];
    for _ in 0..8000 {
        s = runge_kutta(s, h, rate);
        if s[1] <= 1e-3 {
            return true;
        }
        if s[0] > 6.0 {
            return false;
        }
    }
    false
}

#[test]
fn half_of_the_spheres_land_at_the_measured_cut_point() {
    let landed =
        |root: f64| (0..60).filter(|i| lands(root * root, 0.5 * ((f64::from(*i) + 0.5) / 60.0).sqrt())).count();
    assert!(landed(0.30) <= 3, "{}", landed(0.30));
    let (mut low, mut high) = (0.3, 0.8);
    for _ in 0..10 {
        let middle = 0.5 * (low + high);
        if landed(middle) < 30 { low = middle } else { high = middle }
    }
    // Hinds 1999, table 5.4: 0.49
    assert!((low - 0.49).abs() < 0.01, "{low}");
    assert!(landed(0.75) == 60, "{}", landed(0.75));
}
