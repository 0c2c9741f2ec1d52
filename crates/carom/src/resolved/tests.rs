use super::*;
use crate::math::BEST;

fn steel_on_silicon(damping: Damping, mode: AdhesionMode) -> Resolved {
    // K and w exactly as the materials give them: w = 2√(1.62 · 1.42) = 3.033..., the reference values use 3.03
    let e_star = 1.0 / ((1.0 - 0.27f64 * 0.27) / 190e9 + (1.0 - 0.28f64 * 0.28) / 166e9);
    Resolved::new(Work::new(4.0 / 3.0 * e_star, 3.03, 0.15, 8000.0), damping, mode)
}

const DAMPED: Damping = Damping { adhesion: 1.3, hertz: 0.007 };
const UNDAMPED: Damping = Damping { adhesion: 0.0, hertz: 0.0 };

#[test]
fn reference_values() {
    let size = Size::flat(35e-6);
    let separation = steel_on_silicon(DAMPED, AdhesionMode::SeparationOnly);
    let reversible = steel_on_silicon(DAMPED, AdhesionMode::Reversible);
    for (v, one, two) in [
        (0.3, 0.904716539, 0.953725746),
        (1.0, 0.941839262, 0.942379685),
        (5.0, 0.934147917, 0.908885531),
        (20.0, 0.867601872, 0.834607255),
    ] {
        let (a, b) = (separation.restitution(v, &size), reversible.restitution(v, &size));
        assert!((a - one).abs() < 1e-8 && (b - two).abs() < 1e-8, "{v}: {a} {b}");
    }
}

#[test]
fn undamped_separation_only_is_the_algebraic_form_and_the_speed_agrees_with_the_energy() {
    let law = steel_on_silicon(UNDAMPED, AdhesionMode::SeparationOnly);
    let size = Size::flat(35e-6);
    for v in [0.02578756, 0.026, 0.03, 0.1, 0.3, 1.0, 5.0, 20.0, 1000.0] {
        let psi = law.work.fraction(v, &size);
        let e = (1.0 - psi).sqrt();
        assert!((law.restitution(v, &size) - e).abs() < 2e-10 / e, "{v}");
        let motion = law.contact(BEST, v, &size).solve(BEST, f64::INFINITY, &mut |_, _| ());
        assert!((motion.end.u.powi(2) - e * e).abs() < 1e-9, "{v}: {} {e}", motion.end.u);
    }
    assert_eq!(law.restitution(0.0257875, &size), 0.0);
}

/// The speed at the end and the energy the losses leave agree within twice the integrator's tolerance.
#[test]
fn energy_balances_with_damping() {
    for mode in [AdhesionMode::SeparationOnly, AdhesionMode::Reversible] {
        for (ca, ch) in [(1.3, 0.007), (0.0, 0.1), (10.0, 0.0)] {
            let law = steel_on_silicon(Damping { adhesion: ca, hertz: ch }, mode);
            for v in [0.1, 1.0, 10.0] {
                let size = Size::flat(35e-6);
                let motion = law.contact(BEST, v, &size).solve(BEST, f64::INFINITY, &mut |_, _| ());
                let e = law.restitution(v, &size);
                assert!(motion.captured == (e == 0.0));
                if !motion.captured {
                    assert!((motion.end.u + e).abs() < 4e-9, "{mode:?} {ca} {ch} {v}: {} {e}", motion.end.u);
                }
            }
        }
    }
}

#[test]
fn undamped_capture_is_at_five_thirds_of_the_papers_length() {
    // X there is x over 2πf₀C_R/K, here s²/A
    let law = steel_on_silicon(UNDAMPED, AdhesionMode::SeparationOnly);
    let size = Size::flat(35e-6);
    let v = law.window(&size).expect("rebounds").capture_velocity;
    assert!((v / 0.0257875508304544 - 1.0).abs() < 1e-9, "{v}");
    let contact = law.contact(BEST, v, &size);
    let deepest = contact.solve(BEST, f64::INFINITY, &mut |_, _| ()).deepest;
    assert!((deepest * deepest / contact.adhesion - 5.0 / 3.0).abs() < 1e-8);
}

#[test]
fn hertz_impulse_exceeds_the_net_one_near_capture() {
    let law = steel_on_silicon(UNDAMPED, AdhesionMode::SeparationOnly);
    for (v, ratio) in [(0.05, 1.39), (0.1, 1.18), (0.3, 1.064), (1.0, 1.023), (5.0, 1.006)] {
        let share = law.respond(v, &Size::flat(35e-6)).friction_share;
        assert!((share - ratio).abs() < 6e-3, "{v}: {share}");
    }
}

#[test]
fn small_damping_limits() {
    // first-order losses: (4/3)C_H v and 0.7567 Ψ_A C_A v, for small Ψ_A
    let no_adhesion =
        Resolved::new(Work::default(), Damping { adhesion: 0.0, hertz: 1e-6 }, AdhesionMode::SeparationOnly);
    let loss = 1.0 - no_adhesion.restitution(1.0, &Size::flat(1e-5)).powi(2);
    assert!((loss / 1e-6 - 4.0 / 3.0).abs() < 1e-4, "{loss}");
    let law = Resolved::new(
        Work::new(127.8e9, 1e-6, 1.0, 8000.0),
        Damping { adhesion: 1.0, hertz: 0.0 },
        AdhesionMode::SeparationOnly,
    );
    let response = law.respond(1.0, &Size::flat(35e-6));
    let psi = law.work.fraction(1.0, &Size::flat(35e-6));
    assert!(
        (response.losses.adhesion_damping / psi - 0.7567).abs() < 1e-3,
        "{}",
        response.losses.adhesion_damping / psi
    );
}

#[test]
fn reversible_and_undamped_never_loses_or_captures() {
    let law = steel_on_silicon(UNDAMPED, AdhesionMode::Reversible);
    for v in [1e-6, 1e-3, 0.1, 10.0] {
        assert_eq!(law.restitution(v, &Size::flat(35e-6)), 1.0, "{v}");
    }
    assert_eq!(law.window(&Size::flat(35e-6)).map(|w| w.capture_velocity), Some(0.0));
}

#[test]
fn a_pure_hertz_history_has_the_known_duration_and_depth() {
    // t_c = 2.9432 x_max/v, x_max = (5mv²/4√rK)^{2/5}
    let law = Resolved::new(Work::default(), UNDAMPED, AdhesionMode::SeparationOnly);
    let (size, scales) = (Size::flat(35e-6), Scales { stiffness: 127.8e9, density: 8000.0 });
    let moments = law.history(1.0, &size, &scales, 0.5, 0.2, 64);
    let m = 4.0 / 3.0 * core::f64::consts::PI * 8000.0 * 35e-6f64.powi(3);
    let deepest = (5.0 * m / (4.0 * 35e-6f64.sqrt() * 127.8e9)).powf(0.4);
    let got = moments.iter().map(|p| p.overlap).fold(0.0, f64::max);
    assert!((got / deepest - 1.0).abs() < 1e-9);
    let last = moments.last().expect("moments");
    assert!((last.time * 1.0 / deepest - 2.943_275_2).abs() < 1e-6, "{}", last.time / deepest);
    assert!((last.speed + 1.0).abs() < 1e-9 && last.overlap < 1e-18);
    // slip 0.5 m/s < 3.5 f (1 + e) v = 1.4 m/s: it ends rolling
    assert_eq!(last.slip, 0.0);
    assert!(moments.windows(2).all(|p| p[1].time > p[0].time && p[1].slip <= p[0].slip));
}

#[test]
fn the_pair_of_order_eight_meets_its_conditions() {
    use super::coefficients::{A, B, E3, E5, STAGES};
    let nodes: Vec<f64> = A.iter().map(|row| row.iter().sum()).collect();
    // quadrature conditions Σ bᵢ cᵢ^k = 1/(k + 1) up to order 8, and Σ bᵢ aᵢⱼ cⱼ^k = 1/((k + 1)(k + 2)) up to order 7 within
    for k in 0..8 {
        let sum: f64 = (0..STAGES).map(|i| B[i] * nodes[i].powi(k)).sum();
        assert!((sum - 1.0 / f64::from(k + 1)).abs() < 1e-14, "{k}: {sum}");
    }
    for k in 0..7 {
        let inner = |i: usize| (0..STAGES).map(|j| A[i][j] * nodes[j].powi(k)).sum::<f64>();
        let sum: f64 = (0..STAGES).map(|i| B[i] * inner(i)).sum();
        assert!((sum - 1.0 / f64::from((k + 1) * (k + 2))).abs() < 1e-14, "{k}: {sum}");
    }
    for e in [E3, E5] {
        assert!(e.iter().sum::<f64>().abs() < 1e-14);
    }
}

/// An independent integration of Eq. 4 in its own variables: fixed fourth-order steps in time, fine enough.
#[test]
fn a_plain_integration_in_time_agrees() {
    let (ca, ch) = (1.3, 0.007);
    let e_star = 1.0 / ((1.0 - 0.27f64 * 0.27) / 190e9 + (1.0 - 0.28f64 * 0.28) / 166e9);
    let (k, w, c_r, rho, r) = (4.0 / 3.0 * e_star, 3.03, 0.15, 8000.0, 35e-6f64);
    let m = 4.0 / 3.0 * core::f64::consts::PI * rho * r.powi(3);
    let f0 = (9.0 * k * r * w * w / (2.0 * core::f64::consts::PI)).cbrt();
    let force = |x: f64, v: f64| {
        let x = x.max(0.0);
        let adhesion =
            if v < 0.0 { 2.0 * core::f64::consts::PI * (r * x).sqrt() * f0 * c_r * (1.0 - ca * v) } else { 0.0 };
        (-r.sqrt() * k * x.powf(1.5) * (1.0 + ch * v) + adhesion) / m
    };
    let (mut x, mut v, dt) = (0.0f64, 1.0f64, 2e-13);
    for _ in 0..4_000_000 {
        let (k1x, k1v) = (v, force(x, v));
        let (k2x, k2v) = (v + 0.5 * dt * k1v, force(x + 0.5 * dt * k1x, v + 0.5 * dt * k1v));
        let (k3x, k3v) = (v + 0.5 * dt * k2v, force(x + 0.5 * dt * k2x, v + 0.5 * dt * k2v));
        let (k4x, k4v) = (v + dt * k3v, force(x + dt * k3x, v + dt * k3v));
        x += dt / 6.0 * (k1x + 2.0 * k2x + 2.0 * k3x + k4x);
        v += dt / 6.0 * (k1v + 2.0 * k2v + 2.0 * k3v + k4v);
        if x <= 0.0 {
            break;
        }
    }
    let e = steel_on_silicon(DAMPED, AdhesionMode::SeparationOnly).restitution(1.0, &Size::flat(r));
    assert!(x <= 0.0 && (e + v).abs() < 1e-6, "{e} {v}");
}

/// Adhesion a million times the impact's own scale: the first steps overflow and must be refused, not taken.
#[test]
fn adhesion_beyond_all_scale_gives_numbers() {
    for mode in [AdhesionMode::SeparationOnly, AdhesionMode::Reversible] {
        let law = steel_on_silicon(DAMPED, mode);
        for i in 0..200 {
            let v = 10f64.powf(f64::from(i) / 20.0 - 12.0);
            let response = law.respond(v, &Size::flat(3.3e-7));
            assert!((0.0..=1.0).contains(&response.e), "{mode:?} {v}: {response:?}");
            assert!(response.lost().is_finite(), "{mode:?} {v}: {response:?}");
        }
    }
}
