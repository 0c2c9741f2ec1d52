//! What a mesh is like: kinds of cells, volumes, and how far its cells are from good ones.
//!
//! With d from the owner's centre to the neighbour's, S the area vector and x_f the centre of a face:
//!
//! - **non-orthogonality** is the angle between d and S; the mean is that of the mean cosine;
//! - **skewness** is the distance from x_f to where the line along d passes through the face, over the greater of 0.2 |d| and the reach of the face that way.
//!   At the boundary d is the part along S from the owner's centre to x_f, and its share 0.4;
//! - **aspect ratio** is the greater of two: the largest component of Σ|S| of a cell over its smallest, and, where no direction is left out
//!   (`empty`, `wedge`), the sum of the components over 6 V^⅔;
//! - a tetrahedron of the [decomposition](crate::geometry::base_points) is **inverted** where it is turned or flat.
//!
//! These are the measures of OpenFOAM's `checkMesh` (v1912, `primitiveMeshTools.C`), whose numbers the tests hold them against; periodic faces
//! count once, as faces between cells, those of `cyclicAMI` not at all.

use crate::check::faces_of_cells;
use crate::geometry::vector::{add, dot, length, scaled, sub};
use crate::geometry::{base_points, cell_centres_and_volumes, face_centres_and_areas};
use crate::{Carry, Field, Fields, Mesh, PatchKind};

/// At most so many cells are named.
const NAMED: usize = 10;

/// What a mesh is like.
#[derive(Clone, Debug, PartialEq)]
pub struct Quality {
    /// Cells by kind.
    pub kinds: Kinds,
    /// Least and largest coordinates of the points, m.
    pub bounds: [[f64; 3]; 2],
    /// Volume of all cells, m³.
    pub volume: f64,
    /// The smallest cell, m³.
    pub smallest: Worst,
    /// The largest cell, m³.
    pub largest: Worst,
    /// The greatest angle of non-orthogonality, degrees, and the owner of that face.
    pub non_orthogonality: Worst,
    /// The angle of the mean cosine, degrees.
    pub mean_non_orthogonality: f64,
    /// The greatest skewness, and the owner of that face.
    pub skewness: Worst,
    /// The greatest aspect ratio.
    pub aspect_ratio: Worst,
    /// Cells with tetrahedra that are turned or flat.
    pub inverted: Named,
    /// Cells whose volume is not above zero.
    pub negative: Named,
    /// Area of each patch, m².
    pub areas: Vec<f64>,
}

/// Numbers of cells by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kinds {
    /// Six quadrilaterals.
    pub hexahedra: usize,
    /// Two triangles and three quadrilaterals.
    pub prisms: usize,
    /// Two triangles and four quadrilaterals.
    pub wedges: usize,
    /// Four triangles and a quadrilateral.
    pub pyramids: usize,
    /// Two triangles and two quadrilaterals.
    pub tetrahedral_wedges: usize,
    /// Four triangles.
    pub tetrahedra: usize,
    /// All others.
    pub polyhedra: usize,
}

impl Kinds {
    /// Names and numbers, in order.
    pub fn named(&self) -> [(&'static str, usize); 7] {
        [
            ("hexahedra", self.hexahedra),
            ("prisms", self.prisms),
            ("wedges", self.wedges),
            ("pyramids", self.pyramids),
            ("tetrahedral wedges", self.tetrahedral_wedges),
            ("tetrahedra", self.tetrahedra),
            ("polyhedra", self.polyhedra),
        ]
    }
}

/// An extreme value, and the cell that has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// The value.
    pub value: f64,
    /// The cell.
    pub cell: u32,
}

impl Worst {
    fn least() -> Self {
        Self { value: f64::INFINITY, cell: 0 }
    }

    /// For what is not less than zero.
    fn most() -> Self {
        Self { value: 0.0, cell: 0 }
    }

    fn above(&mut self, value: f64, cell: u32) {
        if value > self.value {
            *self = Self { value, cell };
        }
    }

    fn below(&mut self, value: f64, cell: u32) {
        if value < self.value {
            *self = Self { value, cell };
        }
    }
}

/// A number of cells, and the first of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Named {
    /// How many.
    pub count: usize,
    /// The first, ten at most.
    pub cells: Vec<u32>,
}

impl Named {
    fn of(cells: impl Iterator<Item = u32>) -> Self {
        let mut named = Self::default();
        for cell in cells {
            named.count += 1;
            if named.cells.len() < NAMED {
                named.cells.push(cell);
            }
        }
        named
    }
}

/// Between which values a field lies, over cells, points and boundary; of a vector, its magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// What the field is.
    pub name: &'static str,
    /// The least value.
    pub low: f64,
    /// The largest.
    pub high: f64,
}

/// Ranges of the fields that are there.
pub fn ranges(fields: &Fields) -> Vec<Range> {
    let velocity = fields.velocity.as_ref().map(|f| range("velocity", f, |v| length(*v)));
    let scalars = fields.scalars().into_iter().filter_map(|(name, f)| f.map(|f| range(name, f, |[x]| *x)));
    velocity.into_iter().chain(scalars).collect()
}

fn range<const N: usize>(name: &'static str, field: &Field<N>, size: impl Fn(&[f64; N]) -> f64) -> Range {
    let (inside, boundary): (&[_], &[_]) = match field {
        Field::Cells { cells, boundary } => (cells, boundary),
        Field::Points(points) => (points, &[]),
    };
    let mut range = Range { name, low: f64::INFINITY, high: f64::NEG_INFINITY };
    for x in inside.iter().chain(boundary).map(size) {
        range.low = range.low.min(x);
        range.high = range.high.max(x);
    }
    range
}

/// Measures a mesh that has been [checked](crate::check::mesh).
pub fn quality(mesh: &Mesh) -> Quality {
    let (face_centres, areas) = face_centres_and_areas(&mesh.points, &mesh.faces);
    let (centres, volumes) = cell_centres_and_volumes(mesh, &face_centres, &areas);
    let (mut smallest, mut largest) = (Worst::least(), Worst { value: f64::NEG_INFINITY, cell: 0 });
    for (cell, v) in volumes.iter().enumerate() {
        smallest.below(*v, cell as u32);
        largest.above(*v, cell as u32);
    }
    let (non_orthogonality, mean_non_orthogonality) = non_orthogonality(mesh, &centres, &areas);
    let inverted = inverted(mesh, &centres);
    Quality {
        kinds: kinds(mesh),
        bounds: bounds(&mesh.points),
        volume: volumes.iter().sum(),
        smallest,
        largest,
        non_orthogonality,
        mean_non_orthogonality,
        skewness: skewness(mesh, &centres, &face_centres, &areas),
        aspect_ratio: aspect_ratio(mesh, &areas, &volumes),
        inverted,
        negative: Named::of((0..mesh.cells as u32).filter(|c| volumes[*c as usize] <= 0.0)),
        areas: mesh.patches.iter().map(|p| areas[p.faces.clone()].iter().map(|s| length(*s)).sum()).collect(),
    }
}

fn bounds(points: &[[f64; 3]]) -> [[f64; 3]; 2] {
    points.iter().fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], x| {
        [[0, 1, 2].map(|c| low[c].min(x[c])), [0, 1, 2].map(|c| high[c].max(x[c]))]
    })
}

fn kinds(mesh: &Mesh) -> Kinds {
    let (starts, faces) = faces_of_cells(mesh);
    let mut kinds = Kinds::default();
    for c in 0..mesh.cells {
        let (mut triangles, mut quadrilaterals, mut others) = (0, 0, 0);
        for &f in &faces[starts[c] as usize..starts[c + 1] as usize] {
            match mesh.faces.get(f as usize).len() {
                3 => triangles += 1,
                4 => quadrilaterals += 1,
                _ => others += 1,
            }
        }
        let kind = match (triangles, quadrilaterals, others) {
            (0, 6, 0) => &mut kinds.hexahedra,
            (2, 3, 0) => &mut kinds.prisms,
            (2, 4, 0) => &mut kinds.wedges,
            (4, 1, 0) => &mut kinds.pyramids,
            (2, 2, 0) => &mut kinds.tetrahedral_wedges,
            (4, 0, 0) => &mut kinds.tetrahedra,
            _ => &mut kinds.polyhedra,
        };
        *kind += 1;
    }
    kinds
}

/// Faces that cells have in common, with the centre of the cell beyond: those between cells, and of each periodic pair one side.
fn common<'m>(mesh: &'m Mesh, centres: &'m [[f64; 3]]) -> impl Iterator<Item = (usize, [f64; 3])> + 'm {
    let inner = mesh.neighbour.iter().enumerate().map(|(f, c)| (f, centres[*c as usize]));
    let periodic = mesh.patches.iter().enumerate().flat_map(move |(i, patch)| {
        let pair = match patch.kind {
            PatchKind::Cyclic { partner, .. } if i < partner => Some(&mesh.patches[partner]),
            _ => None,
        };
        pair.into_iter().flat_map(move |other| {
            let back = match other.kind {
                PatchKind::Cyclic { carry, .. } => carry,
                _ => Carry::by([0.0; 3]),
            };
            let beyond = other.faces.clone().map(move |g| back.point(centres[mesh.owner[g] as usize]));
            patch.faces.clone().zip(beyond)
        })
    });
    inner.chain(periodic)
}

fn non_orthogonality(mesh: &Mesh, centres: &[[f64; 3]], areas: &[[f64; 3]]) -> (Worst, f64) {
    let (mut worst, mut sum, mut count) = (Worst { value: f64::NEG_INFINITY, cell: 0 }, 0.0, 0_usize);
    for (f, beyond) in common(mesh, centres) {
        let own = mesh.owner[f];
        let d = sub(beyond, centres[own as usize]);
        let cosine = dot(d, areas[f]) / (length(d) * length(areas[f])).max(f64::MIN_POSITIVE);
        worst.above(-cosine, own);
        sum += cosine;
        count += 1;
    }
    let angle = |cosine: f64| cosine.clamp(-1.0, 1.0).acos().to_degrees();
    match count {
        0 => (Worst::most(), 0.0),
        n => (Worst { value: angle(-worst.value), cell: worst.cell }, angle(sum / n as f64)),
    }
}

fn skewness(mesh: &Mesh, centres: &[[f64; 3]], face_centres: &[[f64; 3]], areas: &[[f64; 3]]) -> Worst {
    let mut worst = Worst::most();
    let mut face = |f: usize, d: [f64; 3], share: f64| {
        let own = mesh.owner[f];
        let to_face = sub(face_centres[f], centres[own as usize]);
        let through = dot(areas[f], d);
        if through == 0.0 {
            return;
        }
        let off = sub(to_face, scaled(dot(areas[f], to_face) / through, d));
        let size = length(off);
        if size == 0.0 {
            return;
        }
        let mut reach = share * length(d);
        for &c in mesh.faces.get(f) {
            reach = reach.max(dot(off, sub(mesh.points[c as usize], face_centres[f])).abs() / size);
        }
        worst.above(size / reach, own);
    };
    for (f, beyond) in common(mesh, centres) {
        face(f, sub(beyond, centres[mesh.owner[f] as usize]), 0.2);
    }
    for f in mesh.patches.iter().filter(|p| !is_periodic(&p.kind)).flat_map(|p| p.faces.clone()) {
        let to_face = sub(face_centres[f], centres[mesh.owner[f] as usize]);
        let square = dot(areas[f], areas[f]).max(f64::MIN_POSITIVE);
        face(f, scaled(dot(areas[f], to_face) / square, areas[f]), 0.4);
    }
    worst
}

fn is_periodic(kind: &PatchKind) -> bool {
    matches!(kind, PatchKind::Cyclic { .. } | PatchKind::CyclicAmi { .. })
}

fn aspect_ratio(mesh: &Mesh, areas: &[[f64; 3]], volumes: &[f64]) -> Worst {
    let magnitude = |s: [f64; 3]| s.map(f64::abs);
    let mut sums = vec![[0.0; 3]; mesh.cells];
    for (f, &c) in mesh.owner.iter().enumerate().chain(mesh.neighbour.iter().enumerate()) {
        sums[c as usize] = add(sums[c as usize], magnitude(areas[f]));
    }
    let mut across = [0.0; 3];
    for patch in mesh.patches.iter().filter(|p| matches!(p.kind, PatchKind::Empty | PatchKind::Wedge)) {
        across = patch.faces.clone().fold(across, |s, f| add(s, magnitude(areas[f])));
    }
    // the direction that a plane or axisymmetric case has not
    let most = across.iter().copied().fold(0.0, f64::max);
    let left = [0, 1, 2].map(|c| most == 0.0 || across[c] < most);
    let mut worst = Worst::most();
    for (cell, s) in sums.iter().enumerate() {
        let there = || s.iter().zip(left).filter(|(_, left)| *left).map(|(s, _)| *s);
        let (low, high) = (there().fold(f64::INFINITY, f64::min), there().fold(0.0, f64::max));
        let mut ratio = high / low.max(f64::MIN_POSITIVE);
        if most == 0.0 {
            let edge = volumes[cell].max(f64::MIN_POSITIVE).cbrt();
            ratio = ratio.max((s[0] + s[1] + s[2]) / 6.0 / (edge * edge));
        }
        worst.above(ratio, cell as u32);
    }
    worst
}

fn inverted(mesh: &Mesh, centres: &[[f64; 3]]) -> Named {
    let found = base_points(mesh, centres);
    let mut cells: Vec<u32> = found.inverted.iter().flat_map(|f| found.inverted_cells(mesh, centres, *f)).collect();
    cells.sort_unstable();
    cells.dedup();
    Named::of(cells.into_iter())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::{Kind, block};

    #[test]
    fn kinds_of_cells() {
        let count = |kind| kinds(&block(kind, [2, 2, 2], |x| x));
        assert_eq!(count(Kind::Hexahedra), Kinds { hexahedra: 8, ..Kinds::default() });
        assert_eq!(count(Kind::Prisms), Kinds { prisms: 16, ..Kinds::default() });
        assert_eq!(count(Kind::Tetrahedra), Kinds { tetrahedra: 48, ..Kinds::default() });
        assert_eq!(count(Kind::Pyramids), Kinds { pyramids: 48, ..Kinds::default() });
        assert_eq!(count(Kind::Polyhedra).polyhedra, block(Kind::Polyhedra, [2, 2, 2], |x| x).cells);
    }

    #[test]
    fn a_sheared_and_stretched_block_has_the_angles_and_ratios_of_its_cells() {
        // x sheared by y at 30°: d of faces across y leans by it, those across x stay straight
        let shear = 30_f64.to_radians().tan();
        let q = quality(&block(Kind::Hexahedra, [3, 3, 3], |[x, y, z]| [x + shear * y, y, z]));
        assert!((q.non_orthogonality.value - 30.0).abs() < 1e-12, "{:?}", q.non_orthogonality);
        // x faces: S leans by 30° against d along x; a third of the faces is straight
        let mean = ((2.0 * 30_f64.to_radians().cos() + 1.0) / 3.0).acos().to_degrees();
        assert!((q.mean_non_orthogonality - mean).abs() < 1e-12, "{}", q.mean_non_orthogonality);
        assert!((q.volume - 1.0).abs() < 1e-14);
        let q = quality(&block(Kind::Hexahedra, [2, 2, 2], |[x, y, z]| [8.0 * x, y, z]));
        // cells of 4 by 1/2 by 1/2: Σ|S| is ½, 4, 4; over it all 8.5/6 of V^⅔ = 1
        assert!((q.aspect_ratio.value - 8.0).abs() < 1e-14, "{:?}", q.aspect_ratio);
        assert!(q.skewness.value < 1e-14 && q.non_orthogonality.value < 1e-6);
        assert_eq!(q.areas, [1.0, 1.0, 8.0, 8.0, 8.0, 8.0]);
        assert_eq!((q.smallest.value, q.largest.value, q.bounds), (1.0, 1.0, [[0.0; 3], [8.0, 1.0, 1.0]]));
        assert_eq!((q.inverted.count, q.negative.count), (0, 0));
    }

    #[test]
    fn cells_with_inverted_tetrahedra_are_named() {
        // the corner that all eight cells of a cube have in common, moved right through the last of them
        let mut mesh = crate::samples::block([2, 2, 2], [1.0; 3]);
        mesh.points[13] = [1.3; 3];
        let q = quality(&mesh);
        assert!((q.volume - 1.0).abs() < 1e-14);
        assert_eq!(q.negative.cells, [7]);
        assert_eq!(q.smallest.cell, 7);
        assert!(q.inverted.cells.contains(&7) && q.inverted.count == q.inverted.cells.len(), "{:?}", q.inverted);
    }

    #[test]
    fn ranges_of_fields() {
        let fields = Fields {
            velocity: Some(Field::Cells { cells: vec![[3.0, 4.0, 0.0]], boundary: vec![[0.0; 3]] }),
            density: Some(Field::Points(vec![[1.2], [0.9]])),
            ..Fields::default()
        };
        let expected =
            [Range { name: "velocity", low: 0.0, high: 5.0 }, Range { name: "density", low: 0.9, high: 1.2 }];
        assert_eq!(ranges(&fields), expected);
    }
}
