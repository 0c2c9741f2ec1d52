//! Cells that agree with their neighbours on which way their common faces turn.

use super::sides::{NONE, Sides};

/// How two cells list the corners of their common face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    /// One as the other backwards: they lie on both sides of it.
    Against,
    /// In the same order: they would lie on the same side.
    Along,
    /// In orders that are no polygon's.
    Neither,
}

fn way(a: &[u32], b: &[u32]) -> Way {
    let n = a.len();
    let Some(place) = b.iter().position(|p| *p == a[0]) else { return Way::Neither };
    let along = |i: usize| b[(place + i) % n] == a[i];
    let against = |i: usize| b[(place + n - i) % n] == a[i];
    match (1..n).all(against) {
        true => Way::Against,
        false if (1..n).all(along) => Way::Along,
        false => Way::Neither,
    }
}

/// Turns over cells that lie among others the wrong way round: their volume is negative, and the others tell what their outside is. `may` says
/// of each cell whether it may be so: of those whose order of corners is certain, only the ones that were turned. Refuses what then
/// still is in the way.
pub(super) fn agree(sides: &mut Sides, solids: &[u32], may: &[bool], notes: &mut Vec<String>) -> Result<(), String> {
    let cells = sides.cells();
    let mut odd: Vec<u32> = Vec::new();
    for f in 0..sides.faces.len() {
        let other = sides.other[f];
        if other == NONE || (other as usize) < f {
            continue;
        }
        let two = [cells[f], cells[other as usize]];
        match way(sides.faces.get(f), sides.faces.get(other as usize)) {
            Way::Against => {}
            Way::Along => odd.extend(two),
            Way::Neither => {
                let [a, b] = two.map(|c| solids[c as usize]);
                return Err(format!(
                    "cells {a} and {b} list the corners of their common face in orders that do not fit"
                ));
            }
        }
    }
    if odd.is_empty() {
        return Ok(());
    }
    odd.sort_unstable();
    odd.dedup();
    let mut turned = Vec::new();
    for &cell in odd.iter().filter(|c| may[**c as usize]) {
        let (along, against) = count(sides, cell);
        if along > against {
            for f in sides.starts[cell as usize]..sides.starts[cell as usize + 1] {
                let (from, to) = (sides.faces.starts[f as usize] as usize, sides.faces.starts[f as usize + 1] as usize);
                sides.faces.corners[from..to].reverse();
            }
            turned.push(solids[cell as usize]);
        }
    }
    if let Some(&cell) = odd.iter().find(|c| count(sides, **c).0 > 0) {
        let faces = sides.starts[cell as usize]..sides.starts[cell as usize + 1];
        let along = |f: &u32| sides.other[*f as usize] != NONE && is_along(sides, *f);
        let other = faces.into_iter().find(along).map_or(cell, |f| cells[sides.other[f as usize] as usize]);
        let [a, b] = [cell, other].map(|c| solids[c as usize]);
        return Err(format!("cells {a} and {b} lie on the same side of their common face: they overlap"));
    }
    let first: Vec<String> = turned.iter().take(8).map(u32::to_string).collect();
    let more = if turned.len() > 8 { ", …" } else { "" };
    notes.push(format!("{} cells have negative volumes: {}{more}", turned.len(), first.join(", ")));
    Ok(())
}

fn is_along(sides: &Sides, face: u32) -> bool {
    way(sides.faces.get(face as usize), sides.faces.get(sides.other[face as usize] as usize)) == Way::Along
}

/// How many of a cell's faces turn along with the neighbours', and how many against.
fn count(sides: &Sides, cell: u32) -> (usize, usize) {
    let inner =
        (sides.starts[cell as usize]..sides.starts[cell as usize + 1]).filter(|f| sides.other[*f as usize] != NONE);
    inner.fold((0, 0), |(a, b), f| if is_along(sides, f) { (a + 1, b) } else { (a, b + 1) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways() {
        assert_eq!(way(&[1, 2, 3, 4], &[3, 2, 1, 4]), Way::Against);
        assert_eq!(way(&[1, 2, 3, 4], &[3, 4, 1, 2]), Way::Along);
        assert_eq!(way(&[1, 2, 3, 4], &[1, 3, 2, 4]), Way::Neither);
        assert_eq!(way(&[1, 2, 3], &[2, 1, 3]), Way::Against);
        assert_eq!(way(&[1, 2, 3], &[2, 3, 1]), Way::Along);
    }
}
