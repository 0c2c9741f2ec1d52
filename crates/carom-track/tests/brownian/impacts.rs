//! Speeds of impact: Maxwell's flux at elastic walls, what a simulation with small steps gives at an absorbing one.

use super::*;
use carom_track::flow::Flow;
use carom_track::random::{Purpose, Stream};

/// Speeds at elastic walls within windows far apart: flux-weighted, and independent but for bounces within one window.
fn elastic_speeds(spheres: u64, windows: u32, seed: u64) -> Vec<f64> {
    let d = air();
    let s = scales(&d, 6e-8);
    let wide = 6.0 * s.free;
    let walls = vec![plane("low", [0.0; 3], [0.0, 1.0, 0.0]), plane("high", [0.0, wide, 0.0], [0.0, -1.0, 0.0])];
    let domain = AnyDomain::new(Flow::Still, walls);
    let start = |i| Stream::new(seed, i, Purpose::Injection, 0).uniform() * wide;
    let starts = (0..spheres).map(|i| sphere(i, 6e-8, [0.0, start(i), 0.0]));
    let until = (15.0 * f64::from(windows) + 0.4) * s.tau;
    let log = track(&domain, &d, &[elastic(), elastic()], (until, seed), starts);
    let in_window = |t: f64| t > 10.0 && t % 15.0 < 0.4;
    log.impacts.iter().filter(|i| in_window(i.time / s.tau)).map(|i| i.normal_speed_in / s.thermal).collect()
}

fn is_maxwells(spheres: u64, windows: u32, seed: u64) {
    let mut speeds = elastic_speeds(spheres, windows, seed);
    let n = speeds.len() as f64;
    let moment = |k: i32| speeds.iter().map(|v| v.powi(k)).sum::<f64>() / n;
    let (first, second) = (moment(1), moment(2));
    let off = kolmogorov(&mut speeds, |v| 1.0 - (-0.5 * v * v).exp());
    println!("seed {seed}: {n} impacts, mean {first:.4} (1.2533), mean square {second:.4} (2), Kolmogorov {off:.2}");
    assert!(off < 1.95);
    // standard deviations of v and of v²
    assert!((first - 1.2533).abs() < 4.0 * 0.655 / n.sqrt() && (second - 2.0).abs() < 4.0 * 2.0 / n.sqrt());
}

#[test]
fn elastic_walls_are_hit_with_maxwells_flux() {
    is_maxwells(250, 4, 12);
}

#[test]
#[ignore = "long: tens of thousands of impacts"]
fn elastic_walls_are_hit_with_maxwells_flux_to_one_per_cent() {
    is_maxwells(4_000, 20, 22);
}

/// From where, and what throws back those that go the wrong way, in stopping distances.
const FROM: f64 = 10.0;
const BACK: f64 = 20.0;

/// Speeds at which an absorbing wall is hit.
fn absorbed_speeds(spheres: u64, seed: u64) -> Vec<f64> {
    let d = air();
    let s = scales(&d, 6e-8);
    let high = [0.0, BACK * s.free, 0.0];
    let walls = vec![plane("low", [0.0; 3], [0.0, 1.0, 0.0]), plane("high", high, [0.0, -1.0, 0.0])];
    let domain = AnyDomain::new(Flow::Still, walls);
    let starts = (0..spheres).map(|i| sphere(i, 6e-8, [0.0, FROM * s.free, 0.0]));
    let log = track(&domain, &d, &[Behavior::Trap, elastic()], (f64::INFINITY, seed), starts);
    log.impacts.iter().filter(|i| i.wall == 0).map(|i| i.normal_speed_in / s.thermal).collect()
}

/// Likewise by brute force: velocity and place in steps of `h` relaxation times, the chord's crossing. An error of order √h.
fn brute_force(spheres: u64, seed: u64, h: f64) -> Vec<f64> {
    let (e, kick) = ((-h).exp(), (-(-2.0 * h).exp_m1()).sqrt());
    let one = |i: u64| {
        let (mut x, mut v, mut event) = (FROM, 0.0, 0);
        let mut draws = Stream::new(seed, i, Purpose::Resampling, event);
        let mut drawn = 0u32;
        loop {
            let last = v;
            v = e * v + kick * draws.normal();
            x += 0.5 * h * (v + last);
            if x <= 0.0 {
                return -0.5 * (v + last);
            }
            if x >= BACK {
                (x, v) = (2.0 * BACK - x, -v);
            }
            drawn += 1;
            if drawn == 1 << 20 {
                (event, drawn) = (event + 1, 0);
                draws = Stream::new(seed, i, Purpose::Resampling, event);
            }
        }
    };
    (0..spheres).map(one).collect()
}

fn moments(speeds: &[f64]) -> (f64, f64) {
    let n = speeds.len() as f64;
    (speeds.iter().sum::<f64>() / n, mean_square(speeds.iter().copied()))
}

#[test]
fn an_absorbing_wall_is_hit_faster() {
    // 1.45 and 2.53 by brute force (below); standard deviations of the speed 0.65, of its square 2.3
    let speeds = absorbed_speeds(300, 13);
    let ((mean, square), n) = (moments(&speeds), speeds.len() as f64);
    println!("seed 13: {n} impacts, mean {mean:.3}, mean square {square:.3}");
    assert!(n == 300.0 && (mean - 1.45).abs() < 4.0 * 0.65 / n.sqrt() && (square - 2.53).abs() < 4.0 * 2.3 / n.sqrt());
}

#[test]
#[ignore = "long: thousands of impacts by brute force"]
fn speeds_at_an_absorbing_wall_are_those_of_small_steps() {
    let mut speeds = absorbed_speeds(20_000, 23);
    let mut small = brute_force(10_000, 24, 2e-3);
    for (name, all) in [("carom", &speeds), ("small steps", &small)] {
        let (mean, square) = moments(all);
        println!("seeds 23, 24: {name}: mean {mean:.4}, mean square {square:.4}");
    }
    let (fine, coarse) = (moments(&speeds), moments(&small));
    assert!((fine.0 - coarse.0).abs() < 4.0 * 0.65 * (1.5e-4f64).sqrt());
    assert!((fine.1 - coarse.1).abs() < 4.0 * 2.3 * (1.5e-4f64).sqrt());
    // two samples: the largest difference of their distributions over √(1/n + 1/m)
    speeds.sort_by(f64::total_cmp);
    small.sort_by(f64::total_cmp);
    let below = |all: &[f64], x: f64| all.partition_point(|v| *v <= x) as f64 / all.len() as f64;
    let off = small.iter().map(|x| (below(&speeds, *x) - below(&small, *x)).abs()).fold(0.0, f64::max);
    let off = off / (1.0 / speeds.len() as f64 + 1.0 / small.len() as f64).sqrt();
    println!("Kolmogorov {off:.2}");
    assert!(off < 1.95);
}
