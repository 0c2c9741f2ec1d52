use super::*;
use crate::testing::Chance;

fn of(text: &str) -> Result<Table, TableError> {
    Table::from_csv(text.as_bytes())
}

/// u = 1 + y at the corners of a square of 1 m.
#[test]
fn tables_of_other_programs() {
    let rows = "0,0,0,1,0,0\n1,0,0,1,0,0\n0,1,0,2,0,0\n1,1,0,2,0,0\n";
    let numbered: String = rows.lines().enumerate().map(|(i, l)| format!("{},{l},0.5\n", i + 1)).collect();
    let blanks = rows.replace(',', "   ");
    let german = rows.replace(',', ";").replace(";1;", ";1,0;");
    let mm = "0,0,0,1000,0,0\n1000,0,0,1000,0,0\n0,1000,0,2000,0,0\n1000,1000,0,2000,0,0\n";
    for (program, text) in [
        ("ParaView", format!("\"Points:0\",\"Points:1\",\"Points:2\",\"U:0\",\"U:1\",\"U:2\"\n{rows}")),
        (
            "ParaView 5.10",
            format!("\"Points_0\",\"Points_1\",\"Points_2\",\"Velocity_0\",\"Velocity_1\",\"Velocity_2\"\n{rows}"),
        ),
        (
            "Fluent",
            format!(
                "nodenumber,    x-coordinate,    y-coordinate,    z-coordinate,      x-velocity,      y-velocity,      z-velocity, pressure\n{numbered}"
            ),
        ),
        (
            "Fluent, blanks",
            format!("   x-coordinate    y-coordinate  z-coordinate    x-velocity  y-velocity z-velocity\n{blanks}"),
        ),
        (
            "CFD-Post",
            format!(
                "[Name]\nPlane 1\n\n[Data]\nX [ m ], Y [ m ], Z [ m ], Velocity u [ m s^-1 ], Velocity v [ m s^-1 ], Velocity w [ m s^-1 ]\n{rows}\n[Faces]\n0, 1, 3, 2\n"
            ),
        ),
        (
            "STAR-CCM+",
            format!(
                "\"X (m)\",\"Y (m)\",\"Z (m)\",\"Velocity[i] (m/s)\",\"Velocity[j] (m/s)\",\"Velocity[k] (m/s)\"\n{rows}"
            ),
        ),
        (
            "COMSOL",
            format!(
                "% Model:              a.mph\n% Dimension:          3\n% Nodes:              4\n% Expressions:        3\n% Description:        Velocity field\n% Length unit:        m\n% x                       y                        z    u (m/s)                  v (m/s)   w (m/s)\n{blanks}"
            ),
        ),
        ("COMSOL in mm", format!("% Length unit:        mm\n% x,y,z,u (mm/s),v (mm/s),w (mm/s)\n{mm}")),
        ("OpenFOAM", format!("x,y,z,U_0,U_1,U_2\n{rows}")),
        ("OpenFOAM, raw", format!("# U  POINT_DATA 4\n#  x  y  z  U_x  U_y  U_z\n{blanks}")),
        ("Excel", format!("sep=;\nX [m];Y [m];Z [m];U [m/s];V [m/s];W [m/s]\n{german}")),
        ("millimetres", format!("x (mm),y (mm),z (mm),u (mm/s),v (mm/s),w (mm/s)\n{mm}")),
        ("tabs", format!("X\tY\tZ\tU\tV\tW\n{}", rows.replace(',', "\t"))),
    ] {
        let table = of(&text).unwrap_or_else(|e| panic!("{program}: {e}"));
        assert_eq!(table.bounds(), [[0.0; 3], [1.0, 1.0, 0.0]], "{program}");
        assert_eq!(table.velocity([0.25, 0.5, 0.0]), [1.5, 0.0, 0.0], "{program}");
    }
}

#[test]
fn columns_by_the_names_a_case_gives() {
    let named: Named =
        [("x", "Lage [mm]"), ("u", "UMean_0")].map(|(a, b)| (a.to_owned(), b.to_owned())).into_iter().collect();
    let text = "Lage;UMean_0;UPrime_0\n0;1;9\n1000;3;9\n";
    let table = Table::from_named("f.csv", text.as_bytes(), &named).expect("a table");
    assert_eq!(table.velocity([0.5, 0.0, 0.0]), [2.0, 0.0, 0.0]);
    assert_eq!(table.notes(), ["not used: UPrime_0"]);
    let error = Table::from_named("f.csv", b"pos,UMean_0\n0,1\n", &named).expect_err("no such column").to_string();
    assert!(error.contains("no column \"Lage [mm]\"; there are \"pos\", \"UMean_0\""), "{error}");
    let error = Table::from_named("f.csv", b"Lage [cm],UMean_0\n0,1\n", &named).expect_err("two units").to_string();
    assert!(error.contains("gives the unit \"mm\""), "{error}");
}

#[test]
fn turbulence_by_dissipation_or_frequency() {
    let table =
        of("x,u,Turbulent Kinetic Energy (J/kg),Turbulent Dissipation Rate (J/kg-s)\n0,1,2,3\n1,1,2,3\n").unwrap();
    let local = table.sample([0.5, 0.0, 0.0]);
    assert_eq!((local.k, local.epsilon, table.is_turbulent()), (2.0, 3.0, true));
    let table = of("x,u,turb-kinetic-energy,specific-diss-rate\n0,1,2,100\n1,1,2,100\n").unwrap();
    assert!((table.sample([0.5, 0.0, 0.0]).epsilon - 18.0).abs() < 1e-12);
    let table = of("x,u,k\n0,1,1\n1,1,1\n").unwrap();
    assert!(!table.is_turbulent());
    assert!(table.notes()[0].contains("turbulence is left out"), "{:?}", table.notes());
}

#[test]
fn rows_outside_the_mask_are_no_data() {
    let table = of("Points:0,U:0,vtkValidPointMask\n0,1,1\n1,nan,0\n2,3,1\n").unwrap();
    assert_eq!(table.velocity([1.0, 0.0, 0.0]), [2.0, 0.0, 0.0]);
    assert!(table.notes()[0].starts_with("1 of 3 nodes"), "{:?}", table.notes());
}

#[test]
fn digits_that_differ_in_the_last_place_are_one_node() {
    let table = of("x,y,u\n0,0.1,1\n1,0.10000000000001,1\n0,0.3,1\n1,0.3,2\n").unwrap();
    assert_eq!(table.size(), [2, 2, 1]);
}

#[test]
fn errors_name_the_place() {
    let fails = |text: &str, want: &str| {
        let error = of(text).unwrap_err().to_string();
        assert!(error.contains(want), "{error}");
    };
    fails("x,u\n0,1\n1,abc\n", "line 3: column \"u\": \"abc\"");
    fails("x,u\n0,1\n#N/A,1\n", "line 3: column \"x\": \"#N/A\" is not a finite number");
    fails("x,u\n0,1\n1,null\n", "line 3: column \"u\": \"null\"");
    fails("x,u\n0,1\n1,inf\n", "line 3");
    fails("x,u\n0,1\n1,\n", "line 3, column \"u\": nothing stands there");
    fails("x,u\n0,1\n0,2\n", "line 3: the node (0, 0, 0) was given before, in line 2");
    fails("x,y,u\n0,0,1\n1,0,1\n0,1,1\n", "no row for the node (1, 1, 0) of the 2 x 2 x 1 grid");
    fails("x,speed\n0,1\n", "no column of u, the velocity along x, among \"x\", \"speed\"");
    fails("x,u,u\n0,1,1\n", "u may be \"u\" or \"u\"");
    fails("x,u,x-velocity\n0,1,1\n", "u may be \"u\" or \"x-velocity\"; say which: columns = { u = \"u\" }");
    fails("x,v\n0,1\n", "no column of u");
    fails("x [s],u\n0,1\n", "column \"x [s]\"");
    fails("x,u,k,epsilon\n0,1,-1,0\n", "k is -1");
    fails("x,u\n", "no rows");
    fails("", "nothing in it");
    fails("x,u\n0\n", "flow table, line 2: 1 values under 2 columns");
    // a scatter of points is no grid; it is refused without building one
    let scatter: String = (0..300).map(|i| format!("{i},{},{},1\n", i * 7, i * 11)).collect();
    fails(&format!("x,y,z,u\n{scatter}"), "no row for the node");
    let error = Table::from_file("duct.vtu", b"<?xml").unwrap_err().to_string();
    assert!(error.contains("Resample To Image"), "{error}");
}

/// Tables changed by chance are read or refused; the seed is printed.
#[test]
fn bytes_by_chance_never_panic() {
    let mut chance = Chance::seeded();
    let mut next = |below: usize| chance.below(below);
    let good = "[Name]\nA\n\n[Data]\nX [ mm ], Y [ m ], Velocity u [ m s^-1 ], vtkValidPointMask, k, omega\n0,0,1,1,1,2\n1,0,1,0,1,2\n0,1,2,1,1,2\n1,1,2,1,1,2\n";
    let parts = [",", ";", "\n", "\"", "#N/A", "nan", "1e308", "-", "[", "u", "x", "\u{0}", "1e-320", "%"];
    for _ in 0..2_000 {
        let mut bytes = good.as_bytes().to_vec();
        for _ in 0..=next(4) {
            let at = next(bytes.len());
            match next(3) {
                0 => bytes[at] = next(256) as u8,
                1 => drop(bytes.splice(at..at, parts[next(parts.len())].bytes())),
                _ => drop(bytes.drain(at..(at + next(8)).min(bytes.len()))),
            }
        }
        if let Ok(table) = Table::from_file("f.csv", &bytes) {
            let _ = (table.velocity([0.5; 3]), table.notes().len());
        }
    }
}
