//! Meshes that are not as they should be.

use super::*;

/// A grid in XML: points, cells by kind and corners, and further arrays of points and cells.
fn xml(points: &[[f64; 3]], cells: &[(u8, &[u32])], data: [&str; 2]) -> String {
    let number = |n: &[u32]| n.iter().map(|n| format!("{n} ")).collect::<String>();
    let at: String = points.iter().flatten().map(|x| format!("{x} ")).collect();
    let corners: String = cells.iter().map(|c| number(c.1)).collect();
    let mut ends = Vec::new();
    cells.iter().for_each(|c| ends.push(ends.last().unwrap_or(&0) + c.1.len() as u32));
    let kinds: String = cells.iter().map(|c| format!("{} ", c.0)).collect();
    let u = "1 0 0 ".repeat(points.len());
    format!(
        "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>\
         <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\
         <PointData><DataArray type=\"Float64\" Name=\"U\" NumberOfComponents=\"3\">{u}</DataArray>{}</PointData>\
         <CellData>{}</CellData>\
         <Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">{at}</DataArray></Points>\
         <Cells><DataArray type=\"Int64\" Name=\"connectivity\">{corners}</DataArray>\
         <DataArray type=\"Int64\" Name=\"offsets\">{}</DataArray>\
         <DataArray type=\"UInt8\" Name=\"types\">{kinds}</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>",
        points.len(),
        cells.len(),
        data[0],
        data[1],
        number(&ends)
    )
}

fn given(text: &str) -> Result<Snapshot, String> {
    from_bytes(text.as_bytes().to_vec(), &Options::default()).map_err(|e| e.to_string())
}

fn fails(text: &str, want: &str) {
    let error = given(text).expect_err(want);
    assert!(error.contains(want), "{error}");
}

/// The corners of a brick from `low` to `high`, as VTK's hexahedron has them.
fn brick(low: [f64; 3], high: [f64; 3]) -> [[f64; 3]; 8] {
    let c = |n: usize, i: usize| if n >> i & 1 == 1 { high[i] } else { low[i] };
    [0, 1, 3, 2, 4, 5, 7, 6].map(|n| [c(n, 0), c(n, 1), c(n, 2)])
}

const UNIT: [f64; 3] = [1.0; 3];
const ALL: [u32; 8] = [0, 1, 2, 3, 4, 5, 6, 7];

#[test]
fn a_face_of_three_cells_is_refused_with_them() {
    let mut points = brick([0.0; 3], UNIT).to_vec();
    // three tetrahedra on the same triangle
    points.extend([[0.3, 0.3, 2.0], [0.3, 0.3, 3.0]]);
    let cells: [(u8, &[u32]); 3] = [(10, &[0, 1, 2, 6]), (10, &[0, 1, 2, 8]), (10, &[0, 1, 2, 9])];
    fails(&xml(&points, &cells, [""; 2]), "cells 0, 1 and 2 have one face in common");
    let twice: [(u8, &[u32]); 2] = [(10, &[0, 1, 2, 6]), (10, &[0, 1, 2, 8])];
    fails(&xml(&points, &twice, [""; 2]), "cells 0 and 1 lie on the same side of their common face: they overlap");
    let crossed: [(u8, &[u32]); 2] = [(12, &ALL), (14, &[4, 6, 5, 7, 8])];
    fails(&xml(&points, &crossed, [""; 2]), "list the corners of their common face in orders that do not fit");
}

#[test]
fn cells_inside_out_are_turned_and_told() {
    let points = brick([0.0; 3], UNIT);
    let turned: [(u8, &[u32]); 1] = [(12, &[4, 5, 6, 7, 0, 1, 2, 3])];
    let snapshot = given(&xml(&points, &turned, [""; 2])).unwrap();
    assert_eq!(snapshot.notes, ["1 cells list their corners inside out: they are turned"]);
    has_volumes("turned", &snapshot.mesh, &[1.0]);
    // wedges come either way
    for order in [[0, 1, 3, 4, 5, 7], [0, 3, 1, 4, 7, 5]] {
        let snapshot = given(&xml(&points, &[(13, &order)], [""; 2])).unwrap();
        assert_eq!(snapshot.notes, Vec::<String>::new());
        has_volumes("wedge", &snapshot.mesh, &[0.5]);
    }
}

#[test]
fn a_cell_folded_through_a_neighbour_is_named_and_kept() {
    // five bricks in a row, one of which is pushed through the next: its volume is negative
    let x = [0.0, 1.0, 2.2, 2.0, 3.0, 4.0];
    let points: Vec<[f64; 3]> =
        x.iter().flat_map(|x| [[*x, 0., 0.], [*x, 1., 0.], [*x, 1., 1.], [*x, 0., 1.]]).collect();
    let cells: Vec<Vec<u32>> = (0..5).map(|c| [0, 4, 5, 1, 3, 7, 6, 2].map(|i| c * 4 + i).to_vec()).collect();
    let cells: Vec<(u8, &[u32])> = cells.iter().map(|c| (12, c.as_slice())).collect();
    let snapshot = given(&xml(&points, &cells, [""; 2])).unwrap();
    assert!(snapshot.notes.contains(&"1 cells have negative volumes: 2".to_owned()), "{:?}", snapshot.notes);
    has_volumes("folded", &snapshot.mesh, &[1.0, 1.2, -0.2, 1.0, 1.0]);
}

#[test]
fn hexahedra_with_corners_that_fall_together_are_what_is_left() {
    let points = brick([0.0; 3], UNIT);
    let wedge: [(u8, &[u32]); 1] = [(12, &[0, 1, 2, 2, 4, 5, 6, 6])];
    let snapshot = given(&xml(&points, &wedge, [""; 2])).unwrap();
    assert_eq!((snapshot.mesh.faces.len(), snapshot.mesh.points.len()), (5, 6));
    has_volumes("wedge", &snapshot.mesh, &[0.5]);
}

#[test]
fn polyhedra_are_turned_face_by_face_and_open_ones_refused() {
    let points = brick([0.0; 3], UNIT);
    let faces: [[u32; 4]; 6] = [[0, 3, 7, 4], [1, 2, 6, 5], [0, 1, 5, 4], [3, 2, 6, 7], [0, 1, 2, 3], [4, 5, 6, 7]];
    let file = |faces: &[[u32; 4]], turn: usize| {
        let mut list = faces.len().to_string();
        for (i, face) in faces.iter().enumerate() {
            let mut face = *face;
            if turn >> i & 1 == 1 {
                face.reverse();
            }
            list += &format!(" 4 {} {} {} {}", face[0], face[1], face[2], face[3]);
        }
        let end = list.split(' ').count();
        xml(&points, &[(42, &ALL)], [""; 2]).replace(
            "</Cells>",
            &format!(
                "<DataArray type=\"Int64\" Name=\"faces\">{list}</DataArray><DataArray type=\"Int64\" Name=\"faceoffsets\">{end}</DataArray></Cells>"
            ),
        )
    };
    for turn in 0..64 {
        let snapshot = given(&file(&faces, turn)).unwrap();
        has_volumes("polyhedron", &snapshot.mesh, &[1.0]);
        assert_eq!(snapshot.notes, Vec::<String>::new());
    }
    fails(&file(&faces[..5], 0), "cell 0: the edge between points 4 and 5 has 1 of its faces: it is open");
    fails(&file(&[faces[0], faces[1], faces[2], faces[3], faces[4], faces[4], faces[5]], 0), "has 3 of its faces");
    fails(&file(&faces, 0).replace(" 4 4 5 6 7", " 5 4 5 6 7"), "the faces of cell 0 do not fit their list");
    fails(
        &file(&faces, 0).replace(" 4 4 5 6 7", " 4 4 5 6 8"),
        "number 5 of faces has a point that is not there; there are 8",
    );
}

#[test]
fn values_and_places_that_are_none_are_named() {
    let points = brick([0.0; 3], UNIT);
    let cells: [(u8, &[u32]); 1] = [(12, &ALL)];
    let plain = xml(&points, &cells, [""; 2]);
    given(&plain).unwrap();
    fails(&plain.replacen("1 0 0 1 0 0 ", "1 0 0 1 nan 0 ", 1), "\"U\" is NaN in point 1: NaN or infinity is no value");
    let mut bad = points;
    bad[3][1] = f64::INFINITY;
    fails(&xml(&bad, &cells, [""; 2]), "point 3 is no place");
    let mask = |of: usize, name: &str, values: &str| {
        let array = format!("<DataArray type=\"UInt8\" Name=\"{name}\">{values}</DataArray>");
        let mut data = [""; 2];
        data[of] = &array;
        xml(&points, &cells, data)
    };
    fails(&mask(0, "vtkValidPointMask", "1 1 1 1 1 0 1 1"), "point 5 is hidden or not valid (vtkValidPointMask)");
    fails(&mask(0, "vtkGhostType", "0 1 0 2 0 0 0 0"), "point 3 is hidden");
    fails(&mask(1, "vtkGhostType", "32"), "cell 0 is hidden");
    fails(&mask(1, "vtkGhostType", "1"), "no cells but 1 copies of another piece's");
    fails(
        &xml(&points, &[(12, &[0, 1, 2, 3, 4, 5, 6])], [""; 2]),
        "cell 0 is a hexahedron (VTK's kind 12) of 7 points",
    );
    fails(&xml(&points, &[(41, &ALL)], [""; 2]), "cell 0 is of VTK's kind 41, which is not read");
    fails(
        &xml(&points, &[(12, &[0, 1, 2, 3, 4, 5, 6, 8])], [""; 2]),
        "number 0 of cells has a point that is not there",
    );
    fails(&xml(&points, &[(9, &[0, 3, 7, 4])], [""; 2]), "1 polygons and no solid cells");
    fails(&plain.replace("\"8\" NumberOfCells", "\"9\" NumberOfCells"), "values where 27 are wanted");
    fails(&plain.replace("NumberOfCells=\"1\"", "NumberOfCells=\"99999999999\""), "does not fit the file");
    fails(&plain.replace("UnstructuredGrid", "StructuredGrid"), "make an unstructured grid of it first");
    fails("x,y,u\n", "not a VTK file");
}

#[test]
fn what_no_cell_is_made_of_may_have_no_value() {
    let mut places = brick([0.0; 3], UNIT).to_vec();
    places.extend([[5.0; 3], [f64::NAN; 3]]);
    let cells: [(u8, &[u32]); 3] = [(12, &ALL), (9, &[0, 3, 2, 1]), (3, &[0, 8])];
    let t = "<DataArray type=\"Float64\" Name=\"T\">300 nan nan</DataArray>";
    let text = xml(&places, &cells, ["", t]);
    let unused = text.replacen("1 0 0 </DataArray>", "nan 0 0 </DataArray>", 1);
    for text in [&text, &unused] {
        let snapshot = given(text).unwrap();
        assert_eq!((snapshot.mesh.points.len(), points(&snapshot.fields.velocity)), (8, &[[1.0, 0.0, 0.0]; 8][..]));
        assert_eq!(cells_of(&snapshot), [300.0]);
    }
    // a polygon without a value is as one of no file
    let told = from_bytes(
        text.replace("<CellData>", "<CellData><DataArray type=\"Int32\" Name=\"zone\">0 7 0</DataArray>").into_bytes(),
        &told(Some("zone")),
    );
    let notes = told.unwrap().notes;
    assert!(notes.iter().any(|n| n.contains("gives it no values on 7, boundary")), "{notes:?}");
    fails(&text.replace("300 nan", "nan 300"), "\"T\" is NaN in cell 0");
    fails(&xml(&places, &[(12, &ALL), (5, &[0, 1, 9])], [""; 2]), "point 9 is no place");
}

fn cells_of(snapshot: &Snapshot) -> Vec<f64> {
    cells(&snapshot.fields.temperature).0.as_flattened().to_vec()
}

#[test]
fn what_only_ghosts_have_may_be_no_value() {
    // two bricks in each of two pieces, one of which is the other piece's
    let row = [brick([0.0; 3], UNIT), brick([1.0, 0.0, 0.0], [2.0, 1.0, 1.0])].concat();
    let other: Vec<u32> = ALL.iter().map(|i| i + 8).collect();
    let file = |ghost: usize| {
        let of = |values: [&str; 2]| if ghost == 0 { values.join(" ") } else { [values[1], values[0]].join(" ") };
        let ghosts = format!("<DataArray type=\"UInt8\" Name=\"vtkGhostType\">{}</DataArray>", of(["1", "0"]));
        let t = format!("<DataArray type=\"Float64\" Name=\"T\">{}</DataArray>", of(["nan", "300"]));
        let p = of([&"inf ".repeat(8), &"7 ".repeat(8)]);
        let p = format!("<DataArray type=\"Float64\" Name=\"p\">{p}</DataArray>");
        let text = xml(&row, &[(12, &ALL), (12, &other)], [&p, &format!("{ghosts}{t}")]);
        text.split_once("<UnstructuredGrid>").unwrap().1.split_once("</UnstructuredGrid>").unwrap().0.to_owned()
    };
    let body = [file(0), file(1)].concat();
    let text = format!("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>{body}</UnstructuredGrid></VTKFile>");
    let snapshot = given(&text).unwrap();
    assert_eq!((cells_of(&snapshot), points(&snapshot.fields.pressure)), (vec![300.0; 2], &[[7.0]; 12][..]));
    assert!(!snapshot.notes.iter().any(|n| n.contains("differ")), "{:?}", snapshot.notes);
}

#[test]
fn base64_may_be_broken_into_lines() {
    for name in ["inline.vtu", "inline-zlib.vtu"] {
        let text = std::fs::read_to_string(path(name)).unwrap();
        let wrap = |line: &str| if line.contains('<') { format!("{line}\n") } else { broken_up(line) };
        let wrapped: String = text.lines().map(wrap).collect();
        assert!(wrapped.len() > text.len() + 100, "{name}");
        let (found, wanted) = (given(&wrapped).unwrap(), get(name));
        assert_eq!((found.mesh.points, found.fields.velocity), (wanted.mesh.points, wanted.fields.velocity), "{name}");
    }
}

/// A line in lines of 30 characters.
fn broken_up(line: &str) -> String {
    line.as_bytes().chunks(30).map(|part| format!("  {}\r\n", String::from_utf8_lossy(part))).collect()
}

#[test]
fn a_compressor_that_is_not_read_does_not_matter_to_ascii() {
    let named = |name: &str| {
        let text = std::fs::read_to_string(path(name)).unwrap();
        let text = text.replace(" compressor=\"vtkZLibDataCompressor\"", "");
        given(&text.replacen("<VTKFile ", "<VTKFile compressor=\"vtkLZMADataCompressor\" ", 1))
    };
    assert_eq!(named("ascii.vtu").unwrap().fields, get("ascii.vtu").fields);
    let refused = named("inline-zlib.vtu").unwrap_err();
    assert!(refused.contains("compressed by vtkLZMADataCompressor, which is not read"), "{refused}");
}

#[test]
fn thin_walls_keep_their_sides() {
    // two bricks with points of their own where they touch, and a polygon for each side
    let mut points = brick([0.0; 3], UNIT).to_vec();
    points.extend(brick([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]));
    let other: Vec<u32> = ALL.iter().map(|i| i + 8).collect();
    let cells: [(u8, &[u32]); 4] = [(12, &ALL), (12, &other), (9, &[8, 12, 15, 11]), (9, &[1, 2, 6, 5])];
    let zone = "<DataArray type=\"Int32\" Name=\"zone\">0 0 20 10</DataArray>";
    let text = xml(&points, &cells, ["", zone]);
    let snapshot = from_bytes(text.into_bytes(), &told(Some("zone"))).unwrap();
    let mesh = &snapshot.mesh;
    assert_eq!((mesh.inner_faces(), patches(mesh)), (0, vec![("20", 1), ("10", 1), ("boundary", 10)]));
    // each side is its own cell's, whose outside the polygon faced
    assert_eq!((mesh.owner[mesh.patches[0].faces.start], mesh.owner[mesh.patches[1].faces.start]), (1, 0));
}

#[test]
fn bytes_by_chance_never_panic() {
    use proptest::prelude::*;
    let files = [
        "ascii.vtu",
        "raw-zlib-blocks.vtu",
        "lz4.vtu",
        "inline-zlib.vtu",
        "ascii-51.vtk",
        "binary-42.vtk",
        "sides.vtu",
    ];
    let files: Vec<Vec<u8>> = files.iter().map(|f| std::fs::read(path(f)).unwrap()).collect();
    let change =
        (0..files.len(), prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6), any::<bool>());
    proptest!(ProptestConfig::with_cases(400), |((which, changes, cut) in change)| {
        let mut bytes = files[which].clone();
        for (place, byte) in &changes {
            let place = place.index(bytes.len());
            bytes[place] = *byte;
        }
        if cut {
            bytes.truncate(changes[0].0.index(bytes.len()));
        }
        let _ = from_bytes(bytes, &told(Some("zone")));
    });
}
