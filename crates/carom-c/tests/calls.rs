//! What a C program sees: the core's answers to the bit, statuses, messages, sizes.

mod common;

use carom_c::*;
use common::*;
use std::ptr::{null, null_mut};

/// The same law from the core.
fn core_law(name: &str) -> carom::WallLaw {
    let spec = carom::spec::parse_named_law(WALLS, name).expect("a law");
    spec.compile(carom::material::Library::builtin()).expect("it compiles")
}

/// The same impact for the core.
fn core_impact(i: &ImpactIn) -> carom::Impact {
    carom::Impact {
        diameter: i.diameter,
        density: (i.density != 0.0).then_some(i.density),
        velocity: i.velocity,
        spin: i.spin,
        normal: i.normal,
        wall_velocity: i.wall_velocity,
        draws: i.draws,
    }
}

/// All of an answer as bits, so that NaN equals itself.
fn bits(out: &ImpactOut) -> Vec<u64> {
    let e = &out.energy;
    let energy = [e.adhesion, e.adhesion_damping, e.hertz_damping, e.plastic, e.other, e.friction, e.captured, e.kept];
    let ratios = [out.restitution, out.impulse_ratio, out.tangential_restitution];
    let numbers = out.velocity.iter().chain(&out.spin).chain(&ratios).chain(&energy);
    let words = [i64::from(out.fate) as u64, i64::from(out.contact) as u64, out.validity];
    words.into_iter().chain(numbers.map(|x| x.to_bits())).collect()
}

fn core_bits(outcome: &carom::Outcome) -> Vec<u64> {
    let fate = if outcome.fate == carom::Fate::Rebound { 0 } else { 1 };
    let contact = match outcome.contact {
        carom::Contact::None => 0,
        carom::Contact::Sliding => 1,
        carom::Contact::Rolling => 2,
        carom::Contact::MicroSlip => 3,
    };
    let ratios = [outcome.restitution, outcome.impulse_ratio, outcome.tangential_restitution];
    let energy = outcome.energy.named().map(|(_, x)| x);
    let numbers = outcome.velocity.iter().chain(&outcome.spin).chain(&ratios).chain(&energy);
    [fate, contact, outcome.validity.bits().into()].into_iter().chain(numbers.map(|x| x.to_bits())).collect()
}

#[test]
fn answers_are_the_cores_one_by_one_and_in_a_batch() {
    for name in ["glass", "steel", "table", "resolved"] {
        let (law, core) = (law(WALLS, Some(name)).expect("a law"), core_law(name));
        let ins = impacts(if name == "resolved" { 50 } else { 2000 });
        let mut outs = vec![blank(); ins.len()];
        let mut failed = 0;
        // SAFETY: a law and arrays of the length said.
        let status = unsafe { carom_impact_batch(law, ins.len(), ins.as_ptr(), outs.as_mut_ptr(), &raw mut failed) };
        assert_eq!(status, Status::NotApproaching, "{}", message());
        let mut met = 0;
        for (i, (impact, in_batch)) in ins.iter().zip(&outs).enumerate() {
            let mut out = blank();
            // SAFETY: a law and structs of the size they say.
            let status = unsafe { carom_impact(law, impact, &raw mut out) };
            assert_eq!(bits(&out), bits(in_batch), "{name} {i}");
            match core.impact(&core_impact(impact)) {
                Ok(outcome) => {
                    assert_eq!((status, bits(&out)), (Status::Ok, core_bits(&outcome)), "{name} {i}");
                    met += 1;
                }
                Err(error) => {
                    assert_eq!((status, message()), (Status::NotApproaching, error.to_string()));
                    assert!(out.fate == -1 && out.velocity == impact.velocity && out.spin == impact.spin);
                    assert!(failed <= i, "{failed} is the first");
                }
            }
        }
        assert!(ins.len() / 3 < met && met < ins.len(), "{met} of {}", ins.len());
        assert!(outs[failed].fate == -1 && outs[..failed].iter().all(|o| o.fate != -1));
        // SAFETY: made above, used no more.
        unsafe { carom_law_free(law) };
    }
}

#[test]
fn a_batch_of_impacts_alone_is_ok() {
    let law = law(WALLS, Some("glass")).expect("a law");
    let (ins, mut outs) = ([impact(); 3], [blank(); 3]);
    let mut failed = 9;
    // SAFETY: a law and arrays of the length said; none at all for no impacts.
    unsafe {
        assert_eq!(carom_impact_batch(law, 3, ins.as_ptr(), outs.as_mut_ptr(), &raw mut failed), Status::Ok);
        assert_eq!(failed, 3);
        assert_eq!(carom_impact_batch(law, 0, null(), null_mut(), &raw mut failed), Status::Ok);
        assert_eq!(failed, 0);
        assert_eq!(carom_impact_batch(law, 3, ins.as_ptr(), outs.as_mut_ptr(), null_mut()), Status::Ok);
        carom_law_free(law);
    }
}

#[test]
fn a_text_with_one_law_needs_no_name() {
    let keys = "normal = \"constant\"\nrestitution = 0.9\nfriction = 0.1\n";
    for (text, name) in [(keys.to_owned(), None), (format!("[law.only]\n{keys}"), None), (WALLS.into(), Some("table"))]
    {
        let law = law(&text, name).expect("a law");
        // SAFETY: a law that was not freed.
        unsafe { carom_law_free(law) };
    }
}

#[test]
fn a_law_says_whether_it_scatters() {
    for (angle, scatters) in [("0 deg", 0), ("5 deg", 1)] {
        let text = format!("normal = \"constant\"\nrestitution = 0.8\nfriction = 0.2\nroughness_angle = \"{angle}\"\n");
        let law = law(&text, None).expect("a law");
        // SAFETY: a law that was not freed.
        unsafe {
            assert_eq!(carom_law_scatters(law), scatters, "{angle}");
            carom_law_free(law);
        }
    }
}

#[test]
fn bad_laws_are_shown_at_their_line() {
    let refused = |text: &str, name| law(text, name).expect_err("it is refused");
    let (status, said) =
        refused("[law.a]\nnormal = \"ea\"\nsphere = \"coper\"\nsurface = \"glass\"\nfriction = 0\n", None);
    assert_eq!(status, Status::BadLaw);
    let lines: Vec<&str> = said.lines().collect();
    assert!(lines[0].starts_with("law:3:10: unknown material 'coper'; did you mean copper?"), "{said}");
    assert_eq!(lines[1..], ["  3 | sphere = \"coper\"", "    |          ^^^^^^^"], "{said}");
    let (status, said) = refused(WALLS, Some("glas"));
    assert_eq!(
        (status, said.as_str()),
        (Status::BadLaw, "law: no law 'glas'; did you mean glass? known are glass, resolved, steel, table")
    );
    assert!(refused(WALLS, None).1.contains("name one of glass, resolved, steel, table"));
    assert!(refused("normal = ", None).1.starts_with("law:1:1"));
}

#[test]
fn files_are_read_and_missing_ones_named() {
    let folder = std::env::temp_dir().join(format!("carom-c-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let place = |name: &str| c(folder.join(name).to_str().expect("UTF-8"));
    std::fs::write(folder.join("walls.toml"), WALLS.replace("\"copper\"", "\"mine\"")).expect("written");
    std::fs::write(folder.join("mine.toml"), "[material.mine]\ndensity = { value = 9000 }\n").expect("written");
    let mut out = null_mut();
    let name = c("glass");
    // SAFETY: texts that end with a zero, and a place for the answer.
    unsafe {
        let from = |file: &str, materials: Option<&str>, out: *mut *mut Law| {
            let (file, materials) = (place(file), materials.map(place));
            carom_law_from_file(file.as_ptr(), name.as_ptr(), materials.as_ref().map_or(null(), |m| m.as_ptr()), out)
        };
        assert_eq!(from("walls.toml", None, &raw mut out), Status::BadLaw);
        assert!(message().contains("walls.toml:3:10: unknown material 'mine'"), "{}", message());
        assert_eq!(from("none.toml", None, &raw mut out), Status::File);
        assert!(message().ends_with("none.toml: No such file or directory"), "{}", message());
        assert_eq!(from("walls.toml", Some("none.toml"), &raw mut out), Status::File);
        assert_eq!(from("walls.toml", Some("mine.toml"), &raw mut out), Status::BadLaw);
        assert!(!message().contains("unknown material") && message().contains("mine"), "{}", message());
        std::fs::write(folder.join("walls.toml"), WALLS).expect("written");
        assert_eq!(from("walls.toml", None, &raw mut out), Status::Ok, "{}", message());
        assert_eq!(carom_law_density(out), core_law("glass").density());
        carom_law_free(out);
    }
    std::fs::remove_dir_all(&folder).expect("it goes");
}

#[test]
fn null_pointers_and_bad_numbers_are_refused() {
    let law = law(WALLS, Some("glass")).expect("a law");
    let (good, mut out) = (impact(), blank());
    let mut speed = 0.0;
    // SAFETY: NULL where an error is wanted, else fit.
    unsafe {
        let bad = Status::BadArgument;
        assert_eq!(carom_law_from_text(null(), null(), null(), &mut null_mut()), bad);
        assert_eq!(message(), "toml is NULL");
        assert_eq!(carom_law_from_text(c"".as_ptr(), null(), null(), null_mut()), bad);
        assert_eq!(carom_law_from_text(c"a = \"\xff\"".as_ptr(), null(), null(), &mut null_mut()), bad);
        assert!(message().starts_with("toml is not UTF-8"));
        assert_eq!(carom_law_from_file(null(), null(), null(), &mut null_mut()), bad);
        assert_eq!(carom_impact(null(), &raw const good, &raw mut out), bad);
        assert_eq!(carom_impact(law, null(), &raw mut out), bad);
        assert_eq!(carom_impact(law, &raw const good, null_mut()), bad);
        assert_eq!(carom_impact_batch(law, 1, null(), &raw mut out, null_mut()), bad);
        assert_eq!(carom_capture_velocity(null(), 1e-5, 0.0, 1.0, &raw mut speed), bad);
        assert_eq!(carom_capture_velocity(law, 1e-5, 0.0, 1.0, null_mut()), bad);
        for angle in [0.0, -1.0, 1.6, f64::NAN] {
            assert_eq!(carom_capture_velocity(law, 1e-5, 0.0, angle, &raw mut speed), bad);
        }
        assert_eq!(carom_capture_velocity(law, -1.0, 0.0, 1.0, &raw mut speed), Status::BadImpact);
        assert!(carom_law_density(null()).is_nan());
        assert_eq!((carom_law_scatters(law), carom_law_scatters(null())), (0, -1));
        carom_law_free(null_mut());

        for wrong in [
            ImpactIn { diameter: 0.0, ..good },
            ImpactIn { density: -1.0, ..good },
            ImpactIn { velocity: [f64::NAN; 3], ..good },
            ImpactIn { normal: [0.0; 3], ..good },
            ImpactIn { spin: [f64::INFINITY, 0.0, 0.0], ..good },
        ] {
            assert_eq!(carom_impact(law, &raw const wrong, &raw mut out), Status::BadImpact, "{wrong:?}");
            assert!(out.fate == -1 && !message().is_empty());
        }
        carom_law_free(law);
    }
}

#[test]
fn older_and_smaller_structs_are_accepted_and_newer_ones_refused() {
    let law = law(WALLS, Some("glass")).expect("a law");
    let (full_in, full_out) = (impact(), blank());
    let (most_in, most_out) = (full_in.size, full_out.size);
    let run = |in_size: usize, out_size: usize| {
        // what lies behind the sizes said must neither be read nor written
        let mut garbled = ImpactIn { wall_velocity: [1e300; 3], draws: [f64::NAN; 4], size: in_size, ..full_in };
        if in_size == most_in {
            (garbled.wall_velocity, garbled.draws) = (full_in.wall_velocity, full_in.draws);
        }
        let mut out = ImpactOut { size: out_size, ..full_out };
        out.energy.kept = -7.0;
        // SAFETY: structs of at least the size they say, or a size that is refused.
        (unsafe { carom_impact(law, &raw const garbled, &raw mut out) }, out)
    };
    let (status, whole) = run(most_in, most_out);
    assert_eq!((status, whole.energy.kept > 0.0), (Status::Ok, true));
    let (least_in, least_out) =
        (std::mem::offset_of!(ImpactIn, wall_velocity), std::mem::offset_of!(ImpactOut, validity));
    let (status, short) = run(least_in, least_out);
    assert_eq!(status, Status::Ok, "{}", message());
    assert_eq!((short.velocity, short.spin, short.size), (whole.velocity, whole.spin, least_out));
    assert_eq!(short.energy.kept, -7.0);
    for (in_size, out_size) in [
        (0, most_out),
        (least_in - 8, most_out),
        (most_in + 8, most_out),
        (least_in + 4, most_out),
        (most_in, 0),
        (most_in, most_out + 8),
    ] {
        let (status, out) = run(in_size, out_size);
        assert_eq!(status, Status::BadArgument, "{in_size} {out_size}");
        assert!(message().contains("bytes long"), "{}", message());
        assert_eq!(out.energy.kept, -7.0);
    }
    assert!(
        run(most_in + 8, most_out).0 == Status::BadArgument
            && message().contains("compiled with the header of a later one")
    );

    // a batch walks by the sizes said, and they must be the same all along
    let two = [full_in, ImpactIn { size: least_in, ..full_in }];
    let mut outs = [full_out; 2];
    let mut failed = 0;
    // SAFETY: arrays of two.
    let status = unsafe { carom_impact_batch(law, 2, two.as_ptr(), outs.as_mut_ptr(), &raw mut failed) };
    assert_eq!((status, failed, outs[0].restitution), (Status::BadArgument, 1, 0.0));
    // SAFETY: used no more.
    unsafe { carom_law_free(law) };
}

#[test]
fn capture_velocity_is_the_windows_and_falls_with_no_angle() {
    let capture = |name: &str, density: f64, angle: f64| {
        let law = law(WALLS, Some(name)).expect("a law");
        let mut speed = f64::NAN;
        // SAFETY: a law and a place for the answer.
        let status = unsafe { carom_capture_velocity(law, 10e-6, density, angle, &raw mut speed) };
        assert_eq!(status, Status::Ok, "{}", message());
        // SAFETY: used no more.
        unsafe { carom_law_free(law) };
        speed
    };
    let head_on = std::f64::consts::FRAC_PI_2;
    for name in ["glass", "steel"] {
        let window = core_law(name).window(10e-6, Some(9000.0)).expect("fits").expect("it rebounds");
        assert_eq!(capture(name, 9000.0, head_on), window.capture_velocity);
        let own = core_law(name).window(10e-6, None).expect("fits").expect("it rebounds").capture_velocity;
        assert!((capture(name, f64::NAN, 0.5) * 0.5f64.sin() / own - 1.0).abs() < 1e-14);
        // just below it sticks, just above it rebounds
        let fate = |factor: f64| {
            let v = own * factor / 0.5f64.sin();
            let i = carom::Impact::new(10e-6, [v * 0.5f64.cos(), -v * 0.5f64.sin(), 0.0], [0.0, 1.0, 0.0]);
            core_law(name).impact(&i).expect("it approaches").fate
        };
        assert_eq!((fate(1.0 - 1e-9), fate(1.0 + 1e-9)), (carom::Fate::Capture, carom::Fate::Rebound));
    }
    assert_eq!(capture("table", 0.0, head_on), 0.0);
}
