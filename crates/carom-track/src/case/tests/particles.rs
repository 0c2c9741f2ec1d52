use super::*;
use crate::case::Sources;

const LISTED: &str = r#"
[flow]
kind = "uniform"
velocity = [3, 0, 0]
[[wall]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 1, 0] }
law = "trap"
[[injection]]
density = 1000
particles = "starts.csv"
"#;

fn with(text: &str, starts: &str) -> Result<Case, CaseError> {
    let files = [("starts.csv".to_owned(), starts.as_bytes().to_vec())].into();
    Case::from_toml_with(text, Path::new("case.toml"), Library::builtin(), &Sources::new(files))
}

#[test]
fn each_listed_particle_has_its_own_start() {
    let starts = "x,y,z,u,v,w,diameter,weight,time\n0,1e-3,0,1,-2,0.5,1e-5,3,0.25\n0.1,2e-3,0,0,-1,0,2e-5,1,0\n";
    let case = with(LISTED, starts).unwrap();
    assert_eq!(case.count(), 2);
    let (a, b) = (case.particle(0).unwrap(), case.particle(1).unwrap());
    assert_eq!((a.position, a.velocity, a.diameter, a.weight), ([0.0, 1e-3, 0.0], [1.0, -2.0, 0.5], 1e-5, 3.0));
    assert_eq!(a.time, 0.25);
    assert_eq!((b.position, b.diameter), ([0.1, 2e-3, 0.0], 2e-5));
    assert_ne!(case.fingerprint, with(LISTED, &starts.replace("0.25", "0.26")).unwrap().fingerprint);
}

#[test]
fn what_the_list_leaves_out_the_injection_says() {
    let text = LISTED.replace("density", "diameter = \"5 um\"\nvelocity = \"fluid\"\nstart = \"1 s\"\ndensity");
    let p = with(&text, "x,y,z\n0,1e-3,0\n").unwrap().particle(0).unwrap();
    assert_eq!((p.velocity, p.diameter, p.weight, p.time), ([3.0, 0.0, 0.0], 5e-6, 1.0, 1.0));
}

#[test]
fn mistakes_in_a_list_are_named() {
    let refused = |text: &str, starts: &str, part: &str| {
        let error = with(text, starts).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    };
    let good = "x,y,z,u,v,w,diameter\n0,1e-3,0,1,1,1,1e-5\n";
    refused(LISTED, &good.replace("diameter", "size"), "no column \"size\"");
    refused(LISTED, "x,y\n0,1\n", "needs x, y and z");
    refused(LISTED, "x,y,z,u\n0,1,0,1\n", "a velocity is u, v and w");
    refused(LISTED, "x,y,z\n", "no particles");
    refused(LISTED, &good.replace("1e-3", "far"), "line 2: \"far\" is no number");
    refused(LISTED, &good.replace("1e-3", "nan"), "position of a listed particle");
    refused(LISTED, &good.replace("1e-5", "-1"), "diameter");
    refused(LISTED, "x,y,z\n0,1e-3,0\n", "needs diameter");
    refused(&LISTED.replace("density", "diameter = 1e-6\ndensity"), good, "bring their diameters along");
    refused(&LISTED.replace("density", "count = 3\ndensity"), good, "as many as there are");
    refused(&LISTED.replace("density", "position = [0, 1, 0]\ndensity"), good, "both position and particles");
    refused(&LISTED.replace("density", "distribution = \"flux\"\ndensity"), good, "needs an area");
    refused(LISTED, &good.replace("1e-3", "-1e-3"), "starts inside wall 'floor'");
}
