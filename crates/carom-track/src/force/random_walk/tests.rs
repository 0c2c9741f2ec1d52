//! Scales, intensities and drift by hand.

use super::*;
use crate::random::{Purpose, Stream};
use crate::vector::dot;

pub(super) const NU: f64 = 1.5e-5;

pub(super) fn near_wall(y_plus: f64) -> Local {
    let u_tau = 0.1;
    Local {
        k: 0.04,
        epsilon: 1.0,
        wall_distance: y_plus * NU / u_tau,
        wall_normal: [0.0, 1.0, 0.0],
        friction_velocity: u_tau,
        ..Local::uniform([2.0, 0.0, 0.0])
    }
}

fn isotropic() -> RandomWalk {
    RandomWalk { near_wall: NearWall::Isotropic, ..RandomWalk::default() }
}

#[test]
fn far_from_walls_the_variance_is_two_thirds_k() {
    let (seed, n) = (11, 20_000);
    let local = Local { k: 0.6, epsilon: 1.0, ..Local::uniform([1.0, 0.0, 0.0]) };
    let walk = RandomWalk { life: Life::Random, ..RandomWalk::default() };
    let (mut variance, mut life) = ([0.0; 3], 0.0);
    for particle in 0..n {
        let mut s = Stream::new(seed, particle, Purpose::Eddy, 0);
        let eddy = walk.eddy(s.normals(), s.open_uniform());
        let u = walk.fluctuation(eddy.deviates, &local, NU);
        variance = add(variance, u.map(|c| c * c / n as f64));
        life += eddy.life / n as f64;
    }
    let e = 4.0 / (n as f64).sqrt();
    assert!(variance.iter().all(|v| (v / 0.4 - 1.0).abs() < 1.42 * e), "seed {seed}: {variance:?}");
    assert!((life - 1.0).abs() < e, "seed {seed}: {life}");
    let time = walk.surroundings(|_| local, [0.0; 3], NU, 0.0).time;
    assert!((time / 0.09 - 1.0).abs() < 1e-14);
}

#[test]
fn eddies_at_a_wall_keep_kolmogorovs_scales() {
    // in wall units: T⁺ = 6/√ε⁺, L⁺ = 70/ε⁺^{1/4} where k vanishes; above, k and ε rule
    let local = Local { k: 1e-12, epsilon: 1.0 / 6.0, ..Local::uniform([1.0, 0.0, 0.0]) };
    let near = isotropic().surroundings(|_| local, [0.0; 3], 1.0, 0.0);
    assert!((near.time - 0.15 * 6.0 * 6.0f64.sqrt()).abs() < 1e-12, "{near:?}");
    assert!((near.length - 0.09f64.powf(0.75) * 70.0 * 6.0f64.powf(0.25)).abs() < 1e-12, "{near:?}");
    let far = isotropic().surroundings(|_| Local { k: 2.0, epsilon: 0.008, ..local }, [0.0; 3], 1.0, 0.0);
    assert!((far.time - 0.15 * 250.0).abs() < 1e-12, "{far:?}");
    assert!((far.length - 0.09f64.powf(0.75) * 2.0f64.powf(1.5) / 0.008).abs() < 1e-10, "{far:?}");
}

#[test]
fn an_eddy_is_crossed_or_not() {
    // x = s τ (1 − e^{−t/τ}) reaches the length at t
    let t = isotropic().crossing(0.01, 0.1, 1.0);
    assert!((0.1 * (1.0 - (-t / 0.1).exp()) - 0.01).abs() < 1e-15);
    assert_eq!(isotropic().crossing(0.01, 0.1, 0.05), f64::INFINITY);
    // what follows the fluid never crosses
    assert_eq!(isotropic().crossing(0.01, 0.0, 1e3), f64::INFINITY);
    let still = Local::uniform([0.0; 3]);
    assert_eq!(isotropic().surroundings(|_| still, [0.0; 3], NU, 0.0), Surroundings::CALM);
    assert_eq!(isotropic().fluctuation([1.0; 3], &still, NU), [0.0; 3]);
}

#[test]
fn a_wall_at_any_angle() {
    let n = [0.6, 0.8, 0.0];
    let along = [0.8, -0.6, 0.0];
    let local = Local { wall_normal: n, velocity: along, ..near_wall(0.0) };
    let u = RandomWalk::default().fluctuation([0.3, 5.0, -0.4], &local, NU);
    assert!(dot(u, n).abs() < 1e-15 && dot(u, along) * dot([0.3, 5.0, -0.4], along) > 0.0);
}

#[test]
fn divergence_by_hand() {
    // around an axis: ∇·S = [dσ_n/dr + (σ_n − σ_b)/r] e_r; here σ_n and σ_b of Wang & James with k ~ y
    let (radius, u_tau) = (0.1, 0.1);
    let fluid = |x: Vec3| {
        let r = x[1].hypot(x[2]);
        let y = radius - r;
        let n = [0.0, -x[1] / r, -x[2] / r];
        Local { k: 0.4 * y, wall_distance: y, wall_normal: n, ..near_wall(1.0) }
    };
    let walk = RandomWalk::default();
    let sigma = |r: f64| walk.near_wall.intensities(&fluid([0.0, r, 0.0]), NU);
    for y_plus in [0.3, 5.0, 60.0, 170.0] {
        let r = radius - y_plus * NU / u_tau;
        let h = 1e-4 * (radius - r);
        let [_, n, b] = sigma(r);
        let slope = (sigma(r + h)[1] - sigma(r - h)[1]) / (2.0 * h);
        let want = slope + (n - b) / r;
        let x = [0.7, 0.6 * r, -0.8 * r];
        let got = walk.surroundings(fluid, x, NU, 0.0).drift;
        let out = 0.6 * got[1] - 0.8 * got[2];
        assert!((out / want - 1.0).abs() < 1e-3, "{y_plus} {got:?} {want}");
        assert!(got[0].abs() + (0.8 * got[1] + 0.6 * got[2]).abs() < 1e-4 * want.abs(), "{y_plus} {got:?}");
    }
}

#[test]
fn a_heavy_sphere_feels_no_drift() {
    let fluid = |x: Vec3| Local { k: 1.0 + x[0], epsilon: 1.0, ..Local::uniform([0.0; 3]) };
    let drift = |life, st: f64| {
        let walk = RandomWalk { life, ..isotropic() };
        walk.surroundings(fluid, [0.0; 3], NU, st * 0.15).drift[0] / (1.0f64 / 6.0).sqrt()
    };
    for life in [Life::Constant, Life::Random] {
        assert!((drift(life, 0.0) - 1.0).abs() < 1e-3 && drift(life, f64::INFINITY) == 0.0, "{life:?}");
        assert!((1e6 * drift(life, 1e6) - 1.0).abs() < 1e-2, "{life:?} {}", drift(life, 1e6));
        let mut before = 1.0;
        for st in [1e-3, 1.99e-3, 2.01e-3, 0.1, 1.0, 10.0, 1.99e3, 2.01e3] {
            let now = drift(life, st);
            assert!(now < before && (now * (1.0 + st) - 1.0).abs() < 0.21, "{life:?} {st} {now}");
            before = now;
        }
    }
    assert!((drift(Life::Random, 1.0) - 0.5).abs() < 1e-3);
    let plain = RandomWalk { drift: false, ..isotropic() };
    assert_eq!(plain.surroundings(fluid, [0.0; 3], NU, 0.0).drift, [0.0; 3]);
}

#[test]
fn shear_stress_is_that_of_the_simulations() {
    // two draws of unit variance each: ⟨u'v'⟩ = Σ_j S_tj S_nj
    let walk = RandomWalk::langevin();
    for (y_plus, uv, tolerance) in [(5.0, -0.1088, 0.25), (14.8, -0.629, 0.2), (49.7, -0.862, 0.05)] {
        let local = near_wall(y_plus);
        let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| walk.fluctuation(e, &local, NU));
        let stress: f64 = columns.iter().map(|c| c[0] * c[1]).sum();
        let along: f64 = columns.iter().map(|c| c[0] * c[0]).sum();
        let sigma = walk.near_wall.intensities(&local, NU);
        assert!((along / (sigma[0] * sigma[0]) - 1.0).abs() < 1e-14, "the intensity stays");
        assert!((stress / (uv * 0.01) - 1.0).abs() < tolerance, "{y_plus} {stress}");
        // the other wall's normal points down: the stress turns with it
        let low = Local { wall_normal: [0.0, -1.0, 0.0], ..local };
        let turned: f64 =
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|e| walk.fluctuation(e, &low, NU)).iter().map(|c| c[0] * c[1]).sum();
        assert!((turned + stress).abs() < 1e-15);
    }
}
