//! How points are carried from one side of a periodic pair to the other.
//!
//! Files say it in words that differ between versions (`transform`, `transformType`, `separationVector`, `separation`, with either sign), and often not at all.
//! So it is taken from the faces: the translation, else the rotation that brings centres and area vectors of one side onto the other's
//! (Horn 1987, doi:10.1364/JOSAA.4.000629), about the axis that the file gives where it gives one. It must then bring every face onto its partner.

use std::ops::Range;

use crate::geometry::face_centre_and_area;
use crate::geometry::vector::{add, cross, dot, length, scaled, sub, unit};
use crate::{Carry, Mesh};

/// What the file says of a periodic patch.
#[derive(Clone, Debug, Default)]
pub(super) struct Told {
    pub(super) axis: Option<[f64; 3]>,
    pub(super) centre: Option<[f64; 3]>,
    pub(super) separation: Option<[f64; 3]>,
    pub(super) tolerance: Option<f64>,
}

struct Side {
    centre: [f64; 3],
    /// Area vector, m².
    area: [f64; 3],
    /// From the centre to the farthest corner, m.
    reach: f64,
    /// The first corner.
    corner: [f64; 3],
}

fn sides(mesh: &Mesh, faces: Range<usize>) -> Vec<Side> {
    let side = |f: usize| {
        let corners = mesh.faces.get(f);
        let (centre, area) = face_centre_and_area(&mesh.points, corners);
        let reach = corners.iter().map(|c| length(sub(mesh.points[*c as usize], centre))).fold(0.0, f64::max);
        Side { centre, area, reach, corner: corners.first().map_or(centre, |c| mesh.points[*c as usize]) }
    };
    faces.map(side).collect()
}

/// For sides whose faces lie on each other one by one.
pub(super) fn face_by_face(mesh: &Mesh, own: Range<usize>, other: Range<usize>, told: &Told) -> Result<Carry, String> {
    let (a, b) = (sides(mesh, own.clone()), sides(mesh, other.clone()));
    if a.len() != b.len() {
        return Err(format!("has {} faces, and its other side {}", a.len(), b.len()));
    }
    if a.is_empty() {
        return Ok(Carry::by([0.0; 3]));
    }
    let corners = |f: usize| mesh.faces.get(f).iter().map(|c| mesh.points[*c as usize]);
    let tolerance = told.tolerance.filter(|t| t.is_finite()).unwrap_or(0.0).clamp(1e-4, 0.1);
    let misfit = |carry: &Carry| {
        let off = |(a, b): (&Side, &Side)| {
            let turned = add(carry.vector(a.area), b.area);
            let away = length(sub(carry.point(a.centre), b.centre)) / a.reach;
            // area vectors differ more than places where points are rounded
            away.max(length(turned) / length(a.area) * 0.1)
        };
        // every corner comes to one of the partner's; without this a single face could be turned in its plane.
        // Pairs of faces with very many corners are left out: each would be held against each
        let corners_off = |(f, g): (usize, usize)| {
            if mesh.faces.get(f).len().saturating_mul(mesh.faces.get(g).len()) > 1 << 16 {
                return 0.0;
            }
            let nearest = |x| corners(g).map(|y| length(sub(carry.point(x), y))).fold(f64::INFINITY, f64::min);
            corners(f).map(nearest).fold(0.0, f64::max)
        };
        let faces = own.clone().zip(other.clone()).map(corners_off).zip(&a).map(|(off, a)| off / a.reach);
        a.iter().zip(&b).map(off).chain(faces).fold(0.0, |m: f64, x| if x > m || x.is_nan() { x } else { m })
    };
    let n = 1.0 / a.len() as f64;
    let shift = scaled(n, a.iter().zip(&b).fold([0.0; 3], |s, (a, b)| add(s, sub(b.centre, a.centre))));
    let shift = cleared(shift, a[0].reach, told);
    let mut best = f64::INFINITY;
    let mut tried = vec![Carry::by(shift)];
    if let Some(axis) = told.axis.and_then(unit) {
        tried.push(about(axis, told.centre.unwrap_or_default(), &a, &b));
    }
    tried.extend([turned(&a, &b, true), turned(&a, &b, false)]);
    for carry in tried {
        let off = misfit(&carry);
        if off <= tolerance {
            return Ok(carry);
        }
        best = best.min(off);
    }
    Err(format!("its faces do not lie on its other side's: moved over, they are off by {best:.1e} of their size"))
}

/// A translation without the dust of rounding; the file's own where that is the same.
fn cleared(shift: [f64; 3], reach: f64, told: &Told) -> [f64; 3] {
    let either = told.separation.into_iter().flat_map(|s| [s, scaled(-1.0, s)]);
    let told = either.into_iter().find(|s| length(sub(*s, shift)) < 1e-6 * reach);
    told.unwrap_or(shift.map(|x| if x.abs() < 1e-12 * reach { 0.0 } else { x }))
}

/// How far sides of unlike faces may lie beside each other, over their size: what faces cut off of a curved side.
const ASIDE: f64 = 0.05;

/// For sides that cover each other as a whole.
pub(super) fn between_areas(mesh: &Mesh, own: Range<usize>, other: Range<usize>, told: &Told) -> Result<Carry, String> {
    let (a, b) = (sides(mesh, own), sides(mesh, other));
    if a.is_empty() || b.is_empty() {
        return Ok(Carry::by([0.0; 3]));
    }
    let whole = |sides: &[Side]| {
        let (mut area, mut size, mut moment) = ([0.0; 3], 0.0, [0.0; 3]);
        for s in sides {
            let l = length(s.area);
            area = add(area, s.area);
            size += l;
            moment = add(moment, scaled(l, s.centre));
        }
        let centre = scaled(1.0 / size, moment);
        let reach = sides.iter().map(|s| length(sub(s.centre, centre)) + s.reach).fold(0.0, f64::max);
        (Side { centre, area, reach, corner: centre }, size)
    };
    let ((a, size), (b, _)) = (whole(&a), whole(&b));
    // a patch that bends and closes has no direction as a whole; two such lie on each other
    let closes = length(a.area) < 1e-3 * size;
    if closes || length(add(a.area, b.area)) < 1e-2 * length(a.area) {
        let shift = sub(b.centre, a.centre);
        // sides of unlike faces on the same place have centres that differ by what their faces cut off
        let near = length(shift) < 1e-2 * a.reach;
        return Ok(Carry::by(if near { [0.0; 3] } else { cleared(shift, a.reach, told) }));
    }
    let Some(axis) = told.axis.and_then(unit) else {
        return Err("is turned against its other side, and has no rotationAxis and rotationCentre".into());
    };
    let carry = about(axis, told.centre.unwrap_or_default(), std::slice::from_ref(&a), std::slice::from_ref(&b));
    let off = length(sub(carry.point(a.centre), b.centre));
    let turned = length(add(carry.vector(a.area), b.area));
    if off < ASIDE * a.reach && turned < ASIDE * length(a.area) {
        return Ok(carry);
    }
    Err("is not brought onto its other side by any rotation about its rotationAxis and rotationCentre".into())
}

/// The rotation about an axis that fits best.
fn about(axis: [f64; 3], centre: [f64; 3], a: &[Side], b: &[Side]) -> Carry {
    let across = |v: [f64; 3]| sub(v, scaled(dot(v, axis), axis));
    let (mut c, mut s) = (0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        let size = length(a.area).sqrt();
        let pairs = [
            (across(sub(a.centre, centre)), across(sub(b.centre, centre))),
            (scaled(1.0 / size, across(a.area)), scaled(-1.0 / size, across(b.area))),
        ];
        for (u, v) in pairs {
            c += dot(u, v);
            s += dot(axis, cross(u, v));
        }
    }
    let r = (c * c + s * s).sqrt();
    let (c, s) = if r > 0.0 { (c / r, s / r) } else { (1.0, 0.0) };
    let rotate = |v: [f64; 3]| {
        let along = scaled(dot(v, axis) * (1.0 - c), axis);
        add(add(scaled(c, v), scaled(s, cross(axis, v))), along)
    };
    from_columns([rotate([1.0, 0.0, 0.0]), rotate([0.0, 1.0, 0.0]), rotate([0.0, 0.0, 1.0])], centre, centre)
}

/// The motion with these images of the axes that brings one point to another.
fn from_columns(columns: [[f64; 3]; 3], from: [f64; 3], to: [f64; 3]) -> Carry {
    let mut carry = Carry::by([0.0; 3]);
    carry.rotation = [0, 1, 2].map(|r| [columns[0][r], columns[1][r], columns[2][r]]);
    carry.translation = sub(to, carry.vector(from));
    carry
}

/// The motion that fits best, by centres, area vectors and, as coupled faces begin at corners that lie on each other, first corners.
fn turned(a: &[Side], b: &[Side], corners: bool) -> Carry {
    let n = 1.0 / a.len() as f64;
    let middle = |s: &[Side]| scaled(n, s.iter().fold([0.0; 3], |m, s| add(m, s.centre)));
    let (ma, mb) = (middle(a), middle(b));
    let mut m = [[0.0; 3]; 3];
    let mut pair = |u: [f64; 3], v: [f64; 3]| {
        for r in 0..3 {
            for c in 0..3 {
                m[r][c] += u[r] * v[c];
            }
        }
    };
    for (a, b) in a.iter().zip(b) {
        let scale = 1.0 / length(a.area).sqrt().max(f64::MIN_POSITIVE);
        pair(sub(a.centre, ma), sub(b.centre, mb));
        pair(scaled(scale, a.area), scaled(-scale, b.area));
        if corners {
            pair(sub(a.corner, a.centre), sub(b.corner, b.centre));
        }
    }
    let [w, x, y, z] = largest_eigenvector([
        [m[0][0] + m[1][1] + m[2][2], m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]],
        [m[1][2] - m[2][1], m[0][0] - m[1][1] - m[2][2], m[0][1] + m[1][0], m[2][0] + m[0][2]],
        [m[2][0] - m[0][2], m[0][1] + m[1][0], m[1][1] - m[0][0] - m[2][2], m[1][2] + m[2][1]],
        [m[0][1] - m[1][0], m[2][0] + m[0][2], m[1][2] + m[2][1], m[2][2] - m[0][0] - m[1][1]],
    ]);
    let columns = [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), w * w - x * x - y * y + z * z],
    ];
    from_columns(columns, ma, mb)
}

/// The unit eigenvector of a symmetric matrix's largest eigenvalue, by Jacobi's rotations.
fn largest_eigenvector(mut a: [[f64; 4]; 4]) -> [f64; 4] {
    let mut v = [[0.0; 4]; 4];
    (0..4).for_each(|i| v[i][i] = 1.0);
    for _ in 0..30 {
        for p in 0..3 {
            for q in p + 1..4 {
                if a[p][q] == 0.0 {
                    continue;
                }
                let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                let mix = |x: f64, y: f64| (c * x - s * y, s * x + c * y);
                for row in a.iter_mut().chain(&mut v) {
                    (row[p], row[q]) = mix(row[p], row[q]);
                }
                let (rp, rq) = (a[p], a[q]);
                for (k, (x, y)) in rp.into_iter().zip(rq).enumerate() {
                    (a[p][k], a[q][k]) = mix(x, y);
                }
            }
        }
    }
    let largest = (1..4).fold(0, |l, i| if a[i][i] > a[l][l] { i } else { l });
    v.map(|row| row[largest])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples::block;

    /// A quarter of a ring, n cells round, its ends the patches 0 and 1, turned and moved somewhere.
    fn sector(n: [usize; 3]) -> (Mesh, [f64; 3], [f64; 3]) {
        let mut mesh = block(n, [1.0; 3]);
        // coupled faces begin at corners that lie on each other
        for (f, g) in mesh.patches[0].faces.clone().zip(mesh.patches[1].faces.clone()) {
            let first = mesh.points[mesh.faces.get(f)[0] as usize];
            let same = |c: &u32| mesh.points[*c as usize][1..] == first[1..];
            let at = mesh.faces.get(g).iter().position(same).unwrap();
            mesh.faces.corners[4 * g..4 * g + 4].rotate_left(at);
        }
        let (axis, centre) = (unit([1.0, 2.0, -2.0]).unwrap(), [3.0, -1.0, 0.5]);
        let e = unit(cross(axis, [0.0, 0.0, 1.0])).unwrap();
        let f = cross(axis, e);
        for x in &mut mesh.points {
            let (angle, r, h) = (x[0] * 0.7, 1.0 + x[1], x[2]);
            *x = add(centre, add(scaled(h, axis), add(scaled(r * angle.cos(), e), scaled(r * angle.sin(), f))));
        }
        (mesh, axis, centre)
    }

    #[test]
    fn the_rotation_of_a_sector_is_found_with_and_without_its_axis() {
        for n in [[3, 4, 5], [2, 1, 1], [2, 3, 1]] {
            let (mesh, axis, centre) = sector(n);
            let (low, high) = (mesh.patches[0].faces.clone(), mesh.patches[1].faces.clone());
            let exact = {
                let (c, s) = (0.7_f64.cos(), 0.7_f64.sin());
                move |v: [f64; 3]| {
                    add(add(scaled(c, v), scaled(s, cross(axis, v))), scaled(dot(v, axis) * (1.0 - c), axis))
                }
            };
            let told = Told { axis: Some(axis), centre: Some(centre), ..Told::default() };
            for told in [told, Told::default()] {
                let carry = face_by_face(&mesh, low.clone(), high.clone(), &told).unwrap();
                for v in [[1.0, 0.0, 0.0], [0.3, -2.0, 0.7]] {
                    assert!(length(sub(carry.vector(v), exact(v))) < 1e-13, "{n:?}");
                    let x = add(centre, exact(sub(v, centre)));
                    assert!(length(sub(carry.point(v), x)) < 1e-12, "{n:?}");
                }
            }
        }
    }

    #[test]
    fn a_translation_is_found_and_sides_that_do_not_fit_are_refused() {
        let mesh = block([3, 2, 2], [3.0, 1.0, 1.0]);
        let patch = |i: usize| mesh.patches[i].faces.clone();
        let carry = face_by_face(&mesh, patch(0), patch(1), &Told::default()).unwrap();
        assert_eq!(carry, Carry::by([3.0, 0.0, 0.0]));
        assert_eq!(between_areas(&mesh, patch(1), patch(0), &Told::default()).unwrap(), Carry::by([-3.0, 0.0, 0.0]));
        let e = face_by_face(&mesh, patch(0), patch(2), &Told::default()).unwrap_err();
        assert!(e.contains("has 4 faces, and its other side 6"), "{e}");
        let mut bent = mesh.clone();
        bent.points[3][1] += 0.1;
        let e = face_by_face(&bent, patch(0), patch(1), &Told::default()).unwrap_err();
        assert!(e.contains("do not lie on"), "{e}");
    }

    #[test]
    fn sides_that_cover_each_other_need_an_axis_to_turn() {
        let (mesh, axis, centre) = sector([2, 3, 1]);
        let (low, high) = (mesh.patches[0].faces.clone(), mesh.patches[1].faces.clone());
        assert!(between_areas(&mesh, low.clone(), high.clone(), &Told::default()).is_err());
        let told = Told { axis: Some(axis), centre: Some(centre), ..Told::default() };
        let carry = between_areas(&mesh, low.clone(), high.clone(), &told).unwrap();
        let by_faces = face_by_face(&mesh, low, high, &told).unwrap();
        for r in 0..3 {
            assert!(length(sub(carry.rotation[r], by_faces.rotation[r])) < 1e-13);
        }
    }
}
