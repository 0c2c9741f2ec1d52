//! A mesh of polyhedra.

use std::ops::Range;

/// Polygons in one list: polygon `i` has the corners `corners[starts[i]..starts[i + 1]]`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Polygons {
    /// Where each polygon's corners begin; one more entry than polygons.
    pub starts: Vec<u32>,
    /// Numbers of points.
    pub corners: Vec<u32>,
}

impl Polygons {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The corners of one, in order round it; none where there is no such polygon.
    #[inline]
    pub fn get(&self, polygon: usize) -> &[u32] {
        match self.starts.get(polygon..polygon + 2) {
            Some([from, to]) => self.corners.get(*from as usize..*to as usize).unwrap_or_default(),
            _ => &[],
        }
    }
}

/// A mesh of polyhedra: polygons, each between two cells, or between a cell and the outside.
///
/// Faces between cells come first, then those of the patches, patch by patch. The corners of a face turn so that its area vector (by the right-hand rule) points
/// out of its owner. Whoever makes one has checked it: every index is in its range, every boundary face is in one patch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Points, m.
    pub points: Vec<[f64; 3]>,
    /// Faces: first the inner ones, then the patches'.
    pub faces: Polygons,
    /// The cell whose outside each face's area vector points to.
    pub owner: Vec<u32>,
    /// The other cell, of the inner faces only.
    pub neighbour: Vec<u32>,
    /// How many cells there are.
    pub cells: usize,
    /// The boundary, in the order of its faces.
    pub patches: Vec<Patch>,
}

impl Mesh {
    /// How many faces lie between cells.
    pub fn inner_faces(&self) -> usize {
        self.neighbour.len()
    }
}

/// A part of the boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Its name.
    pub name: String,
    /// Names of the groups it is in.
    pub groups: Vec<String>,
    /// What it is.
    pub kind: PatchKind,
    /// Its faces.
    pub faces: Range<usize>,
}

/// What a patch is.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum PatchKind {
    /// A wall.
    Wall,
    /// A patch that says no more: an inlet, an outlet, or anything else.
    Plain,
    /// A side of a plane case, one cell deep.
    Empty,
    /// A side of an axisymmetric case, one cell thick; both sides are wedges.
    Wedge,
    /// A plane of symmetry.
    Symmetry,
    /// The fluid goes on at another patch, face by face in order.
    Cyclic {
        /// Index of the other patch.
        partner: usize,
        /// How points and vectors are carried from this patch to the other.
        carry: Carry,
    },
    /// The fluid goes on at another patch whose faces lie otherwise.
    CyclicAmi {
        /// Index of the other patch.
        partner: usize,
        /// How points and vectors are carried from this patch to the other.
        carry: Carry,
    },
}

impl PatchKind {
    /// Its word, as OpenFOAM has it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Wall => "wall",
            Self::Plain => "patch",
            Self::Empty => "empty",
            Self::Wedge => "wedge",
            Self::Symmetry => "symmetry",
            Self::Cyclic { .. } => "cyclic",
            Self::CyclicAmi { .. } => "cyclicAMI",
        }
    }
}

/// A rotation and a translation: x ↦ Rx + t for points, v ↦ Rv for vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carry {
    /// R, row by row.
    pub rotation: [[f64; 3]; 3],
    /// t, m.
    pub translation: [f64; 3],
}

impl Carry {
    /// A translation alone.
    pub fn by(translation: [f64; 3]) -> Self {
        Self { rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], translation }
    }

    /// The way back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let r = &self.rotation;
        let rotation = [0, 1, 2].map(|i| [r[0][i], r[1][i], r[2][i]]);
        let t = &self.translation;
        Self { rotation, translation: rotation.map(|row| -(row[0] * t[0] + row[1] * t[1] + row[2] * t[2])) }
    }

    /// This, and then another.
    ///
    /// ```
    /// use carom_cfd::Carry;
    ///
    /// let turn = Carry { rotation: [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], translation: [1.0, 0.0, 0.0] };
    /// let both = turn.then(&Carry::by([0.0, 2.0, 0.0])).then(&turn);
    /// assert_eq!(both.point([1.0, 2.0, 3.0]), [-2.0, -1.0, 3.0]);
    /// assert_eq!(turn.then(&turn.inverse()), Carry::by([0.0; 3]));
    /// ```
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        let r = &self.rotation;
        let column = |j: usize| next.vector([r[0][j], r[1][j], r[2][j]]);
        let columns = [column(0), column(1), column(2)];
        let rotation = [0, 1, 2].map(|i| [columns[0][i], columns[1][i], columns[2][i]]);
        Self { rotation, translation: next.point(self.translation) }
    }

    /// A vector carried over.
    #[inline]
    pub fn vector(&self, v: [f64; 3]) -> [f64; 3] {
        self.rotation.map(|r| r[0] * v[0] + r[1] * v[1] + r[2] * v[2])
    }

    /// A point carried over, m.
    #[inline]
    pub fn point(&self, x: [f64; 3]) -> [f64; 3] {
        let turned = self.vector(x);
        [0, 1, 2].map(|c| turned[c] + self.translation[c])
    }
}
