use super::*;
use proptest::prelude::*;

/// Written by the vtk package: see tests/vtk/make.py.
macro_rules! file {
    ($name:literal) => {
        ($name, include_bytes!(concat!("../../../../tests/vtk/", $name)).as_slice())
    };
}

const FILES: [(&str, &[u8]); 8] = [
    file!("ascii.vtr"),
    // appended base64, zlib
    file!("default.vtr"),
    file!("inline.vtr"),
    file!("inline-zlib.vtr"),
    file!("raw.vtr"),
    file!("raw-zlib-blocks.vtr"),
    file!("base64.vtr"),
    file!("base64-zlib-big.vtr"),
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
    fails(&text.replace("Piece Extent=\"0 2", "Piece Extent=\"0 3"), "3 values where 4 are wanted");
    fails(&text.replace("0 0.5 1.5", "0 0.5 0.5"), "coordinates must rise");
    fails(&text.replace("0 0.5 1.5", "0 0.5 x"), "array \"x\": \"x\" is not a number");
    fails(&text.replace("0 0.5 1.5", "0 0.5 nan"), "NaN");
    fails(&text.replace("\"epsilon\"", "\"dissipation\""), "k and epsilon must both");
    fails(&text.replace("\"U\" NumberOfComponents=\"3\"", "\"U\" NumberOfComponents=\"2\""), "no point vectors");
    let (_, lz4) = file!("lz4.vtr");
    fails(&String::from_utf8_lossy(lz4), "compressed by vtkLZ4DataCompressor; save it with ZLib");
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
