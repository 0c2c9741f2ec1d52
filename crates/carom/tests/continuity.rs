//! Continuity at capture, yield and the stick–slip edge, and the limits γ → 0, σ → ∞, f → 0.

mod common;

use carom::{Contact, Impact, WallLaw};
use common::law;

fn normal(law: &WallLaw, diameter: f64, v: f64) -> f64 {
    law.impact(&Impact::new(diameter, [0.0, -v, 0.0], [0.0, 1.0, 0.0])).expect("it approaches").restitution
}

#[test]
fn restitution_is_continuous_at_capture() {
    for text in common::normal_laws() {
        let wall = law(&format!("{text}friction = 0.1\n"));
        let Some(window) = wall.window(70e-6, None).expect("a diameter in range") else { continue };
        let v = window.capture_velocity;
        if v == 0.0 {
            continue;
        }
        assert_eq!(normal(&wall, 70e-6, v * (1.0 - 1e-9)), 0.0, "{text}");
        // e² rises linearly from zero, so e ≤ √(slope · distance)
        let just_above = normal(&wall, 70e-6, v * (1.0 + 1e-7));
        assert!(just_above < 1e-2, "{text}: {just_above}");
        assert!(normal(&wall, 70e-6, v * 1.01) > just_above, "{text}");
    }
}

#[test]
fn restitution_is_continuous_and_one_at_yield() {
    for text in
        common::normal_laws().iter().filter(|t| t.contains("plastic") || t.contains("\"tabor\"") || t.contains("eap"))
    {
        let wall = law(&format!("{text}friction = 0.1\n"));
        let v = wall.yield_velocity(5e-3, None).expect("a diameter in range").expect("a plastic loss");
        let (below, above) = (normal(&wall, 5e-3, v * (1.0 - 1e-9)), normal(&wall, 5e-3, v * (1.0 + 1e-9)));
        assert!((below - above).abs() < 1e-8, "{text}: {below} {above}");
    }
    let plastic = law(
        "sphere = \"aluminium-oxide\"\nsurface = \"aluminium-gorham-kharaz\"\nnormal = [\"plastic-kadomtsev\"]\nfriction = 0\n",
    );
    let v = plastic.yield_velocity(5e-3, None).expect("fine").expect("plastic");
    // v is rounded: its square may lie a bit above
    assert!(normal(&plastic, 5e-3, v) >= 1.0 - 2.0 * f64::EPSILON);
    assert_eq!(normal(&plastic, 5e-3, v / 3.0), 1.0);
}

#[test]
fn the_impulse_is_continuous_at_the_stick_slip_edge() {
    for text in common::normal_laws() {
        for (tangential, held) in [
            ("friction = 0.2", Contact::Rolling),
            ("tangential = \"walton\"\nwalton_beta = 0.4\nfriction = 0.2", Contact::Rolling),
            ("tangential = \"micro-slip\"\nfriction = 0.2", Contact::MicroSlip),
        ] {
            let wall = law(&format!("{text}{tangential}\n"));
            let at = |angle: f64| {
                let (s, c) = angle.sin_cos();
                wall.impact(&Impact::new(70e-6, [3.0 * c, -3.0 * s, 0.0], [0.0, 1.0, 0.0])).expect("it approaches")
            };
            let edge = wall.critical_angle(70e-6, None, 3.0).expect("in range").expect("friction");
            let (slides, rolls) = (at(edge - 1e-9), at(edge + 1e-9));
            assert_eq!((slides.contact, rolls.contact), (Contact::Sliding, held), "{text}");
            assert!((slides.velocity[0] - rolls.velocity[0]).abs() < 1e-7, "{text}");
            assert!((slides.spin[2] - rolls.spin[2]).abs() * 35e-6 < 1e-7, "{text}");
        }
    }
}

#[test]
fn without_adhesion_yield_or_friction_nothing_is_lost() {
    let base = "sphere = \"rho=8000,E=190GPa,nu=0.27,gamma=GAMMA,sigma=SIGMA\"\nsurface = \"rho=2330,E=166GPa,nu=0.28,gamma=1.42\"\nfriction = F\n";
    let make = |normal: &str, gamma: &str, sigma: &str, f: &str| {
        law(&format!("{}normal = \"{normal}\"\n", base.replace("GAMMA", gamma).replace("SIGMA", sigma).replace('F', f)))
    };
    // γ → 0
    for gamma in ["0", "1e-36"] {
        assert!((normal(&make("ea", gamma, "1e9", "0"), 70e-6, 0.1) - 1.0).abs() < 1e-8);
        assert!((normal(&make("resolved", gamma, "1e9", "0"), 70e-6, 0.1) - 1.0).abs() < 1e-8);
    }
    // σ → ∞: EAP becomes EA
    let (eap, ea) = (make("eap", "1.62", "1e15", "0"), make("ea", "1.62", "1e15", "0"));
    assert_eq!(normal(&eap, 70e-6, 5.0), normal(&ea, 70e-6, 5.0));
    // f → 0: the tangential motion stays
    let wall = make("ea", "1.62", "1e9", "0");
    let out = wall.impact(&Impact::new(70e-6, [2.0, -1.0, 0.5], [0.0, 1.0, 0.0])).expect("it approaches");
    assert_eq!((out.velocity[0], out.velocity[2], out.spin), (2.0, 0.5, [0.0; 3]));
}

#[test]
fn rolling_from_no_spin_keeps_five_sevenths() {
    let wall = law("normal = \"constant\"\nrestitution = 0.9\nfriction = 10\n");
    let out = wall.impact(&Impact::new(1e-4, [7.0, -1.0, 0.0], [0.0, 1.0, 0.0])).expect("it approaches");
    assert!((out.velocity[0] - 5.0).abs() < 1e-14);
    // no slip left: v_t = Rω with the spin rolling forward (about −z)
    assert!((out.velocity[0] + 0.5e-4 * out.spin[2]).abs() < 1e-13);
    assert_eq!(out.contact, Contact::Rolling);
}
