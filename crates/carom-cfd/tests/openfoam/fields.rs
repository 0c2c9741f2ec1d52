//! What the entries of patches give.

use carom_cfd::openfoam::{Names, times};

use super::*;

/// The stored block with this U, and its boundary values.
fn with(text: &str) -> Result<Snapshot, Error> {
    let (_folder, case) = copied("block");
    fs::write(case.join("2/U"), format!("FoamFile {{ format ascii; class volVectorField; }}\n{text}")).unwrap();
    read(&case, &Options::default())
}

#[test]
fn stored_fields_are_as_their_files_say() {
    let s = latest(&stored("block"));
    let (u, on) = values(s.fields.velocity.as_ref());
    assert_eq!(u.as_flattened(), plain_numbers(&stored("block").join("2/U")));
    let at = |face: usize| on[face - 20];
    // inlet, 20..24: fixed; outlet, 24..28: the cell's; lower, 28..34: no slip; upper, 34..40: along it; left, 40..46: the cell's
    assert_eq!(at(21), [1.0, 0.1, 0.0]);
    assert_eq!(at(25), u[s.mesh.owner[25] as usize]);
    assert_eq!(at(30), [0.0; 3]);
    assert_eq!(at(44), u[s.mesh.owner[44] as usize]);
    let (_, area) = carom_cfd::geometry::face_centre_and_area(&s.mesh.points, s.mesh.faces.get(36));
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cell = u[s.mesh.owner[36] as usize];
    assert!(
        dot(at(36), area).abs() < 1e-12 * dot(area, area).sqrt() && at(36)[0] != cell[0] && dot(at(36), cell) > 0.8
    );
    let (k, on) = values(s.fields.k.as_ref());
    assert_eq!((k[0], on[24 - 20], on[29 - 20]), ([0.019429073], [0.033976933], [0.019428749]));
    assert!(s.fields.omega.is_none() && s.fields.density.is_none() && s.fields.temperature.is_none());
    assert_eq!(s.fields.others, ["C", "V"]);
    assert_eq!(s.notes, ["of 2 times from 1 to 2, 2 is used, frozen", "pressure (p) is over the density, m²/s²"]);
}

#[test]
fn entries_by_name_group_and_pattern_with_macros() {
    let s = with(
        r#"speed 3; /* of the inlet */ inflow { type fixedValue; value uniform ($speed 0 0); }
        internalField uniform (1 2 3); // everywhere
        boundaryField
        {
            #includeEtc "caseDicts/setConstraintTypes"
            ".*" { type fixedValue; value $internalField; }
            "out.*" { type fixedValue; value $..speedy; speedy uniform (7 7 7); }
            inlet { $..inflow; }
            solid { type fixedValue; value nonuniform List<vector> 6{(0 0 5)}; }
        }"#,
    );
    // one further out, where a pattern fits
    let e = s.unwrap_err().to_string();
    assert!(e.ends_with("2/U:8: `$..speedy` is a dictionary"), "{e}");
    let s = with(
        r#"speed 3; inflow { type fixedValue; value uniform ($speed 0 0); }
        internalField uniform (1 2 3);
        boundaryField
        {
            ".*" { type fixedValue; value $internalField; }
            "out.*" { type fixedValue; value $.speedy; speedy uniform (7 7 7); }
            inlet { $...inflow; }
            solid { type fixedValue; value nonuniform List<vector> 6{(0 0 5)}; }
        }"#,
    )
    .unwrap();
    let (u, on) = values(s.fields.velocity.as_ref());
    assert_eq!(u, [[1.0, 2.0, 3.0]; 12]);
    assert_eq!((on[0], on[4], on[8], on[20]), ([3.0, 0.0, 0.0], [7.0; 3], [0.0, 0.0, 5.0], [1.0, 2.0, 3.0]));
}

#[test]
fn kinds_without_a_value() {
    let s = with(
        "internalField uniform (1 2 3); boundaryField { inlet { type zeroGradient; } outlet { type surfaceNormalFixedValue; refValue uniform -1; }
         lower { type slip; } }",
    )
    .unwrap();
    let (_, on) = values(s.fields.velocity.as_ref());
    assert_eq!((on[0], on[4], on[8]), ([1.0, 2.0, 3.0], [1.0, 2.0, 3.0], [1.0, 0.0, 3.0]));
    let note = "U: patch `outlet` is a surfaceNormalFixedValue without values; there it is as in the cells beside it";
    assert!(s.notes.iter().any(|n| n == note), "{:?}", s.notes);
}

#[test]
fn fields_of_other_names_and_times() {
    let (_folder, case) = copied("block");
    fs::rename(case.join("2/U"), case.join("2/UMean")).unwrap();
    assert!(latest(&case).fields.velocity.is_none());
    assert_eq!(latest(&case).fields.others, ["C", "UMean", "V"]);
    let names = Names { velocity: Some("UMean".into()), ..Names::default() };
    let s = read(&case, &Options { names, ..Options::default() }).unwrap();
    assert_eq!(s.fields.velocity, latest(&stored("block")).fields.velocity);
    let names = Names { omega: Some("omegaMean".into()), ..Names::default() };
    let e = message(read(&case, &Options { names, ..Options::default() }), &case);
    assert_eq!(e, "CASE/2: no field `omegaMean`; there are C, UMean, V, epsilon, k, p");
    // times sort by number, and are found by it
    for t in ["10", "9.5", "1e2", "0.orig", "0"] {
        copy(&case.join("1"), &case.join(t), &|b| b);
    }
    assert_eq!(times(&case).unwrap(), ["0", "1", "2", "9.5", "10", "1e2"]);
    let at = |t: &str| read(&case, &Options { time: Some(t.into()), ..Options::default() });
    assert_eq!(at("latest").unwrap().time.as_deref(), Some("1e2"));
    assert_eq!(at("100").unwrap().time.as_deref(), Some("1e2"));
    assert_eq!(message(at("3"), &case), "CASE: no time `3`; there are 0, 1, 2, 9.5, 10, 1e2");
}

#[test]
fn a_passive_scalar_is_no_temperature() {
    let (_folder, case) = copied("block");
    let scalar = |dimensions: &str| {
        let text = format!(
            "FoamFile {{ format ascii; class volScalarField; }}\ndimensions {dimensions};\ninternalField uniform 0.5;\n\
             boundaryField {{ \".*\" {{ type calculated; value $internalField; }} }}"
        );
        fs::write(case.join("2/T"), text).unwrap();
    };
    scalar("[0 0 0 0 0 0 0]");
    let s = latest(&case);
    assert!(s.fields.temperature.is_none() && s.fields.others.iter().any(|n| n == "T"), "{:?}", s.fields.others);
    let note = "T has the dimensions [0 0 0 0 0 0 0], and not [0 0 0 1 0 0 0]: it is another quantity, and left out";
    assert!(s.notes.iter().any(|n| n == note), "{:?}", s.notes);
    let read_as = |name: &str| {
        let names = Names { temperature: Some(name.into()), ..Names::default() };
        read(&case, &Options { names, ..Options::default() })
    };
    // one that is named is meant
    let e = message(read_as("T"), &case);
    assert_eq!(e, "CASE/2/T:2: T has the dimensions [0 0 0 0 0 0 0], and not [0 0 0 1 0 0 0]");
    // the dimensions of a temperature, with the values of none
    scalar("[0 0 0 1 0 0 0]");
    assert!(latest(&case).fields.temperature.is_some());
    let s = read_as("none").unwrap();
    assert!(s.fields.temperature.is_none() && s.fields.velocity.is_some());
    assert!(s.fields.others.iter().any(|n| n == "T") && s.notes.iter().all(|n| !n.starts_with('T')));
}

#[test]
fn a_compressible_result() {
    let (_folder, case) = copied("block");
    let scalar = |name: &str, dimensions: &str, value: f64| {
        let text = format!(
            "FoamFile {{ format ascii; class volScalarField; }} dimensions {dimensions}; internalField uniform {value};
             boundaryField {{ \".*\" {{ type calculated; value $internalField; }} }}"
        );
        fs::write(case.join("2").join(name), text).unwrap();
    };
    scalar("rho", "[1 -3 0 0 0 0 0]", 1.2);
    scalar("T", "[0 0 0 1 0 0 0]", 300.0);
    scalar("p", "[1 -1 -2 0 0 0 0]", 1e5);
    scalar("omega", "[0 0 -1 0 0]", 7.0);
    let s = latest(&case);
    assert_eq!(values(s.fields.density.as_ref()).0[3], [1.2]);
    assert_eq!(values(s.fields.temperature.as_ref()).0[3], [300.0]);
    assert_eq!(values(s.fields.omega.as_ref()).1[3], [7.0]);
    assert_eq!(s.notes, ["of 2 times from 1 to 2, 2 is used, frozen"]);
    scalar("k", "[0 1 0 0 0 0 0]", 0.1);
    assert_eq!(refusal(&case), "CASE/2/k:1: k has the dimensions [0 1 0 0 0 0 0], and not [0 2 -2 0 0 0 0]");
}
