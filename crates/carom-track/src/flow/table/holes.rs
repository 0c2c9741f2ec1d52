//! Nodes where a file says that its values do not hold: inside a body, outside a mesh that was resampled.

/// Gives each node that is not valid the mean of its neighbours that are, layer after layer, and says so. A cell across the edge of
/// what is valid then holds what its valid nodes say, and never what a file puts where it has no data.
pub(super) fn fill<const N: usize>(
    size: [usize; 3],
    nodes: &mut [[f64; N]],
    valid: &mut [bool],
) -> Result<Option<String>, String> {
    let all = valid.len();
    let holes = valid.iter().filter(|v| !**v).count();
    if holes == 0 {
        return Ok(None);
    }
    if holes == all {
        return Err("no node is valid".to_owned());
    }
    let stride = [size[1] * size[2], size[2], 1];
    let neighbours = |n: usize| {
        (0..3).flat_map(move |c| {
            let at = n / stride[c] % size[c];
            [(at > 0).then(|| n - stride[c]), (at + 1 < size[c]).then(|| n + stride[c])].into_iter().flatten()
        })
    };
    let mut layer: Vec<usize> = (0..all).filter(|n| !valid[*n] && neighbours(*n).any(|near| valid[near])).collect();
    while !layer.is_empty() {
        let mean = |n: &usize| {
            let (mut sum, mut count) = ([0.0; N], 0.0);
            for near in neighbours(*n).filter(|near| valid[*near]) {
                count += 1.0;
                for (s, q) in sum.iter_mut().zip(nodes[near]) {
                    *s += q;
                }
            }
            sum.map(|s| s / count)
        };
        let means: Vec<[f64; N]> = layer.iter().map(mean).collect();
        for (n, mean) in layer.iter().zip(means) {
            (nodes[*n], valid[*n]) = (mean, true);
        }
        layer = layer.iter().flat_map(|n| neighbours(*n)).filter(|near| !valid[*near]).collect();
        layer.sort_unstable();
        layer.dedup();
    }
    Ok(Some(format!(
        "{holes} of {all} nodes are not valid by the file's mask: there the values of the nearest valid ones hold"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_take_what_is_beside_them() {
        let mut nodes: Vec<[f64; 5]> = [1.0, 0.0, 0.0, 4.0].map(|u| [u, 0.0, 0.0, 0.0, 0.0]).to_vec();
        let mut valid = vec![true, false, false, true];
        let note = fill([4, 1, 1], &mut nodes, &mut valid).expect("some are valid");
        assert_eq!(nodes.iter().map(|n| n[0]).collect::<Vec<_>>(), [1.0, 1.0, 4.0, 4.0]);
        assert!(note.is_some_and(|n| n.starts_with("2 of 4 nodes")));
        assert!(fill([1, 1, 2], &mut nodes[..2], &mut [false, false]).is_err());
    }
}
