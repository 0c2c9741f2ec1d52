use super::*;
use crate::geometry::triangles::COARSE;
use crate::testing::Chance;

fn read(bytes: &[u8]) -> Result<Triangles, TrianglesError> {
    crate::geometry::triangles::read("w.stl", bytes)
}

const FACET: &str =
    " facet normal 0 1 0\n  outer loop\n   vertex -1 0 -1\n   vertex -1 0 1\n   vertex 1 0 1\n  endloop\n endfacet\n";

fn text(name: &str, facets: usize) -> String {
    format!("solid{name}\n{}endsolid{name}\n", FACET.repeat(facets))
}

/// A binary file that announces `count` triangles and has `facets`, the first corner of the first at `x`.
fn bytes(header: &[u8], count: u32, facets: usize, x: f32) -> Vec<u8> {
    let mut out = header.to_vec();
    out.resize(80, b' ');
    out.extend(count.to_le_bytes());
    for i in 0..facets {
        let numbers = [0.0, 1.0, 0.0, if i == 0 { x } else { -1.0 }, 0.0, -1.0, -1.0, 0.0, 1.0, 1.0, 0.0, 1.0];
        numbers.iter().for_each(|n: &f32| out.extend(n.to_le_bytes()));
        out.extend([0, 0]);
    }
    out
}

fn names(stl: &Triangles) -> Vec<&str> {
    stl.solids.iter().map(|s| s.name.as_str()).collect()
}

#[test]
fn all_solids_are_read() {
    let two = text(" left", 2) + &text("", 1) + &text(" right wall", 3);
    let stl = read(two.as_bytes()).unwrap();
    assert_eq!((stl.triangles.len(), names(&stl)), (6, vec!["left", "", "right wall"]));
    assert_eq!(stl.solids[2].triangles, 3..6);
}

#[test]
fn what_programs_write_is_read() {
    let plain = text(" a", 1);
    let variants: Vec<Vec<u8>> = vec![
        text("", 1).into_bytes(),
        plain.to_uppercase().into_bytes(),
        format!("\u{feff}{plain}").into_bytes(),
        format!("\n \r\n{plain}").into_bytes(),
        plain.replace('\n', "\r\n").into_bytes(),
        plain.replace('\n', "\r").into_bytes(),
        plain.replace("0 1 0", "nan -nan inf").into_bytes(),
        plain.replace("normal 0 1 0", "normal").into_bytes(),
        plain.replace("vertex -1 0 -1", "vertex -1.0D+00 0 -1E0").into_bytes(),
        plain.trim_end().as_bytes().to_vec(),
        [b"solid M\xf6bius\n".as_slice(), FACET.as_bytes(), b"endsolid M\xf6bius"].concat(),
        bytes(b"", 1, 1, -1.0),
        bytes(b"solid x\nfacet binary after all", 1, 1, -1.0),
        bytes(b"COLOR=\0\0\0", 1, 1, -1.0),
    ];
    for v in variants {
        let stl = read(&v).unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&v)));
        assert_eq!(stl.triangles, [[[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 1.0]]]);
    }
    let named = [b"solid M\xf6bius\n".as_slice(), FACET.as_bytes(), b"endsolid"].concat();
    assert_eq!(names(&read(&named).unwrap()), ["Möbius"]);
}

#[test]
fn what_would_be_a_hole_is_refused() {
    let refused = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
    assert_eq!(refused(&bytes(b"", 2, 4, 0.0)), "its header counts 2 triangles, 184 bytes, but it has 284 bytes");
    assert_eq!(refused(&bytes(b"", 5, 4, 0.0)), "its header counts 5 triangles, 334 bytes, but it has 284 bytes");
    assert!(refused(&bytes(b"solid", 2, 4, 0.0)).contains("counts 2 triangles"));
    for bad in [f32::NAN, f32::INFINITY] {
        assert_eq!(refused(&bytes(b"", 3, 3, bad)), "triangle 1 has a corner that is not finite");
    }
    let plain = text(" a", 2);
    for bad in ["nan", "inf", "-Infinity", "1e999"] {
        let message = refused(plain.replacen("vertex -1 0 -1", &format!("vertex -1 {bad} -1"), 1).as_bytes());
        assert!(message.starts_with("line 4: a corner that is not finite"), "{message}");
    }
    assert!(refused(&plain.as_bytes()[..plain.len() - 12]).contains("ends before 'endsolid'"));
    assert!(
        refused(plain.replacen("vertex 1 0 1", "vertex 1 0,5 1", 1).as_bytes()).contains("line 6: expected a number")
    );
    let square = plain.replacen("  endloop", "   vertex 1 0 -1\n  endloop", 1);
    assert!(refused(square.as_bytes()).contains("line 7: expected 'endloop'"));
    assert_eq!(refused(b"solid\nendsolid\n"), "no triangles in it");
    assert!(refused(b"hello").starts_with("no STL"));
    assert!(refused(b"").starts_with("no STL"));
    let long = [b"solid\n".to_vec(), vec![b'x'; 1 << 20]].concat();
    assert!(refused(&long).len() < 120);
}

#[test]
fn the_digits_tell_the_precision() {
    let with =
        |x: &str| read(text("", 1).replace("vertex 1 0 1", &format!("vertex {x} 0 1")).as_bytes()).unwrap().precision;
    assert_eq!(with("0.5"), SINGLE);
    assert_eq!(with("0.10000000149011612"), SINGLE);
    assert_eq!(with("0.1"), COARSE);
    assert_eq!(with("0.123457"), COARSE);
    assert!((with("0.0123456789") / 5e-9 - 1.0).abs() < 1e-12);
    assert_eq!(with("0.12345678901234567"), 1e-15);
}

/// Files changed by chance are read whole or refused; the seed is printed.
#[test]
fn bytes_by_chance_never_panic() {
    let mut chance = Chance::seeded();
    let mut next = |below: usize| chance.below(below);
    let good = [text("a", 2).into_bytes(), bytes(b"solid", 2, 2, 1.0)];
    for n in 0..4_000 {
        let mut file = good[n % 2].clone();
        for _ in 0..=next(3) {
            let at = next(file.len());
            match next(3) {
                0 => file[at] = next(256) as u8,
                1 => file.insert(at, b"0.\n sef-"[next(8)]),
                _ => file.truncate(at.max(1)),
            }
        }
        if let Ok(stl) = read(&file) {
            assert!(stl.triangles.iter().flatten().flatten().all(|c| c.is_finite()));
        }
    }
}
