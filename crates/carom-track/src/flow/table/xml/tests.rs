use super::*;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use proptest::prelude::*;

/// Written by the vtk package: see tests/vtk/make.py.
macro_rules! file {
    ($name:literal) => {
        ($name, include_bytes!(concat!("../../../../tests/vtk/", $name)).as_slice())
    };
}

const FILES: [(&str, &[u8]); 9] = [
    file!("ascii.vtr"),
    // appended base64, zlib
    file!("default.vtr"),
    file!("inline.vtr"),
    file!("inline-zlib.vtr"),
    file!("raw.vtr"),
    file!("raw-zlib-blocks.vtr"),
    file!("base64.vtr"),
    file!("base64-zlib-big.vtr"),
    file!("lz4.vtr"),
];

#[test]
fn what_the_vtk_package_writes_in_every_form_is_read() {
    for (name, file) in FILES {
        let table = Table::from_file(name, file).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!((table.size(), table.bounds()), ([3, 2, 2], [[0.0, 0.0, -1.0], [1.5, 1.0, 0.0]]), "{name}");
        for (x, y, z) in [(0.0, 0.0, 0.0), (1.0, 0.5, -0.5), (1.25, 0.25, -0.75), (0.5, 1.0, -1.0)] {
            let local = table.sample([x, y, z]);
            let wanted = [1.0 + 2.0 * x + 3.0 * y - z, 0.25 * x * y, -z];
            assert!(
                local.velocity.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-14),
                "{name}: {:?}",
                local.velocity
            );
            assert_eq!((local.k, local.epsilon), (0.5 + x, 4.0 + y), "{name}");
        }
    }
}

#[test]
fn an_image_is_an_even_grid() {
    let (name, file) = file!("image.vti");
    let table = Table::from_file(name, file).unwrap();
    assert_eq!((table.size(), table.bounds()), ([3, 2, 2], [[0.0, 0.0, -1.0], [1.0, 1.0, 0.0]]));
    assert!(!table.is_turbulent());
    assert_eq!(table.velocity([1.0, 1.0, 0.0]), [1.0 + 2.0 * 1.5 + 3.0, 0.375, 0.0]);
}

#[test]
fn a_length_encoded_by_itself_is_read_too() {
    // as some writers other than VTK's have it
    let text = String::from_utf8(FILES[0].1.to_vec()).unwrap();
    let x = [0.0f64, 0.5, 1.5].iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<_>>();
    let blob = STANDARD.encode(24u32.to_le_bytes()) + &STANDARD.encode(x);
    let given = "format=\"ascii\" RangeMin=\"0\" RangeMax=\"1.5\">\n        0 0.5 1.5\n";
    assert!(text.contains(given));
    let table = Table::from_vtk_xml(text.replace(given, &format!("format=\"binary\">{blob}")).as_bytes()).unwrap();
    assert_eq!(table.bounds()[1][0], 1.5);
}

#[test]
fn errors_say_what() {
    let text = String::from_utf8(FILES[0].1.to_vec()).unwrap();
    let fails = |text: &str, want: &str| {
        let error = Table::from_vtk_xml(text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(want), "{error}");
    };
    fails("x,y\n", "VTK XML");
    fails(&text.replace("RectilinearGrid", "PolyData"), "not PolyData");
    fails(&text.replace("Piece Extent=\"0 2", "Piece Extent=\"0 999999999"), "does not fit the file");
    fails(&text.replace("Piece Extent=\"0 2", "Piece Extent=\"0 3"), "36 values where 48 are wanted");
    fails(&text.replace("0 0.5 1.5", "0 0.5 0.5"), "coordinates must rise");
    fails(&text.replace("0 0.5 1.5", "0 0.5 x"), "array \"x\": \"x\" is not a number");
    fails(&text.replace("0 0.5 1.5", "0 0.5 nan"), "NaN");
    fails(&text.replace("\"U\" NumberOfComponents=\"3\"", "\"U\" NumberOfComponents=\"2\""), "no vectors named");
    let lzma = String::from_utf8_lossy(FILES[1].1).replace("vtkZLibDataCompressor", "vtkLZMADataCompressor");
    fails(&lzma, "compressed by vtkLZMADataCompressor, which is not read: choose ZLib");
    let lz4 = String::from_utf8_lossy(FILES[1].1).replace("vtkZLibDataCompressor", "vtkLZ4DataCompressor");
    fails(&lz4, "LZ4: ");
}

/// An image of 5 x 2 x 2 nodes 1 m apart, with data of points or cells.
fn image(data: &str) -> Result<Table, TableError> {
    let text = format!(
        "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 4 0 1 0 1\" Origin=\"0 0 0\" Spacing=\"1 1 1\">\
         <Piece Extent=\"0 4 0 1 0 1\">{data}</Piece></ImageData></VTKFile>"
    );
    Table::from_vtk_xml(text.as_bytes())
}

fn array(name: &str, components: usize, values: &str) -> String {
    format!(
        "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">{values}</DataArray>"
    )
}

/// A rectilinear grid of 5 x 2 x 2 nodes in pieces of these extents; u is 1 + the square of a node's number along x.
fn in_pieces(pieces: &[(i64, i64)], change: impl Fn(usize, String) -> String) -> Result<Table, TableError> {
    let piece = |(n, &(a, b)): (usize, &(i64, i64))| {
        let row: String = (a..=b).map(|i| format!("{} 0 0 ", 1 + i * i)).collect();
        let x: String = (a..=b).map(|i| format!("{i} ")).collect();
        let axes = [array("x", 1, &x), array("y", 1, "0 1"), array("z", 1, "0 1")].concat();
        let data = array("U", 3, &row.repeat(4));
        change(
            n,
            format!(
                "<Piece Extent=\"{a} {b} 0 1 0 1\"><PointData>{data}</PointData><Coordinates>{axes}</Coordinates></Piece>"
            ),
        )
    };
    let pieces: String = pieces.iter().enumerate().map(piece).collect();
    let text = format!(
        "<VTKFile type=\"RectilinearGrid\"><RectilinearGrid WholeExtent=\"0 4 0 1 0 1\">{pieces}</RectilinearGrid></VTKFile>"
    );
    Table::from_vtk_xml(text.as_bytes())
}

#[test]
fn pieces_are_put_together() {
    let as_it_is = |_: usize, piece: String| piece;
    let whole = in_pieces(&[(0, 4)], as_it_is).unwrap();
    for pieces in [&[(0, 2), (2, 4)][..], &[(3, 4), (0, 3)], &[(0, 0), (1, 1), (2, 3), (2, 4)]] {
        let table = in_pieces(pieces, as_it_is).unwrap();
        assert_eq!((table.size(), table.bounds()), ([5, 2, 2], [[0.0; 3], [4.0, 1.0, 1.0]]));
        for x in [0.0, 0.5, 1.5, 2.0, 2.75, 4.0] {
            assert_eq!(table.velocity([x, 0.5, 0.5]), whole.velocity([x, 0.5, 0.5]), "{pieces:?} {x}");
        }
    }
    let fails = |pieces: &[(i64, i64)], change: &dyn Fn(usize, String) -> String, want: &str| {
        let error = in_pieces(pieces, change).expect_err(want).to_string();
        assert!(error.contains(want), "{error}");
    };
    fails(&[(0, 1), (3, 4), (3, 4)], &as_it_is, "leave out 4 of 20 nodes");
    fails(&[(0, 1), (3, 4)], &as_it_is, "16 nodes, fewer than the 20");
    fails(&[(0, 2), (2, 5)], &as_it_is, "lies outside the whole, 0 4 0 1 0 1");
    fails(&[(0, 4); 12], &as_it_is, "again and again");
    fails(&[], &as_it_is, "no Piece");
    let other = |n: usize, piece: String| if n == 1 { piece.replace("\"U\"", "\"V\"") } else { piece };
    fails(&[(0, 2), (2, 4)], &other, "different arrays");
    let moved = |n: usize, piece: String| if n == 1 { piece.replace(">2 3 4 <", ">2.5 3 4 <") } else { piece };
    fails(&[(0, 2), (2, 4)], &moved, "do not agree on the coordinates: 2 and 2.5");
}

#[test]
fn a_node_is_hidden_where_every_piece_hides_it() {
    // the cells from x = 2 to 3 are ghosts in the second piece; the node at 2 is seen from the first
    let ghosts = |n: usize, piece: String| {
        let mask = array("vtkGhostType", 1, "32 32");
        if n == 1 { piece.replace("</Piece>", &format!("<CellData>{mask}</CellData></Piece>")) } else { piece }
    };
    let table = in_pieces(&[(0, 2), (2, 4)], ghosts).unwrap();
    assert_eq!(table.velocity([2.0, 0.5, 0.5]), [5.0, 0.0, 0.0]);
    assert_eq!(table.velocity([4.0, 0.5, 0.5]), [5.0, 0.0, 0.0]);
    assert!(table.notes()[0].starts_with("8 of 20 nodes are not valid"), "{:?}", table.notes());
}

#[test]
fn what_is_not_valid_is_no_data() {
    let u = array("U", 3, &"1 0 0 1 0 0 0 0 0 1 0 0 1 0 0 ".repeat(4));
    for (name, valid, not) in [("vtkValidPointMask", 1, 0), ("vtkGhostType", 1, 2)] {
        let mask = array(name, 1, &format!("{valid} {valid} {not} {valid} {valid} ").repeat(4));
        let table = image(&format!("<PointData>{u}{mask}</PointData>")).unwrap();
        for x in [0.5, 1.5, 2.0, 2.5, 3.5] {
            assert_eq!(table.velocity([x, 0.5, 0.5]), [1.0, 0.0, 0.0], "{name} {x}");
        }
        assert!(table.notes()[0].starts_with("4 of 20 nodes are not valid"), "{:?}", table.notes());
    }
    let ghost = array("vtkGhostType", 1, "0 0 0 32");
    let u = array("U", 3, &"1 0 0 1 0 0 1 0 0 1 0 0 7 0 0 ".repeat(4));
    let table = image(&format!("<PointData>{u}</PointData><CellData>{ghost}</CellData>")).unwrap();
    assert_eq!(table.velocity([4.0, 0.5, 0.5]), [1.0, 0.0, 0.0]);
    let none = array("vtkValidPointMask", 1, &"0 ".repeat(20));
    assert!(image(&format!("<PointData>{u}{none}</PointData>")).unwrap_err().to_string().contains("no node is valid"));
}

#[test]
fn data_of_cells_hold_at_their_middles() {
    let u = array("U", 3, "1 0 0 2 0 0 3 0 0 4 0 0");
    let table = image(&format!("<PointData></PointData><CellData>{u}</CellData>")).unwrap();
    assert_eq!((table.size(), table.bounds()), ([6, 3, 3], [[0.0; 3], [4.0, 1.0, 1.0]]));
    assert_eq!(table.velocity([1.0, 0.9, 0.1]), [1.5, 0.0, 0.0]);
    assert!(table.notes()[0].contains("of cells"), "{:?}", table.notes());
}

#[test]
fn scalars_may_be_the_velocity() {
    let of = |name, v: &str| array(name, 1, &format!("{v} ").repeat(20));
    let data = [of("x-velocity", "1"), of("y-velocity", "2"), of("pressure", "5")].concat();
    let table = image(&format!("<PointData>{data}</PointData>")).unwrap();
    assert_eq!(table.velocity([1.0; 3]), [1.0, 2.0, 0.0]);
    assert_eq!(table.notes(), ["not used: pressure"]);
}

#[test]
fn what_promises_too_much_costs_little() {
    let many: String = (0..50_000).map(|i| format!(" a{i}=\"\"")).collect();
    let begin = std::time::Instant::now();
    let error = image(&format!("<PointData{many}></PointData>")).unwrap_err().to_string();
    assert!(error.contains("attributes"), "{error}");
    let error = image(&format!("<PointData>{}</PointData>", array("U", 3, &"x".repeat(1_000_000)))).unwrap_err();
    assert!(error.to_string().len() < 200, "{error}");
    assert!(begin.elapsed().as_secs_f64() < 5.0);
}

proptest! {
    #[test]
    fn bytes_never_panic(which in 0..FILES.len(), at in 0usize..4000, byte: u8, cut in 0usize..4000) {
        let mut file = FILES[which].1.to_vec();
        let n = file.len();
        file[at % n] = byte;
        let _ = Table::from_vtk_xml(&file);
        file.truncate(n - cut % n);
        let _ = Table::from_vtk_xml(&file);
    }
}
