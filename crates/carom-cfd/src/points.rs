//! Points that faces use.

/// Numbers the points anew that corners name; the numbers they had, if not all of so many are named.
pub(crate) fn renumber(corners: &mut [u32], points: usize) -> Option<Vec<u32>> {
    let mut number = vec![u32::MAX; points];
    corners.iter().for_each(|c| number[*c as usize] = 0);
    if number.iter().all(|n| *n == 0) {
        return None;
    }
    let mut kept = Vec::new();
    for (p, n) in number.iter_mut().enumerate().filter(|(_, n)| **n == 0) {
        *n = kept.len() as u32;
        kept.push(p as u32);
    }
    corners.iter_mut().for_each(|c| *c = number[*c as usize]);
    Some(kept)
}
