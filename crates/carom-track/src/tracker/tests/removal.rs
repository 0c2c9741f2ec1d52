//! Captured spheres that the flow takes off again.

use super::*;
use crate::flow::{Channel, Profile};
use carom::removal::Mode;

const ADHESIVE: &str = "sphere = \"copper\"\nsurface = \"silicon\"\nnormal = \"ea\"\nfriction = 0.2\n";

fn fall(removal: Option<Reentrainment>) -> Log {
    fall_on(ADHESIVE, removal)
}

/// Spheres of 20 µm that fall slowly onto a plate in a turbulent channel and stay.
fn fall_on(text: &str, removal: Option<Reentrainment>) -> Log {
    let flow = Channel::new(Profile::Turbulent, 0.03, 10.0, &Fluid::default()).unwrap();
    let domain = AnyDomain::new(Flow::Channel(flow), vec![plane("floor", [0.0; 3], [0.0, 1.0, 0.0])]);
    let laws = vec![law(text)];
    let behavior = match removal {
        None => Behavior::Law(laws),
        Some(removal) => Behavior::Removal(laws, removal),
    };
    let particles: Vec<_> =
        (0..5).map(|n| Particle { diameter: 20e-6, ..sphere(n, [0.0, 1e-4, 0.0], [0.0; 3]) }).collect();
    track(&domain, &dynamics(Drag::SchillerNaumann), &[behavior], settings(), &particles)
}

fn held(text: &str) -> carom::removal::Removal {
    let air = Fluid::default();
    let fluid = carom::removal::Fluid { density: air.density, viscosity: air.viscosity };
    law(text).removal(20e-6, &fluid).unwrap().unwrap()
}

#[test]
fn a_flow_faster_than_the_critical_one_removes_and_a_slower_one_does_not() {
    assert!(fall(None).ends.iter().all(|e| e.fate == ParticleFate::Captured));
    for (mode, event) in
        [(None, Mode::Rolling), (Some(Mode::Sliding), Mode::Sliding), (Some(Mode::Lifting), Mode::Lifting)]
    {
        let critical = held(ADHESIVE).of(event).unwrap().friction_velocity;
        let at = |share: f64| fall(Some(Reentrainment { mode, friction_velocity: Some(share * critical) }));
        assert!(at(0.999).ends.iter().all(|e| e.fate == ParticleFate::Captured), "{mode:?}");
        let log = at(1.001);
        assert!(log.ends.iter().all(|e| e.fate == ParticleFate::Removed && e.velocity == [0.0; 3]), "{mode:?}");
        assert!(log.impacts.iter().all(|i| i.event == Event::Remove(event)), "{mode:?}");
        // the impact itself is the capture it was
        let (kept, gone) = (fall(None).impacts, log.impacts);
        assert_eq!(
            kept.iter().map(|i| i.energy).collect::<Vec<_>>(),
            gone.iter().map(|i| i.energy).collect::<Vec<_>>()
        );
    }
}

#[test]
fn the_flows_own_friction_velocity_counts_where_none_is_given() {
    let flow = Channel::new(Profile::Turbulent, 0.03, 10.0, &Fluid::default()).unwrap();
    let own = flow.friction_velocity();
    for (factor, fate) in [(1.0, ParticleFate::Captured), (0.002, ParticleFate::Removed)] {
        let text = format!("{ADHESIVE}roughness_factor = {factor}\n");
        assert_eq!(own > held(&text).rolling.friction_velocity, fate == ParticleFate::Removed, "{own}");
        let log = fall_on(&text, Some(Reentrainment::default()));
        assert!(log.ends.iter().all(|e| e.fate == fate), "{factor}: {:?}", log.ends[0]);
    }
}
