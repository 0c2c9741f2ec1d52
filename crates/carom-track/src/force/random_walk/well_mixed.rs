//! Fluid elements that start evenly spread stay so, and a sphere sees of the drift what it follows.

use super::tests::NU;
use super::*;
use crate::flow::{Fluid, Pipe, Profile};
use crate::random::{Purpose, Stream};
use crate::vector::dot;
use std::f64::consts::PI;

const BINS: usize = 20;

/// 99.9 % of even spreads over the bins have a smaller χ² (19 degrees of freedom).
const CHI_SQUARE: f64 = 43.8;

const LIVES: [Life; 2] = [Life::Constant, Life::Random];

/// χ² of an even spread of places in [0, 1) over the bins.
fn chi_square(places: &[f64]) -> f64 {
    let mut found = [0.0; BINS];
    for y in places {
        found[((y * BINS as f64) as usize).min(BINS - 1)] += 1.0;
    }
    let want = places.len() as f64 / BINS as f64;
    found.iter().map(|n| (n - want) * (n - want) / want).sum()
}

/// The draws of one particle's eddies.
fn draws(seed: u64, particle: u64) -> impl FnMut() -> (bool, Vec3, f64) {
    let mut events = 0;
    move || {
        events += 1;
        let mut s = Stream::new(seed, particle, Purpose::Eddy, events);
        (events == 1, s.normals(), s.open_uniform())
    }
}

/// Where a fluid element is after a time: dx/dt = S ζ, by classical Runge–Kutta.
fn follow(
    walk: &RandomWalk,
    fluid: impl Fn(Vec3) -> Local,
    nu: f64,
    start: Vec3,
    until: f64,
    mut draw: impl FnMut() -> (bool, Vec3, f64),
) -> Vec3 {
    let around = |x| walk.surroundings(&fluid, x, nu, 0.0);
    let mut x = start;
    let mut eddy = walk.next_eddy(&Eddy::NONE, 0.0, &mut draw);
    let mut here = around(x);
    let mut time = 0.0;
    while time < until {
        // short steps for the plain walk too, which keeps the time scale of another place
        let pace = if walk.drift { here.time } else { around(x).time };
        let h = eddy.longest_step(&here).min(0.1 * pace).min(until - time);
        let middle = eddy.middle(&here, h).deviates;
        let u = |k: Vec3, h: f64| walk.fluctuation(middle, &fluid(add(x, scale(k, h))), nu);
        let k1 = u([0.0; 3], 0.0);
        let k2 = u(k1, 0.5 * h);
        let k3 = u(k2, 0.5 * h);
        let k4 = u(k3, h);
        x = add(x, scale(add(add(k1, k4), scale(add(k2, k3), 2.0)), h / 6.0));
        let there = if walk.drift { around(x) } else { here };
        eddy = eddy.after(&here, &there, h);
        here = there;
        time += h;
        if eddy.is_over() {
            eddy = walk.next_eddy(&eddy, eddy.overdue(), &mut draw);
            here = around(x);
        }
    }
    x
}

/// Turbulence that varies along y with period 1 m: σ by a factor of 5, T_L by 5.
fn wavy(x: Vec3) -> Local {
    let wave = 2.0 * PI * x[1];
    let sigma = 1.0 + 0.66 * wave.cos();
    let k = 1.5 * sigma * sigma;
    let time = 0.1 * (1.0 + 0.66 * (wave + 1.0).sin());
    Local { k, epsilon: 0.15 * k / time, ..Local::uniform([0.0; 3]) }
}

/// χ² of fluid elements in such turbulence after a time (s).
fn spread_in_waves(walk: &RandomWalk, seed: u64, count: u64, until: f64) -> f64 {
    let end = |i: u64| {
        let start = [0.0, (i as f64 + 0.5) / count as f64, 0.0];
        follow(walk, wavy, NU, start, until, draws(seed, i))[1].rem_euclid(1.0)
    };
    chi_square(&(0..count).map(end).collect::<Vec<_>>())
}

#[test]
fn fluid_elements_stay_evenly_spread_where_the_turbulence_varies() {
    let (seed, count) = (1, 8_000);
    for life in LIVES {
        let walk = RandomWalk { near_wall: NearWall::Isotropic, life, ..RandomWalk::default() };
        // within an eddy's life, after a few, and after many
        for until in [0.1, 0.4, 1.5] {
            let found = spread_in_waves(&walk, seed, count, until);
            assert!(found < CHI_SQUARE, "seed {seed}: {life:?} after {until} s: {found}");
        }
        let plain = spread_in_waves(&RandomWalk { drift: false, ..walk }, seed, count, 1.5);
        assert!(plain > 10.0 * CHI_SQUARE, "seed {seed}: {life:?} without drift: {plain}");
    }
}

#[test]
fn a_langevin_walk_keeps_fluid_elements_evenly_spread_where_the_turbulence_varies() {
    let (seed, count) = (1, 4_000);
    let walk = RandomWalk { near_wall: NearWall::Isotropic, ..RandomWalk::langevin() };
    for until in [0.1, 1.0] {
        let found = spread_in_waves(&walk, seed, count, until);
        assert!(found < CHI_SQUARE, "seed {seed}: after {until} s: {found}");
    }
    let plain = spread_in_waves(&RandomWalk { drift: false, ..walk }, seed, count, 1.0);
    assert!(plain > 10.0 * CHI_SQUARE, "seed {seed}: without drift: {plain}");
}

/// χ² of fluid elements in a pipe of δ⁺ = 290 after 300 wall units of time; the outermost of the rings of equal area is 7 wall
/// units thick.
fn spread_in_a_pipe(walk: &RandomWalk, seed: u64, count: u64) -> f64 {
    let (radius, air) = (6.35e-3, Fluid::default());
    let nu = air.kinematic_viscosity();
    let pipe = Pipe::new(Profile::Turbulent, [0.0; 3], [1.0, 0.0, 0.0], radius, 11.0, &air).unwrap();
    let until = 300.0 * nu / pipe.friction_velocity().powi(2);
    let end = |i: u64| {
        let r = radius * ((i as f64 + 0.5) / count as f64).sqrt();
        let angle = 2.0 * PI * 0.618 * i as f64;
        let start = [0.0, r * angle.cos(), r * angle.sin()];
        let x = follow(walk, |x| pipe.sample(x), nu, start, until, draws(seed, i));
        (x[1] * x[1] + x[2] * x[2]) / (radius * radius)
    };
    let ends: Vec<f64> = (0..count).map(end).collect();
    assert!(ends.iter().all(|s| *s < 1.0), "none through the wall");
    chi_square(&ends)
}

#[test]
fn a_langevin_walk_keeps_fluid_elements_evenly_spread_in_a_pipe() {
    let (seed, count) = (1, 500);
    let found = spread_in_a_pipe(&RandomWalk::langevin(), seed, count);
    assert!(found < CHI_SQUARE, "seed {seed}: {found}");
    let plain = spread_in_a_pipe(&RandomWalk { drift: false, ..RandomWalk::langevin() }, seed, count);
    assert!(plain > 3.0 * CHI_SQUARE, "seed {seed}: without drift: {plain}");
}

#[test]
fn fluid_elements_stay_evenly_spread_in_a_pipe() {
    let (seed, count) = (1, 800);
    let spread = |walk: &RandomWalk| spread_in_a_pipe(walk, seed, count);
    for near_wall in [NearWall::Isotropic, NearWall::WangJames, NearWall::KallioReeks] {
        for life in LIVES {
            let walk = RandomWalk { near_wall, life, ..RandomWalk::default() };
            let found = spread(&walk);
            assert!(found < CHI_SQUARE, "seed {seed}: {near_wall:?} {life:?}: {found}");
        }
        let plain = spread(&RandomWalk { near_wall, drift: false, ..RandomWalk::default() });
        assert!(plain > 3.0 * CHI_SQUARE, "seed {seed}: {near_wall:?} without drift: {plain}");
    }
}

#[test]
fn a_sphere_correlates_with_the_fluid_as_its_drift_says() {
    // even turbulence with T_L = 1 s: dv/dt = (u − v)/τ in closed form while an eddy lasts
    let (seed, eddies) = (1, 40_000);
    for life in LIVES {
        let walk = RandomWalk { life, ..RandomWalk::default() };
        for stokes in [0.1, 1.0, 10.0f64] {
            let mut draw = draws(seed, 0);
            let (mut v, mut time) = ([0.0; 3], 0.0);
            let (mut uv, mut uu) = (0.0, 0.0);
            for _ in 0..eddies {
                let eddy = walk.next_eddy(&Eddy::NONE, 0.0, &mut draw);
                let u = eddy.deviates;
                let h = eddy.life - eddy.age;
                let left = (-h / stokes).exp();
                // ∫ v dt = u h + (v − u) τ (1 − e^{−h/τ})
                let lag = sub(v, u);
                uv += dot(u, add(scale(u, h), scale(lag, stokes * (1.0 - left))));
                uu += dot(u, u) * h;
                v = add(u, scale(lag, left));
                time += h;
            }
            let (got, want) = (uv / uu, life.response(stokes));
            // three components: 1.2e5 samples of a product with a standard deviation near √want
            let error = 4.0 * (2.0 * want / (3.0 * f64::from(eddies))).sqrt();
            assert!((got - want).abs() < error, "seed {seed}: {life:?} {stokes}: {got} {want} ± {error}, {time} s");
        }
    }
}
