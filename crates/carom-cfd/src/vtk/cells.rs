//! Kinds of cells, by VTK's numbers ([vtkCellType.h](https://vtk.org/doc/nightly/html/vtkCellType_8h.html)), and the faces of solid ones.

/// Two points, and straight from point to point.
pub(super) const LINE: u8 = 3;
pub(super) const POLYLINE: u8 = 4;
/// Any number of corners, and any number of faces.
pub(super) const POLYGON: u8 = 7;
pub(super) const POLYHEDRON: u8 = 42;

/// What a cell is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// A point or a line, or nothing: of no use here.
    Thin,
    /// A polygon: so many corners, in that order; all of them where none are given.
    Flat(&'static [u8]),
    /// A polygon with as many points between its corners behind them.
    FlatQuadratic,
    /// A solid.
    Solid(&'static Solid),
    /// A solid whose faces are listed.
    Polyhedron,
    /// Anything else.
    Other,
}

/// A kind of solid.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Solid {
    pub name: &'static str,
    pub corners: usize,
    /// Corners of each face, turned outward.
    pub faces: &'static [&'static [u8]],
    /// Whether programs agree on the order of its corners.
    pub agreed: bool,
}

const TETRAHEDRON: Solid =
    Solid { name: "tetrahedron", corners: 4, faces: &[&[0, 1, 3], &[1, 2, 3], &[2, 0, 3], &[0, 2, 1]], agreed: true };
const VOXEL: Solid = Solid {
    name: "voxel",
    corners: 8,
    faces: &[&[0, 4, 6, 2], &[1, 3, 7, 5], &[0, 1, 5, 4], &[2, 6, 7, 3], &[0, 2, 3, 1], &[4, 5, 7, 6]],
    agreed: true,
};
const HEXAHEDRON: Solid = Solid {
    name: "hexahedron",
    corners: 8,
    faces: &[&[0, 4, 7, 3], &[1, 2, 6, 5], &[0, 1, 5, 4], &[3, 7, 6, 2], &[0, 3, 2, 1], &[4, 5, 6, 7]],
    agreed: true,
};
/// VTK's documents and its code turn the first triangle differently, and so do programs.
const WEDGE: Solid = Solid {
    name: "wedge",
    corners: 6,
    faces: &[&[0, 1, 2], &[3, 5, 4], &[0, 3, 4, 1], &[1, 4, 5, 2], &[2, 5, 3, 0]],
    agreed: false,
};
const PYRAMID: Solid = Solid {
    name: "pyramid",
    corners: 5,
    faces: &[&[0, 3, 2, 1], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]],
    agreed: true,
};
const PENTAGONAL_PRISM: Solid = Solid {
    name: "pentagonal prism",
    corners: 10,
    faces: &[
        &[0, 4, 3, 2, 1],
        &[5, 6, 7, 8, 9],
        &[0, 1, 6, 5],
        &[1, 2, 7, 6],
        &[2, 3, 8, 7],
        &[3, 4, 9, 8],
        &[4, 0, 5, 9],
    ],
    agreed: false,
};
const HEXAGONAL_PRISM: Solid = Solid {
    name: "hexagonal prism",
    corners: 12,
    faces: &[
        &[0, 5, 4, 3, 2, 1],
        &[6, 7, 8, 9, 10, 11],
        &[0, 1, 7, 6],
        &[1, 2, 8, 7],
        &[2, 3, 9, 8],
        &[3, 4, 10, 9],
        &[4, 5, 11, 10],
        &[5, 0, 6, 11],
    ],
    agreed: false,
};

/// What a cell of a kind is.
pub(super) fn shape(kind: u8) -> Shape {
    match kind {
        0..=4 | 21 | 35 | 60 | 68 | 75 => Shape::Thin,
        7 => Shape::Flat(&[]),
        8 => Shape::Flat(&[0, 1, 3, 2]),
        5 | 22 | 34 | 61 | 69 | 76 => Shape::Flat(&[0, 1, 2]),
        9 | 23 | 28 | 30 | 62 | 70 | 77 => Shape::Flat(&[0, 1, 2, 3]),
        36 => Shape::FlatQuadratic,
        10 | 24 | 64 | 71 | 78 => Shape::Solid(&TETRAHEDRON),
        11 => Shape::Solid(&VOXEL),
        12 | 25 | 29 | 33 | 67 | 72 | 79 => Shape::Solid(&HEXAHEDRON),
        13 | 26 | 31 | 32 | 65 | 73 | 80 => Shape::Solid(&WEDGE),
        14 | 27 | 37 | 66 | 74 | 81 => Shape::Solid(&PYRAMID),
        15 => Shape::Solid(&PENTAGONAL_PRISM),
        16 => Shape::Solid(&HEXAGONAL_PRISM),
        42 => Shape::Polyhedron,
        _ => Shape::Other,
    }
}

/// Whether a cell of a kind has points between its corners.
pub(super) fn is_quadratic(kind: u8) -> bool {
    matches!(kind, 21..=37 | 60..=81)
}

/// Whether a cell of a kind is a polygon.
pub(super) fn is_flat(kind: u8) -> bool {
    matches!(shape(kind), Shape::Flat(_) | Shape::FlatQuadratic)
}

/// Whether a cell of a kind is solid.
pub(super) fn is_solid(kind: u8) -> bool {
    matches!(shape(kind), Shape::Solid(_) | Shape::Polyhedron)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_faces_of_every_solid_close_it() {
        let mut met = 0;
        for kind in 0..=255 {
            let Shape::Solid(solid) = shape(kind) else { continue };
            met += 1;
            let mut edges = Vec::new();
            for face in solid.faces {
                edges.extend((0..face.len()).map(|i| (face[i], face[(i + 1) % face.len()])));
            }
            // each edge once along and once against
            let mut sorted = edges.clone();
            sorted.sort_unstable();
            sorted.dedup();
            assert_eq!(sorted.len(), edges.len(), "{}", solid.name);
            assert!(edges.iter().all(|&(a, b)| sorted.binary_search(&(b, a)).is_ok()), "{}", solid.name);
            let used = edges.iter().map(|e| usize::from(e.0)).max();
            assert_eq!(used, Some(solid.corners - 1));
            assert_eq!(solid.corners + solid.faces.len(), edges.len() / 2 + 2, "Euler: {}", solid.name);
        }
        assert_eq!(met, 28);
    }
}
