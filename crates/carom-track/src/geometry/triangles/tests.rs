use super::*;
use proptest::prelude::*;

/// A unit square in z = 0, of two triangles.
const SQUARE: [Triangle; 2] =
    [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]];

const OBJ: &str = "# made by hand\nmtllib a.mtl\no floor\nv 0 0 0\nv 1 0 0\nv 1 1 0 1.0\nv 0 1 0\nvn 0 0 1\nusemtl a\nf 1//1 2//1 3//1 4//1\n";

const PLY: &str = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                   property uchar red\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
                   0 0 0 9\n1 0 0 9\n1 1 0 9\n0 1 0 9\n4 0 1 2 3\n";

/// The same with doubles, binary.
fn binary_ply(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut out = format!(
        "ply\nformat binary_{order}_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n\
         element face 1\nproperty list uchar uint vertex_index\nelement edge 1\nproperty int a\nend_header\n"
    )
    .into_bytes();
    let eight = |x: f64| if big { x.to_be_bytes() } else { x.to_le_bytes() };
    let four = |i: u32| if big { i.to_be_bytes() } else { i.to_le_bytes() };
    [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.].iter().for_each(|x| out.extend(eight(*x)));
    out.push(4);
    [0, 1, 2, 3, 7].iter().for_each(|i| out.extend(four(*i)));
    out
}

#[test]
fn a_square_is_the_same_in_every_format() {
    let files: [(&str, Vec<u8>); 9] = [
        ("w.obj", OBJ.into()),
        ("W.OBJ", OBJ.replace('\n', "\r\n").into()),
        ("w.obj", OBJ.replace("1//1 2//1 3//1 4//1", "-4 -3/1 \\\n -2/1/1 -1").into()),
        ("w.obj", format!("\u{feff}{OBJ}").into()),
        ("w.ply", PLY.into()),
        ("w.ply", PLY.replace("float", "double").into()),
        ("w.ply", PLY.replace("1 1 0 9", "1.0e+00  1E0 -0.00e-5 9").into()),
        ("w.ply", binary_ply(true)),
        ("w.ply", binary_ply(false)),
    ];
    for (name, file) in files {
        let read = read(name, &file).unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&file)));
        assert_eq!(read.triangles, SQUARE, "{}", String::from_utf8_lossy(&file));
        assert_eq!(read.precision, SINGLE);
    }
}

#[test]
fn objects_and_groups_are_solids() {
    let two = format!("{OBJ}g\ng lid M\u{f6}bius \nf 1 2 3\ng empty\n");
    let latin: Vec<u8> = two.chars().map(|c| c as u8).collect();
    for file in [two.into_bytes(), latin] {
        let read = read("w.obj", &file).unwrap();
        let solids: Vec<_> = read.solids.iter().map(|s| (s.name.as_str(), s.triangles.clone())).collect();
        assert_eq!(solids, [("floor", 0..2), ("lid Möbius", 2..3)]);
    }
}

#[test]
fn what_would_be_a_hole_is_refused() {
    let fails = |name: &str, file: &[u8], want: &str| {
        let error = read(name, file).expect_err(want).to_string();
        assert!(error.contains(want) && error.len() < 200, "{error} lacks {want}");
    };
    let obj = |from: &str, to: &str, want: &str| {
        assert!(OBJ.contains(from));
        fails("w.obj", OBJ.replace(from, to).as_bytes(), want);
    };
    obj("f 1//1", "f 9//1", "line 10: vertex 9 of 4");
    obj("f 1//1", "f -5", "line 10: vertex -5 of 4");
    obj("f 1//1", "f 0", "line 10: expected a vertex's number, not '0'");
    obj("f 1//1 2//1 3//1 4//1", "f 1 2", "line 10: a face of 2 corners");
    obj("f 1//1 2//1 3//1 4//1", "f 1 3 2 4", "not convex");
    obj("f 1//1 2//1 3//1 4//1", "surf 0 1 0 1 1 2 3 4", "line 10: a free-form");
    obj("f 1//1 2//1 3//1 4//1", "l 1 2", "no triangles");
    obj("v 1 0 0", "v 1 nan 0", "line 5: a corner that is not finite");
    obj("v 1 0 0", "v 1 0", "line 5: a vertex has three");
    obj("v 1 0 0", &format!("v 1 0 {}", "y".repeat(100_000)), "line 5: expected a number");
    obj("v 1 0 0", "vertex 1 0 0", "line 5: 'vertex' begins no line");
    let ply = |from: &str, to: &str, want: &str| {
        assert!(PLY.contains(from));
        fails("w.ply", PLY.replace(from, to).as_bytes(), want);
    };
    ply("4 0 1 2 3", "4 0 1 2 4", "face 1 names a vertex that is not there");
    ply("4 0 1 2 3", "4 0 1 2 -1", "face 1 names a vertex that is not there");
    ply("4 0 1 2 3", "4 0 2 1 3", "face 1 is not convex");
    ply("4 0 1 2 3", "2 0 1", "face 1 has 2 corners");
    ply("4 0 1 2 3\n", "", "not element \"face\"");
    ply("1 1 0 9", "1 nan 0 9", "line 14: not element \"vertex\" as the header describes it");
    ply("1 1 0 9", &format!("1 {} 0 9", "y".repeat(100_000)), "line 14: not element \"vertex\"");
    ply("property float z\n", "property float w\n", "not finite");
    ply("vertex 4", "vertex 999999999999", "its header counts 999999999999");
    ply("element face", "element tristrips", "strips");
    ply("ply\n", "plx\n", "line 1: no header");
    let mut short = binary_ply(false);
    short.truncate(short.len() - 1);
    fails("w.ply", &short, "not element \"edge\"");
}

#[test]
fn a_convex_polygon_is_covered_whole() {
    let corner = |i: usize, n: usize| {
        let angle = std::f64::consts::TAU * i as f64 / n as f64;
        [angle.cos(), angle.sin(), 0.25]
    };
    for n in 3..30 {
        let corners: Vec<[f64; 3]> = (0..n).map(|i| corner(i, n)).collect();
        let area: f64 = fan(&corners)
            .unwrap()
            .map(|[a, b, c]| 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])))
            .sum();
        let exact = 0.5 * n as f64 * (std::f64::consts::TAU / n as f64).sin();
        assert!((area / exact - 1.0).abs() < 1e-12, "{n}: {area} {exact}");
    }
    // an L, whichever corner comes first: only from the inner corner does a fan stay within
    let l = [[0., 0., 0.], [2., 0., 0.], [2., 1., 0.], [1., 1., 0.], [1., 2., 0.], [0., 2., 0.]];
    let fits: Vec<bool> = (0..6).map(|k| fan(&[&l[k..], &l[..k]].concat()).is_some()).collect();
    assert_eq!(fits, [true, false, false, true, false, false]);
}

proptest! {
    #[test]
    fn bytes_never_panic(which in 0..3usize, at in 0usize..400, byte: u8, cut in 0usize..400) {
        let mut file = [OBJ.as_bytes().to_vec(), PLY.as_bytes().to_vec(), binary_ply(false)][which].clone();
        let n = file.len();
        file[at % n] = byte;
        let ending = ["w.obj", "w.ply", "w.ply"][which];
        let _ = read(ending, &file);
        file.truncate(n - cut % n);
        let _ = read(ending, &file);
    }
}
