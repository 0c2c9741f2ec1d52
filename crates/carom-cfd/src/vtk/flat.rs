//! Plane and axisymmetric results: cells that are polygons of a plane are made solid, one layer between empty sides or a wedge round the axis.
//! Cells that are lines become the faces of the boundary.

use super::Axis;
use super::cells::{LINE, POLYGON, POLYHEDRON, POLYLINE, is_flat};
use super::data::{Data, Labels, QUANTITIES};
use super::files::{Block, Found, others};
use super::grid::{Grid, Shells};
use crate::geometry::face_centre_and_area;
use crate::geometry::vector::{add, cross, dot, length, scaled, sub, unit};
use crate::{PatchKind, Polygons};

/// Distance from the plane, or of the axis, that rounding makes, over the size (or over the coordinates, if they are larger); that of single precision.
const ROUNDED: f64 = 1e-6;
/// Share of the fastest velocity that may lead out of a plane result.
const ACROSS: f64 = 1e-3;
/// Thickness of the layer, over the size of the result.
const THICK: f64 = 0.01;
/// Half of the wedge's angle: 2.5°.
const HALF: f64 = 2.5 * std::f64::consts::PI / 180.0;

/// How points of the plane are put on both sides of it.
enum Spread {
    /// Half of the thickness along the normal.
    Layer([f64; 3]),
    /// Round a unit axis through the origin; a distance from it up to `least` is none.
    Wedge { axis: [f64; 3], least: f64 },
}

/// Makes the cells solid, puts the sides beside the plane to what was found, and says what was made.
///
/// What `must_flow` has a velocity, which tells a result from the side of a body.
pub(super) fn make_solid(
    found: &mut Found,
    axis: Option<Axis>,
    must_flow: bool,
    notes: &mut Vec<String>,
) -> Result<(), String> {
    let plane = Plane::of(found.grids())?;
    let spread = match axis {
        None => plane.layer(found.grids(), must_flow)?,
        Some(axis) => plane.wedge(axis, found.grids(), must_flow)?,
    };
    let side = |name: &str, kind| Block { name: name.to_owned(), kind, grid: empty() };
    let (mut sides, note) = match &spread {
        Spread::Layer(half) => (
            vec![side("frontAndBack", PatchKind::Empty)],
            format!(
                "a plane result: its cells are taken as {:.3e} m thick, so areas and fluxes are those of that; if it goes round an axis, \
                 axisymmetric = \"x\" (or y, z) says so",
                2.0 * length(*half)
            ),
        ),
        Spread::Wedge { .. } => (
            vec![side("front", PatchKind::Wedge), side("back", PatchKind::Wedge)],
            "an axisymmetric result: its cells are taken as a wedge of 5 degrees".to_owned(),
        ),
    };
    notes.push(note);
    for grid in &mut found.solids {
        *grid = thick(std::mem::take(grid), &spread, &mut sides)?;
    }
    for block in std::mem::take(&mut found.surfaces) {
        let solid = block.grid.has_polygons();
        let grid = thick(block.grid, &spread, &mut sides)?;
        if solid {
            found.blocks.push(block.name);
            found.solids.push(grid);
        } else {
            found.surfaces.push(Block { grid, ..block });
        }
    }
    found.sides = sides;
    Ok(())
}

fn empty() -> Grid {
    Grid { cells: Polygons { starts: vec![0], corners: Vec::new() }, ..Grid::default() }
}

/// The plane that all polygons lie in.
struct Plane {
    normal: [f64; 3],
    point: [f64; 3],
    size: f64,
}

impl Plane {
    fn of<'a>(grids: impl Iterator<Item = &'a Grid> + Clone) -> Result<Self, String> {
        let mut areas =
            grids.clone().flat_map(|g| (0..g.kinds.len()).filter_map(|c| g.polygon(c)).map(move |p| (g, p)));
        let (mut sum, mut point) = ([0.0; 3], None);
        for (grid, polygon) in &mut areas {
            let (_, area) = face_centre_and_area(&grid.points, &polygon);
            sum = add(sum, scaled(if dot(sum, area) < 0.0 { -1.0 } else { 1.0 }, area));
            point.get_or_insert(grid.points[polygon[0] as usize]);
        }
        let (Some(normal), Some(point)) = (unit(sum), point) else { return Err("no polygon has an area".to_owned()) };
        let (mut off, mut low, mut high) = (0.0_f64, point, point);
        for x in places(grids) {
            off = off.max(dot(sub(x, point), normal).abs());
            (low, high) = ([0, 1, 2].map(|c| low[c].min(x[c])), [0, 1, 2].map(|c| high[c].max(x[c])));
        }
        let size = length(sub(high, low));
        if off > ROUNDED * size.max(length(low)).max(length(high)) {
            return Err("they do not lie in a plane".to_owned());
        }
        // along a direction of the axes to the last bit where it is one
        let tidy = normal.map(|c| if c.abs() < ROUNDED { 0.0 } else { c });
        Ok(Self { normal: unit(tidy).unwrap_or(normal), point, size })
    }

    fn layer<'a>(&self, grids: impl Iterator<Item = &'a Grid> + Clone, must_flow: bool) -> Result<Spread, String> {
        let (mut fastest, mut across) = (0.0_f64, 0.0_f64);
        for u in grids.clone().flat_map(velocities) {
            (fastest, across) = (fastest.max(length(u)), across.max(dot(u, self.normal).abs()));
        }
        if fastest == 0.0 && must_flow {
            return Err(format!("they have no velocity, as a plane result has{}", there(grids)));
        }
        if across > ACROSS * fastest {
            return Err("their velocity leads out of their plane, as on a side of a body, or with swirl in an axisymmetric result: axisymmetric = \"x\" (or y, z)"
                    .to_owned());
        }
        Ok(Spread::Layer(scaled(0.5 * THICK * self.size, self.normal)))
    }

    fn wedge<'a>(
        &self,
        axis: Axis,
        grids: impl Iterator<Item = &'a Grid> + Clone,
        must_flow: bool,
    ) -> Result<Spread, String> {
        let (name, along) = (axis.name(), axis.direction());
        let least = ROUNDED * self.size;
        if dot(along, self.normal).abs() > ROUNDED || dot(self.point, self.normal).abs() > least {
            return Err(format!("the {name} axis is not in their plane"));
        }
        if must_flow && grids.clone().flat_map(velocities).all(|u| u == [0.0; 3]) {
            return Err(format!("they have no velocity, as an axisymmetric result has{}", there(grids)));
        }
        // the sides may be numbered either way, but all of the result is on one of the axis
        let radial = cross(along, self.normal);
        let mut reach = [0.0_f64; 2];
        for x in places(grids) {
            let r = dot(x, radial);
            reach = [reach[0].min(r), reach[1].max(r)];
        }
        if reach[0] < -least && reach[1] > least {
            return Err(format!("they lie on both sides of the {name} axis"));
        }
        Ok(Spread::Wedge { axis: along, least })
    }
}

/// What else there is, for a message.
fn there<'a>(grids: impl Iterator<Item = &'a Grid>) -> String {
    let all = others(grids);
    if all.is_empty() { String::new() } else { format!("; there are {}", all.join(", ")) }
}

/// Corners of the polygons, m.
fn places<'a>(grids: impl Iterator<Item = &'a Grid>) -> impl Iterator<Item = [f64; 3]> {
    let of = |grid: &'a Grid| grid.points.iter().zip(grid.used(is_flat)).filter(|(_, used)| *used).map(|(x, _)| *x);
    grids.flat_map(of)
}

/// Velocities that are known in the polygons of a grid, or at its points, m/s.
fn velocities(grid: &Grid) -> impl Iterator<Item = [f64; 3]> {
    let list = |values: &'_ Option<Vec<f64>>| values.as_deref().unwrap_or_default().as_chunks::<3>().0.to_vec();
    let of_cells = list(&grid.data.cells[0]).into_iter().enumerate().filter(|(c, _)| is_flat(grid.kinds[*c]));
    let all = list(&grid.data.points[0]).into_iter().chain(of_cells.map(|(_, u)| u));
    all.filter(|u| u.iter().all(|c| c.is_finite()))
}

impl Spread {
    /// Where a point goes on one side (−1) or the other (1).
    fn place(&self, x: [f64; 3], side: f64) -> [f64; 3] {
        match self {
            Self::Layer(half) => add(x, scaled(side, *half)),
            Self::Wedge { axis, .. } if self.is_on_axis(x) => split(x, *axis).0,
            Self::Wedge { axis, .. } => turned(x, *axis, side),
        }
    }

    /// A vector of the plane there.
    fn vector(&self, u: [f64; 3], side: f64) -> [f64; 3] {
        match self {
            Self::Layer(_) => u,
            Self::Wedge { axis, .. } => turned(u, *axis, side),
        }
    }

    /// Whether a point is the same on both sides.
    fn is_on_axis(&self, x: [f64; 3]) -> bool {
        match self {
            Self::Layer(_) => false,
            Self::Wedge { axis, least } => length(split(x, *axis).1) <= *least,
        }
    }
}

/// A vector turned by half of the wedge's angle, and longer off the axis, so that between both sides it is what it was.
fn turned(x: [f64; 3], axis: [f64; 3], side: f64) -> [f64; 3] {
    let (along, off) = split(x, axis);
    // (off cos + (axis × off) sin) / cos
    add(along, add(off, scaled(side * HALF.tan(), cross(axis, off))))
}

/// Parts of a vector along an axis and off it.
fn split(x: [f64; 3], axis: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let along = scaled(dot(x, axis), axis);
    (along, sub(x, along))
}

/// A grid of polygons and lines as one of polyhedra and polygons, the front and back of which are put to the sides.
fn thick(grid: Grid, spread: &Spread, sides: &mut [Block]) -> Result<Grid, String> {
    let count = grid.points.len();
    u32::try_from(2 * count).map_err(|_| "too many points")?;
    let on_axis: Vec<bool> = grid.points.iter().map(|x| spread.is_on_axis(*x)).collect();
    let behind = |p: u32| if on_axis[p as usize] { p } else { p + count as u32 };
    let mut made = empty();
    made.points =
        [-1.0, 1.0].into_iter().flat_map(|side| grid.points.iter().map(move |x| spread.place(*x, side))).collect();
    made.shells = Shells { starts: vec![0], faces: Polygons { starts: vec![0], corners: Vec::new() } };
    // the face of an edge; none of one on the axis
    let across = |a: u32, b: u32| {
        let mut face = vec![a, b, behind(b), behind(a)];
        face.dedup();
        face.truncate(if face.first() == face.last() { face.len() - 1 } else { face.len() });
        Some(face).filter(|face| face.len() >= 3)
    };
    let mut from: Vec<usize> = Vec::new();
    for cell in 0..grid.kinds.len() {
        if let Some(front) = grid.polygon(cell) {
            let back: Vec<u32> = front.iter().rev().map(|p| behind(*p)).collect();
            let last = sides.len() - 1;
            for (side, face) in [(0, &front), (last, &back)] {
                push(&mut made.shells.faces, face);
                let on = &mut sides[side].grid;
                let first = on.points.len() as u32;
                on.points.extend(face.iter().map(|p| made.points[*p as usize]));
                push(&mut on.cells, &(first..on.points.len() as u32).collect::<Vec<_>>());
                on.kinds.push(POLYGON);
            }
            for (i, a) in front.iter().enumerate() {
                across(*a, front[(i + 1) % front.len()]).iter().for_each(|face| push(&mut made.shells.faces, face));
            }
            made.kinds.push(POLYHEDRON);
            push(&mut made.cells, &[]);
            from.push(cell);
        }
        for face in edges(&grid, cell).filter_map(|[a, b]| across(a, b)) {
            made.kinds.push(POLYGON);
            push(&mut made.cells, &face);
            from.push(cell);
        }
        made.shells.starts.resize(made.kinds.len() + 1, made.shells.faces.len() as u32);
    }
    made.data = spread.data(grid.data, &from);
    made.time = grid.time;
    Ok(made)
}

fn push(lists: &mut Polygons, list: &[u32]) {
    lists.corners.extend(list);
    lists.starts.push(lists.corners.len() as u32);
}

/// The straight pieces of a cell that is a line.
fn edges(grid: &Grid, cell: usize) -> impl Iterator<Item = [u32; 2]> {
    let points = grid.cells.get(cell);
    let points = match grid.kinds[cell] {
        POLYLINE => points,
        LINE | 21 | 35 | 68 | 75 => points.get(..2).unwrap_or_default(),
        _ => &[],
    };
    points.windows(2).map(|pair| [pair[0], pair[1]])
}

impl Spread {
    /// The data of both sides' points, and of the cells that were made, each from one before.
    fn data(&self, mut data: Data, from: &[usize]) -> Data {
        for (q, values) in data.points.iter_mut().enumerate() {
            let Some(values) = values else { continue };
            *values = match q {
                0 => {
                    let on = |side| values.as_chunks::<3>().0.iter().flat_map(move |u| self.vector(*u, side));
                    on(-1.0).chain(on(1.0)).collect()
                }
                _ => values.repeat(2),
            };
        }
        for (values, (_, width, _)) in data.cells.iter_mut().zip(QUANTITIES) {
            if let Some(values) = values {
                *values = from.iter().flat_map(|c| values[c * width..][..width].iter().copied()).collect();
            }
        }
        data.labels = data.labels.map(|labels| match labels {
            Labels::Numbers(all) => Labels::Numbers(from.iter().map(|c| all[*c]).collect()),
            Labels::Texts(all) => {
                Labels::Texts(from.iter().map(|c| all.get(*c).cloned().unwrap_or_default()).collect())
            }
        });
        data
    }
}
