//! Meshes to test with.

use crate::{Mesh, Patch, PatchKind, Polygons};

/// A box of `n` cells and the given sides, one corner at the origin; x runs fastest. Six walls: x-, x+, y-, y+, z-, z+.
pub(crate) fn block(n: [usize; 3], sides: [f64; 3]) -> Mesh {
    let point = |i: usize, j: usize, k: usize| (i + (n[0] + 1) * (j + (n[1] + 1) * k)) as u32;
    let cell = |at: [usize; 3]| (at[0] + n[0] * (at[1] + n[1] * at[2])) as u32;
    let mut mesh = Mesh { cells: n[0] * n[1] * n[2], ..Mesh::default() };
    mesh.faces.starts.push(0);
    for k in 0..=n[2] {
        for j in 0..=n[1] {
            for i in 0..=n[0] {
                let along = |c: usize, m: usize| sides[c] * m as f64 / n[c] as f64;
                mesh.points.push([along(0, i), along(1, j), along(2, k)]);
            }
        }
    }
    // the face of a cell across `axis` on its upper side, seen from there
    let upper = |[i, j, k]: [usize; 3], axis: usize| match axis {
        0 => [point(i + 1, j, k), point(i + 1, j + 1, k), point(i + 1, j + 1, k + 1), point(i + 1, j, k + 1)],
        1 => [point(i, j + 1, k), point(i, j + 1, k + 1), point(i + 1, j + 1, k + 1), point(i + 1, j + 1, k)],
        _ => [point(i, j, k + 1), point(i + 1, j, k + 1), point(i + 1, j + 1, k + 1), point(i, j + 1, k + 1)],
    };
    let cells = || (0..mesh.cells).map(|c| [c % n[0], c / n[0] % n[1], c / n[0] / n[1]]);
    let mut faces = Polygons { starts: vec![0], corners: vec![] };
    let (mut owner, mut neighbour, mut patches) = (vec![], vec![], vec![]);
    let mut push = |corners: [u32; 4], of: u32| {
        faces.corners.extend(corners);
        faces.starts.push(faces.corners.len() as u32);
        owner.push(of);
    };
    for at in cells() {
        for axis in 0..3 {
            if at[axis] + 1 < n[axis] {
                push(upper(at, axis), cell(at));
                let mut next = at;
                next[axis] += 1;
                neighbour.push(cell(next));
            }
        }
    }
    let mut start = neighbour.len();
    for (side, name) in ["x-", "x+", "y-", "y+", "z-", "z+"].into_iter().enumerate() {
        let axis = side / 2;
        let mut count = 0;
        for at in cells() {
            if side % 2 == 1 && at[axis] + 1 == n[axis] {
                push(upper(at, axis), cell(at));
                count += 1;
            }
            if side % 2 == 0 && at[axis] == 0 {
                let mut face = upper(at, axis);
                let step = [1, n[0] + 1, (n[0] + 1) * (n[1] + 1)][axis] as u32;
                face.iter_mut().for_each(|p| *p -= step);
                face.reverse();
                push(face, cell(at));
                count += 1;
            }
        }
        patches.push(Patch { name: name.into(), groups: vec![], kind: PatchKind::Wall, faces: start..start + count });
        start += count;
    }
    (mesh.faces, mesh.owner, mesh.neighbour, mesh.patches) = (faces, owner, neighbour, patches);
    mesh
}

/// The same, with every point inside the bounds of the mesh moved by up to `by` of a cell's smallest side.
pub(crate) fn shaken(mut mesh: Mesh, by: f64, seed: u64) -> Mesh {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut draw = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    };
    let mut outer = vec![false; mesh.points.len()];
    for f in mesh.neighbour.len()..mesh.faces.len() {
        mesh.faces.get(f).iter().for_each(|p| outer[*p as usize] = true);
    }
    let a = mesh.points[mesh.faces.corners[0] as usize];
    let b = mesh.points[mesh.faces.corners[1] as usize];
    let side = (0..3).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max);
    for (point, outer) in mesh.points.iter_mut().zip(outer) {
        if !outer {
            point.iter_mut().for_each(|x| *x += by * side * draw());
        }
    }
    mesh
}
