//! Reference values: 70 µm stainless steel on silicon, and 5 mm alumina on aluminium, to twelve digits.

mod common;

use carom::{Impact, WallLaw};
use common::law;

const PAIR: &str = "sphere = \"rho=8000,E=190GPa,nu=0.27\"\nsurface = \"rho=2330,E=166GPa,nu=0.28\"\nwork_of_adhesion = 3.03\nroughness_factor = 0.15\nfriction = 0\n";

fn e(law: &WallLaw, v: f64) -> f64 {
    law.impact(&Impact::new(70e-6, [0.0, -v, 0.0], [0.0, 1.0, 0.0])).expect("it approaches").restitution
}

#[test]
fn ea_closed_forms() {
    let undamped = law(&format!("{PAIR}normal = \"ea\"\n"));
    let damped =
        law(&format!("{PAIR}normal = \"ea\"\nadhesion_damping = \"1.3 s/m\"\nhertz_damping = \"0.007 s/m\"\n"));
    for (v, one, two) in [
        (0.3, 0.9271350059955532, 0.8960525069420147),
        (1.0, 0.9728332492052143, 0.9329415264545418),
        (5.0, 0.9925777290840754, 0.9259192552479376),
        (20.0, 0.9975576676878326, 0.860967206425345),
    ] {
        assert!((e(&undamped, v) / one - 1.0).abs() < 1e-12, "{v}: {}", e(&undamped, v));
        assert!((e(&damped, v) / two - 1.0).abs() < 1e-12, "{v}: {}", e(&damped, v));
    }
}

#[test]
fn capture_and_the_window_of_rebound() {
    let undamped = law(&format!("{PAIR}normal = \"ea\"\n"));
    let window = undamped.window(70e-6, None).expect("in range").expect("it rebounds");
    assert!((window.capture_velocity / 0.0257875508304544 - 1.0).abs() < 1e-12);
    assert_eq!(window.exhausted_velocity, f64::INFINITY);
    let damped = law(&format!("{PAIR}normal = \"ea\"\nadhesion_damping = 1.3\nhertz_damping = 0.007\n"));
    let window = damped.window(70e-6, None).expect("in range").expect("it rebounds");
    assert!((window.capture_velocity - 0.0269266).abs() < 5e-8, "{window:?}");
    assert!((window.exhausted_velocity - 128.325).abs() < 5e-4, "{window:?}");
    // the end of the model's domain is told apart from adhesion
    let fast = damped.impact(&Impact::new(70e-6, [0.0, -200.0, 0.0], [0.0, 1.0, 0.0])).expect("approaching");
    assert_eq!(fast.validity.codes().collect::<Vec<_>>(), ["damping-exhausted", "large-contact"]);
    let slow = damped.impact(&Impact::new(70e-6, [0.0, -0.01, 0.0], [0.0, 1.0, 0.0])).expect("approaching");
    assert!(slow.validity.is_empty() && slow.restitution == 0.0);
    // adhesion so strong and damping so large that no speed rebounds
    let none = law(&format!("{PAIR}normal = \"ea\"\nadhesion_damping = 50\nhertz_damping = 10\n"));
    assert_eq!(none.window(7e-6, None), Ok(None));
    let out = none.impact(&Impact::new(7e-6, [0.0, -0.1, 0.0], [0.0, 1.0, 0.0])).expect("approaching");
    assert_eq!(out.validity.codes().collect::<Vec<_>>(), ["no-rebound-window"]);
}

#[test]
fn eap_closed_forms() {
    let text = "sphere = \"rho=3950,E=360GPa,nu=0.23\"\nsurface = \"E=70GPa,nu=0.35\"\nplastic_constant = \"145 MPa\"\nnormal = [\"plastic-kadomtsev\"]\nfriction = 0\n";
    let wall = law(text);
    let e = |v: f64| wall.impact(&Impact::new(5e-3, [0.0, -v, 0.0], [0.0, 1.0, 0.0])).expect("approaching").restitution;
    let v_y = wall.yield_velocity(5e-3, None).expect("in range").expect("plastic");
    assert!((v_y / 0.3090864456266438 - 1.0).abs() < 1e-12);
    assert!((e(1.0) / 0.8511273680121857 - 1.0).abs() < 1e-12);
    assert!((e(6.3) / 0.600055619 - 1.0).abs() < 1e-9);
}

#[test]
fn bons_rebounds_between_two_captures() {
    let text = |w: f64| {
        format!(
            "sphere = \"rho=2500,E=70GPa,nu=0.2,sigma=60MPa\"\nsurface = \"E=200GPa,nu=0.3\"\nwork_of_adhesion = {w}\nnormal = [\"plastic-bons\", \"adhesion-work\"]\nfriction = 0\n"
        )
    };
    let wall = law(&text(0.5));
    let at = |v: f64| wall.impact(&Impact::new(2e-6, [0.0, -v, 0.0], [0.0, 1.0, 0.0])).expect("approaching");
    let e_star = 1.0 / (0.96 / 70e9 + 0.91 / 200e9);
    let v_y = wall.yield_velocity(2e-6, None).expect("in range").expect("plastic");
    assert!((v_y / (60e6 / (2500.0f64 * e_star).sqrt()) - 1.0).abs() < 1e-12);
    let window = wall.window(2e-6, None).expect("in range").expect("it rebounds");
    assert!(window.capture_velocity < v_y && v_y < window.exhausted_velocity, "{window:?} {v_y}");
    for (v, restitution_is_zero, codes) in [
        (0.999 * window.capture_velocity, true, &[][..]),
        (1.001 * window.capture_velocity, false, &[]),
        (0.999 * window.exhausted_velocity, false, &[]),
        (1.001 * window.exhausted_velocity, true, &["plastic-exhausted"]),
    ] {
        let out = at(v);
        assert_eq!(out.restitution == 0.0, restitution_is_zero, "{v}: {out:?}");
        assert_eq!(out.validity.codes().collect::<Vec<_>>(), codes, "{v}");
    }
    // adhesion so strong that it still holds at yield
    let none = law(&text(50.0));
    assert_eq!(none.window(2e-6, None), Ok(None));
    let out = none.impact(&Impact::new(2e-6, [0.0, -v_y, 0.0], [0.0, 1.0, 0.0])).expect("approaching");
    assert_eq!(out.validity.codes().collect::<Vec<_>>(), ["no-rebound-window"]);
}

#[test]
fn a_density_of_the_impact_is_the_same_as_a_law_of_that_density() {
    for normal in ["ea", "eap", "thornton-ning", "resolved"] {
        let with = |rho: f64| {
            let factor = if normal == "thornton-ning" { "" } else { "roughness_factor = 0.4\n" };
            law(&format!(
                "sphere = \"rho={rho},E=190GPa,nu=0.27,sigma=310MPa\"\nsurface = \"rho=2330,E=166GPa,nu=0.28\"\nwork_of_adhesion = 3.03\n{factor}normal = \"{normal}\"\nfriction = 0\n"
            ))
        };
        let mut impact = Impact::new(70e-6, [0.0, -2.0, 0.0], [0.0, 1.0, 0.0]);
        let expected = with(4000.0).impact(&impact).expect("approaching").restitution;
        impact.density = Some(4000.0);
        let got = with(8000.0).impact(&impact).expect("approaching").restitution;
        assert!((got - expected).abs() < 1e-11, "{normal}: {got} {expected}");
    }
}

#[test]
fn a_curved_surface_enters_through_the_effective_radius_alone() {
    // formulas written out: r in the contact, R in the mass
    let wall = law(&format!("{PAIR}normal = \"ea\"\nsurface_curvature = \"50 um\"\n"));
    let (radius, rs, v) = (35e-6f64, 50e-6f64, 0.7f64);
    let r = 1.0 / (1.0 / radius + 1.0 / rs);
    let e_star = 1.0 / ((1.0 - 0.27f64 * 0.27) / 190e9 + (1.0 - 0.28f64 * 0.28) / 166e9);
    let k = 4.0 / 3.0 * e_star;
    let m = 4.0 / 3.0 * std::f64::consts::PI * 8000.0 * radius.powi(3);
    let f0 = (9.0 * k * r * 3.03f64.powi(2) / (2.0 * std::f64::consts::PI)).cbrt();
    let psi =
        8.0 * std::f64::consts::PI / 3.0 * 0.15 * f0 * (1.25 / k).powf(0.6) * (r / (m * m)).powf(0.2) * v.powf(-0.8);
    assert!((e(&wall, v) / (1.0 - psi).sqrt() - 1.0).abs() < 1e-12);
    let concave = law(&format!("{PAIR}normal = \"ea\"\nsurface_curvature = \"-30 um\"\n"));
    assert!(concave.impact(&Impact::new(70e-6, [0.0, -1.0, 0.0], [0.0, 1.0, 0.0])).is_err());
}
