//! What is seen of a wall of triangles along z: its rims, and the edges where it turns away.

use crate::geometry::Mesh;
use crate::vector::{Vec3, norm, sub};
use std::collections::HashMap;

/// Lines kept, the longest of them: what a picture bears.
const MOST: usize = 4000;

/// A line across the picture, m.
pub type Line = [[f64; 2]; 2];

/// The lines, longest first where there are too many.
pub fn outline(mesh: &Mesh) -> Vec<Line> {
    let mut numbers: HashMap<[u64; 3], u32> = HashMap::new();
    let mut points: Vec<Vec3> = Vec::new();
    // an edge by its ends, and on which side of it its triangle lies as seen along z
    let mut edges: Vec<(u32, u32, Side)> = Vec::new();
    for (_, triangle) in mesh.triangles() {
        let corners = triangle.map(|corner| {
            // plus zero: −0 and 0 are one place
            *numbers.entry(corner.map(|c| (c + 0.0).to_bits())).or_insert_with(|| {
                points.push(corner);
                (points.len() - 1) as u32
            })
        });
        for i in 0..3 {
            let ([a, b, c], [from, to, _]) = (
                [triangle[i], triangle[(i + 1) % 3], triangle[(i + 2) % 3]],
                [corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]],
            );
            if from <= to {
                edges.push((from, to, side(a, b, c)));
            } else {
                edges.push((to, from, side(b, a, c)));
            }
        }
    }
    edges.sort_unstable();
    let mut lines: Vec<Line> = edges
        .chunk_by(|a, b| (a.0, a.1) == (b.0, b.1))
        .filter(|same| is_seen(&same.iter().map(|e| e.2).collect::<Vec<_>>()))
        .filter_map(|same| same.first())
        .map(|(from, to, _)| [*from, *to].map(|p| [points[p as usize][0], points[p as usize][1]]))
        .filter(|line| line[0] != line[1])
        .collect();
    if lines.len() > MOST {
        let square = |l: &Line| [0, 1].map(|c| (l[1][c] - l[0][c]) * (l[1][c] - l[0][c])).iter().sum::<f64>();
        lines.sort_by(|a, b| square(b).total_cmp(&square(a)));
        lines.truncate(MOST);
    }
    lines
}

/// On which side of an edge a triangle is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Side {
    Left,
    /// It is seen from its edge.
    Neither,
    Right,
}

fn side(from: Vec3, to: Vec3, third: Vec3) -> Side {
    let (along, off) = (sub(to, from), sub(third, from));
    let across = along[0] * off[1] - along[1] * off[0];
    let slack = 1e-5 * norm(along) * norm(off);
    match across {
        a if a > slack => Side::Left,
        a if a < -slack => Side::Right,
        _ => Side::Neither,
    }
}

/// A rim has one triangle; where the wall turns away, both are seen on one side.
fn is_seen(sides: &[Side]) -> bool {
    match sides {
        [_] => true,
        [Side::Neither, Side::Neither] => false,
        [a, b] => a == b || *a == Side::Neither || *b == Side::Neither,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_seen_as_its_rectangle() {
        let mesh = Mesh::block([0.0, 0.0, 0.0], [2.0, 1.0, 3.0]).expect("a block");
        let lines = outline(&mesh);
        // the four edges of the lower and of the upper face, none across them
        assert_eq!(lines.len(), 8);
        assert!(lines.iter().all(|[a, b]| a[0] == b[0] || a[1] == b[1]), "{lines:?}");
    }

    #[test]
    fn an_open_pipe_is_seen_as_its_sides_and_its_rims() {
        const N: usize = 24;
        let at = |i: usize, x: f64| {
            let angle = std::f64::consts::TAU * (i % N) as f64 / N as f64;
            [x, angle.cos(), angle.sin()]
        };
        let walls = |i: usize| [[at(i, 0.0), at(i + 1, 0.0), at(i, 5.0)], [at(i + 1, 0.0), at(i + 1, 5.0), at(i, 5.0)]];
        let mesh = Mesh::new(&(0..N).flat_map(walls).collect::<Vec<_>>()).expect("a pipe");
        let lines = outline(&mesh);
        let sides: Vec<_> = lines.iter().filter(|[a, b]| a[0] != b[0]).collect();
        assert_eq!(sides.len(), 2, "{lines:?}");
        assert!(sides.iter().all(|[a, b]| a[1] == b[1] && (a[1].abs() - 1.0).abs() < 1e-12));
        assert_eq!(lines.len(), 2 + 2 * N);
    }
}
