use super::*;
use crate::tables::{IMPACTS, TRAJECTORIES, TableFormat};

fn records(path: &Path) -> Vec<csv::StringRecord> {
    csv::Reader::from_path(path).unwrap().records().map(Result::unwrap).collect()
}

#[test]
fn every_doubt_about_an_impact_is_in_its_row_and_counted() {
    let folder = tempfile::tempdir().unwrap();
    let text = CASE.replace("friction = 0.2", "friction = 0.2\nroughness = \"1 nm\"");
    let case = Case::from_toml(&text, Path::new("case.toml"), Library::builtin()).unwrap();
    let summary = run(&case, &options(folder.path(), 2), &Silent).unwrap();
    let mut counted = vec![0; carom::validity::CODES.len()];
    for row in records(&folder.path().join(LAYOUTS[IMPACTS].file(TableFormat::Csv))) {
        let codes: Vec<&str> = row[28].split_whitespace().collect();
        // only the floor has a law
        assert_eq!(codes.first().copied(), (&row[5] == "floor").then_some("roughness-extrapolated"));
        for (count, (code, _, _)) in counted.iter_mut().zip(carom::validity::CODES) {
            *count += u64::from(codes.contains(&code));
        }
    }
    let counted = carom::validity::CODES.iter().map(|c| c.0).zip(counted).filter(|(_, n)| *n > 0).collect::<Vec<_>>();
    assert!(counted.iter().any(|(code, n)| *code == "roughness-extrapolated" && *n > 1000), "{counted:?}");
    // the law is elastic, and most spheres come faster than they yield
    assert!(counted.iter().any(|(code, n)| *code == "above-yield" && *n > 1000), "{counted:?}");
    assert_eq!(summary.doubts().collect::<Vec<_>>(), counted);
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("summary.json")).unwrap()).unwrap();
    let told = counted.iter().map(|(code, n)| ((*code).to_owned(), serde_json::json!(n))).collect();
    assert_eq!(json["validity"], serde_json::Value::Object(told));
    assert_eq!(json["walls"]["floor"]["validity"], json["validity"]);
    assert_eq!(json["walls"]["ceiling"]["validity"], serde_json::json!({}));
}

#[test]
fn resuming_with_another_material_wall_or_flow_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let text = r#"
        [flow]
        kind = "table"
        file = "flow.csv"
        [[wall]]
        name = "box"
        stl = { file = "box.stl", unit = "1 mm" }
        law = "wall"
        [law.wall]
        normal = "ea"
        surface = "mine"
        friction = 0.2
        [[injection]]
        material = "copper"
        diameter = "200 um"
        position = ["10 mm", "10 mm", "10 mm"]
        velocity = ["2 m/s", "1 m/s", "-3 m/s"]
        [run]
        until = "1 ms"
        "#;
    let go = |changed: &str, resume| {
        let is = |what: &str| changed == what;
        fs::write(at("flow.csv"), if is("flow") { "x,u\n0,1\n1,3\n" } else { "x,u\n0,1\n1,2\n" }).unwrap();
        fs::write(at("box.stl"), stl_box(if is("wall") { [50.0, 20.0, 31.0] } else { [50.0, 20.0, 30.0] })).unwrap();
        let mut library = Library::builtin().clone();
        let gamma = if is("material") { 0.4 } else { 0.3 };
        let mine = |name: &str, gamma: f64| {
            format!(
                "[material.{name}]\ndensity = 2500\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.2\nsurface_energy = {gamma}\n"
            )
        };
        library.extend_from_toml(&mine("mine", gamma)).unwrap();
        // nothing here is made of it
        library.extend_from_toml(&mine("other", if is("other") { 0.1 } else { 0.2 })).unwrap();
        let case = Case::from_toml(text, &at("case.toml"), &library).unwrap();
        run(&case, &RunOptions { resume, ..options(&at("out"), 1) }, &Silent)
    };
    go("nothing", false).unwrap();
    for changed in ["flow", "wall", "material"] {
        let error = go(changed, true).unwrap_err().to_string();
        assert!(error.contains("the case, its materials or a file it names was changed"), "{changed}: {error}");
    }
    go("nothing", true).unwrap();
    go("other", true).unwrap();
}

/// A name and values.
type Array = (String, Vec<[u8; 8]>);

/// The arrays of a VTK file as they were put, by name, and the number of points.
fn arrays(path: &Path) -> (Vec<Array>, usize) {
    let file = fs::read(path).unwrap();
    let text = String::from_utf8_lossy(&file);
    let attribute = |element: &str, key: &str| {
        let from = element.find(&format!("{key}=\"")).unwrap() + key.len() + 2;
        element[from..].split('"').next().unwrap().to_owned()
    };
    let piece = text.lines().find(|line| line.starts_with("<Piece")).unwrap();
    let data = file.windows(2).position(|w| w == b"\n_").unwrap() + 2;
    let all = text.lines().filter(|line| line.starts_with("<DataArray")).map(|element| {
        let at = data + attribute(element, "offset").parse::<usize>().unwrap();
        let length = u64::from_le_bytes(file[at..at + 8].try_into().unwrap()) as usize;
        let values = file[at + 8..at + 8 + length].as_chunks::<8>().0.to_vec();
        (attribute(element, "Name"), values)
    });
    (all.collect(), attribute(piece, "NumberOfPoints").parse().unwrap())
}

#[test]
fn vtk_files_hold_the_tables_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    run(&case_with("trajectories = 20"), &options(folder.path(), 2), &Silent).unwrap();
    let table = |layout: usize| records(&folder.path().join(LAYOUTS[layout].file(TableFormat::Csv)));
    let float = |row: &csv::StringRecord, column: usize| row[column].parse::<f64>().unwrap().to_le_bytes();
    let paths = table(TRAJECTORIES);
    let kept: Vec<_> = table(IMPACTS).into_iter().filter(|r| ["capture", "settle", "trap"].contains(&&r[12])).collect();
    for (file, rows, columns) in [
        ("trajectories.vtp", &paths, [("time", vec![1]), ("spin", vec![8, 9, 10]), ("points", vec![2, 3, 4])]),
        ("deposit.vtp", &kept, [("diameter", vec![6]), ("weight", vec![16]), ("points", vec![2, 3, 4])]),
    ] {
        let (arrays, points) = arrays(&folder.path().join(file));
        assert_eq!(points, rows.len());
        assert!(points > 100);
        let find = |name: &str| &arrays.iter().find(|a| a.0 == name).unwrap().1;
        for (name, columns) in columns {
            let wanted: Vec<_> = rows.iter().flat_map(|r| columns.iter().map(|c| float(r, *c))).collect();
            assert!(*find(name) == wanted, "{name}");
        }
        let connectivity = (0..points as u64).map(u64::to_le_bytes).collect::<Vec<_>>();
        assert_eq!(*find("connectivity"), connectivity);
        assert_eq!(find("offsets").last(), Some(&(points as u64).to_le_bytes()));
    }
    let (trajectories, _) = arrays(&folder.path().join("trajectories.vtp"));
    let particles = &trajectories.iter().find(|a| a.0 == "particle").unwrap().1;
    // 12 of the 3000 of the first injection, and 8 of the 2000 of the second
    assert_eq!(*particles, (0..12u64).chain(3000..3008).map(u64::to_le_bytes).collect::<Vec<_>>());
}

#[test]
fn the_faces_of_a_wall_of_triangles_hold_what_it_kept() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("box.stl"), stl_box([50.0, 20.0, 30.0])).unwrap();
    let text = r#"
        [flow]
        kind = "still"
        [forces]
        drag = "none"
        [[wall]]
        name = "floor"
        plane = { point = [0, "1 mm", 0], normal = [0, 1, 0] }
        law = "trap"
        [[wall]]
        name = "box"
        stl = { file = "box.stl", unit = "1 mm" }
        law = "trap"
        erosion = { law = "dnv", material = "steel" }
        [[injection]]
        density = 2500
        diameter = { table = { diameter = ["120 um", "200 um"], amount = [1, 3] } }
        count = 3000
        position = { box = [["10 mm", "5 mm", "5 mm"], ["40 mm", "15 mm", "25 mm"]] }
        velocity = [0, 3, 4]
        [run]
        until = "1 s"
        [output]
        size_bins = ["100 um", "150 um"]
        face_sizes = true
        "#;
    let case = Case::from_toml(text, &at("case.toml"), Library::builtin()).unwrap();
    let summary = run(&case, &options(&at("whole"), 2), &Silent).unwrap();
    let path = at("whole").join("deposit.vtp");
    let (arrays, points) = arrays(&path);
    assert!(String::from_utf8_lossy(&fs::read(&path).unwrap()).contains("NumberOfPolys=\"12\""));
    assert_eq!(points, 3000 + 3 * 12);
    let find = |name: &str| &arrays.iter().find(|a| a.0 == name).unwrap().1;
    let integers = |name: &str| find(name).iter().map(|b| i64::from_le_bytes(*b)).collect::<Vec<_>>();
    let floats = |name: &str| find(name).iter().map(|b| f64::from_le_bytes(*b)).collect::<Vec<_>>();
    // first the points of what was kept, then the faces
    assert_eq!(integers("face")[2999..], [-1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
    assert_eq!(integers("wall")[3000..], [1; 12]);
    let (numbers, masses) = (integers("number"), floats("mass"));
    assert_eq!(numbers.iter().sum::<i64>(), 3000);
    assert_eq!(integers("impacts"), numbers);
    let kept = summary.fates[crate::record::ParticleFate::Trapped as usize].mass.value();
    assert!((masses.iter().sum::<f64>() - kept).abs() < 1e-14 * kept);
    let (speeds, angles) = (floats("mean_impact_speed"), floats("mean_impact_angle"));
    for cell in 3000..3012 {
        let face = cell - 3000;
        if numbers[cell] == 0 {
            assert!(speeds[cell].is_nan());
            continue;
        }
        // the two of z = 30 mm and the two of y = 20 mm
        assert!([2, 3, 6, 7].contains(&face), "{face}");
        assert!((speeds[cell] - 5.0).abs() < 1e-9, "{}", speeds[cell]);
        let wanted = if face > 3 { f64::atan2(3.0, 4.0) } else { f64::atan2(4.0, 3.0) };
        assert!((angles[cell] - wanted.to_degrees()).abs() < 1e-6, "{} {wanted}", angles[cell]);
    }
    // 2e-9 · 5^2.6 · F(α) of the mass that hit; each size bin's masses add up to all
    let lost = floats("eroded_mass");
    let sizes = ["mass_below_100_um", "mass_100_to_150_um", "mass_from_150_um"].map(floats);
    assert!(lost[..3000].iter().all(|m| m.is_nan()) && sizes[0].iter().all(|m| *m == 0.0));
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
    for cell in 3000..3012 {
        let share = if cell - 3000 > 3 { 1.001_812_917_2 } else { 0.943_862_500_3 };
        let want = masses[cell] * 2e-9 * 5f64.powf(2.6) * share;
        assert!((lost[cell] - want).abs() <= 1e-6 * want, "{} {want}", lost[cell]);
        assert!(near(sizes[1][cell] + sizes[2][cell], masses[cell]));
    }
    let of_wall = summary.walls[1].eroded.as_ref().map(crate::exact_sum::ExactSum::value);
    assert!(summary.walls[0].eroded.is_none() && near(of_wall.unwrap(), lost[3000..].iter().sum()));
    let json: serde_json::Value = serde_json::from_slice(&fs::read(at("whole").join("summary.json")).unwrap()).unwrap();
    assert_eq!(json["walls"]["box"]["eroded_mass"].as_f64(), of_wall);
    assert!(json["walls"]["floor"].get("eroded_mass").is_none());
    let shown = crate::deposit_faces(&at("whole")).unwrap();
    assert!(shown.len() == 12 && shown.iter().all(|f| f.wall == 1));
    for (face, cell) in shown.iter().zip(3000..) {
        assert_eq!((face.mass, face.eroded, face.impacts as i64), (masses[cell], lost[cell], numbers[cell]));
    }
    assert_eq!(shown[0].corners.as_flattened(), &floats("points")[3 * 3000..3 * 3003]);
    // the corners are those of the file
    let corners = &floats("points")[3 * 3000..];
    assert!(corners.iter().all(|c| [0.0, 0.02, 0.03, 0.05].iter().any(|e| (c - e).abs() < 1e-8)));
    let parts: Vec<PathBuf> = (1..=3).map(|index| at(&format!("part-{index}"))).collect();
    for (index, out) in (1..).zip(&parts) {
        run(&case, &RunOptions { shard: Some(Shard { index, of: 3 }), ..options(out, 1) }, &Silent).unwrap();
    }
    merge(&parts, &at("merged"), false).unwrap();
    assert!(files(&at("whole")) == files(&at("merged")));
}

/// One of two spheres that slide along a floor leaves the table on it.
#[test]
fn spheres_that_slide_out_of_the_table_are_counted() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("flow.csv"), "x,u\n0,1\n1,1\n").unwrap();
    let sphere = |x: f64| {
        format!(
            "[[injection]]\ndensity = 1000\ndiameter = \"1 mm\"\nposition = [{x}, \"0.5 mm\", 0]\nvelocity = [1, -0.1, 0]\n"
        )
    };
    let text = format!(
        "[flow]\nkind = \"table\"\nfile = \"flow.csv\"\n[forces]\ngravity = [0, -9.81, 0]\ndrag = \"none\"\n\
         [[wall]]\nname = \"floor\"\nplane = {{ point = [0, 0, 0], normal = [0, 1, 0] }}\nlaw = \"ice\"\n\
         [law.ice]\nnormal = \"constant\"\nrestitution = 0\nfriction = 0\n{}{}[run]\nuntil = \"0.5 s\"\n",
        sphere(0.1),
        sphere(0.9),
    );
    let case = Case::from_toml(&text, &folder.path().join("case.toml"), Library::builtin()).unwrap();
    let summary = run(&case, &options(&folder.path().join("out"), 1), &Silent).unwrap();
    assert_eq!(summary.strayed, 1);
}

/// Of three spheres that follow 1 m/s in a table of 1 m, one leaves it in 0.5 s, and one begins outside.
#[test]
fn spheres_outside_the_table_are_counted() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("flow.csv"), "x,u\n0,1\n1,1\n").unwrap();
    let sphere = |x: f64| {
        format!("[[injection]]\ndensity = 1000\ndiameter = \"10 um\"\nposition = [{x}, 0, 0]\nvelocity = \"fluid\"\n")
    };
    let text = format!(
        "[flow]\nkind = \"table\"\nfile = \"flow.csv\"\n{}{}{}[run]\nuntil = \"0.5 s\"\n",
        sphere(0.2),
        sphere(0.7),
        sphere(1.5)
    );
    let case = Case::from_toml(&text, &folder.path().join("case.toml"), Library::builtin()).unwrap();
    let summary = run(&case, &options(&folder.path().join("out"), 1), &Silent).unwrap();
    assert_eq!(summary.strayed, 2);
    let json: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("out/summary.json")).unwrap()).unwrap();
    assert_eq!(json["outside_table"], 2);
}
