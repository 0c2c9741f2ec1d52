//! Which arrays of a VTK file are used, chosen by name before any is read, and how they become a table.

use super::columns::{DENSITY_ALONE, Validity, alias};
use super::holes::fill;
use super::{Given, Row, Table};
use carom_table::{clipped, quoted};

/// An array as its file describes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Described {
    pub name: String,
    pub components: usize,
}

/// The arrays that are used, by their places in the list.
#[derive(Clone, Debug, Default)]
pub(super) struct Chosen {
    /// One vector, or up to three scalars: for each component an array and the place in its tuple.
    velocity: [Option<(usize, usize)>; 3],
    k: Option<usize>,
    /// ε, or ω where that is said.
    rate: Option<usize>,
    by_frequency: bool,
    temperature: Option<usize>,
    density: Option<usize>,
    masks: Vec<(usize, Validity)>,
    notes: Vec<String>,
    /// Whether the data are of cells.
    by_cell: bool,
}

impl Chosen {
    /// Of point data, or of cell data.
    pub fn of(arrays: &[Described], cells: bool) -> Result<Self, String> {
        let mut chosen = Self { velocity: velocity(arrays)?, by_cell: cells, ..Self::default() };
        if cells {
            chosen.notes.push("its data are of cells: their values hold at the middles".to_owned());
        }
        let scalar = |key: &str| {
            let own = |a: &Described| if key == "T" { a.name == key } else { a.name.eq_ignore_ascii_case(key) };
            arrays
                .iter()
                .position(|a| a.components == 1 && own(a))
                .or_else(|| arrays.iter().position(|a| a.components == 1 && alias(&a.name) == Some(key)))
        };
        let (k, epsilon, omega) = (scalar("k"), scalar("epsilon"), scalar("omega"));
        match (k, epsilon.or(omega)) {
            (Some(k), Some(rate)) => {
                (chosen.k, chosen.rate, chosen.by_frequency) = (Some(k), Some(rate), epsilon.is_none());
            }
            (None, None) => {}
            _ => chosen.notes.push("turbulence is left out: k and epsilon (or omega) are wanted together".to_owned()),
        }
        (chosen.temperature, chosen.density) = (scalar("T"), scalar("rho"));
        if chosen.temperature.is_none() && chosen.density.take().is_some() {
            chosen.notes.push(DENSITY_ALONE.to_owned());
        }
        let masks = arrays.iter().enumerate().filter(|(_, a)| a.components == 1);
        chosen.masks = masks.filter_map(|(i, a)| Some((i, Validity::of(&a.name, cells)?))).collect();
        let used = chosen.used();
        let idle: Vec<&str> =
            (0..arrays.len()).filter(|i| !used.contains(i)).map(|i| arrays[i].name.as_str()).collect();
        if !idle.is_empty() {
            let names: Vec<_> = idle.iter().take(8).map(|n| clipped(n)).collect();
            let rest = if idle.len() > 8 { format!(" and {} more", idle.len() - 8) } else { String::new() };
            chosen.notes.push(format!("not used: {}{rest}", names.join(", ")));
        }
        Ok(chosen)
    }

    /// The arrays to read.
    pub fn used(&self) -> Vec<usize> {
        let velocity = self.velocity.iter().flatten().map(|(array, _)| *array);
        let scalars = [self.k, self.rate, self.temperature, self.density].into_iter().flatten();
        let mut used: Vec<usize> = velocity.chain(scalars).chain(self.masks.iter().map(|m| m.0)).collect();
        used.sort_unstable();
        used.dedup();
        used
    }

    /// Puts axes and the arrays that were read together: each array has a tuple for every node, x running fastest. `hidden`
    /// says of each node whether something else hides it.
    pub fn table(
        mut self,
        axes: [Vec<f64>; 3],
        arrays: &[Described],
        values: &[Option<Vec<f64>>],
        hidden: Option<&[bool]>,
    ) -> Result<Table, String> {
        rising(&axes)?;
        let given = axes.each_ref().map(Vec::len);
        let (axes, source) = if self.by_cell { (middles(axes), cells(given)) } else { (axes, given) };
        let size = axes.each_ref().map(Vec::len);
        // a cell at the edge holds from its middle to its face
        let place = |i: usize, c: usize| if size[c] > source[c] { i.saturating_sub(1).min(source[c] - 1) } else { i };
        let of = |array: usize, n: usize, component: usize| {
            let width = arrays.get(array).map_or(1, |a| a.components);
            values
                .get(array)
                .and_then(Option::as_ref)
                .and_then(|v| v.get(n * width + component))
                .copied()
                .unwrap_or(f64::NAN)
        };
        let all = size[0] * size[1] * size[2];
        let (mut nodes, mut valid): (Vec<Row>, Vec<bool>) = (Vec::with_capacity(all), Vec::with_capacity(all));
        for i in 0..size[0] {
            for j in 0..size[1] {
                for l in 0..size[2] {
                    let n = place(i, 0) + source[0] * (place(j, 1) + source[1] * place(l, 2));
                    let holds = self.masks.iter().all(|(array, kind)| kind.holds(of(*array, n, 0)))
                        && hidden.is_none_or(|h| h.get(n) != Some(&true));
                    valid.push(holds);
                    if !holds {
                        nodes.push(Row::default());
                        continue;
                    }
                    let [u, v, w] = self.velocity.map(|c| c.map_or(0.0, |(array, component)| of(array, n, component)));
                    let k = self.k.map_or(0.0, |array| of(array, n, 0));
                    let rate = self.rate.map_or(0.0, |array| of(array, n, 0));
                    // ε = β* k ω (Wilcox, Turbulence Modeling for CFD), β* = 0.09
                    let epsilon = if self.by_frequency { 0.09 * k * rate } else { rate };
                    let [temperature, density] =
                        [self.temperature, self.density].map(|given| given.map_or(1.0, |array| of(array, n, 0)));
                    let node = [u, v, w, k, epsilon, temperature, density];
                    if let Some(bad) = node.iter().find(|c| !c.is_finite()) {
                        return Err(format!(
                            "{bad} at node ({i}, {j}, {l}), which no mask leaves out: NaN or infinity is no value"
                        ));
                    }
                    if k < 0.0 || epsilon < 0.0 {
                        return Err(format!("{} is negative somewhere", if k < 0.0 { "k" } else { "epsilon" }));
                    }
                    if temperature <= 0.0 || density <= 0.0 {
                        let which = if temperature <= 0.0 { "the temperature" } else { "the density" };
                        return Err(format!("{which} is not positive somewhere: K and kg/m3 are wanted"));
                    }
                    nodes.push(node);
                }
            }
        }
        self.notes.extend(fill(size, &mut nodes, &mut valid)?);
        let given = Given {
            turbulence: self.k.is_some(),
            temperature: self.temperature.is_some(),
            density: self.density.is_some(),
        };
        Ok(Table::new(axes, &nodes, given).noting(self.notes))
    }
}

/// The arrays of the velocity: by name, or the only vector there is, or a scalar for each component.
fn velocity(arrays: &[Described]) -> Result<[Option<(usize, usize)>; 3], String> {
    let vector = |i: usize| Ok([Some((i, 0)), Some((i, 1)), Some((i, 2))]);
    let vectors: Vec<usize> = (0..arrays.len()).filter(|i| arrays[*i].components == 3).collect();
    let named = |name: &str| vectors.iter().find(|i| arrays[**i].name.eq_ignore_ascii_case(name));
    match (named("velocity").or_else(|| named("u")), vectors.as_slice()) {
        (Some(i), _) | (None, [i]) => vector(*i),
        (None, []) => {
            let scalar =
                |key| arrays.iter().position(|a| a.components == 1 && alias(&a.name) == Some(key)).map(|i| (i, 0));
            let components = ["u", "v", "w"].map(scalar);
            if components[0].is_none() { Err("no vectors named velocity or U".to_owned()) } else { Ok(components) }
        }
        (None, several) => {
            let names: Vec<String> = several.iter().take(8).map(|i| quoted(&arrays[*i].name)).collect();
            Err(format!("no vectors named velocity or U among {}: give one of them that name", names.join(", ")))
        }
    }
}

/// Coordinates that do not rise are refused.
pub(super) fn rising(axes: &[Vec<f64>; 3]) -> Result<(), String> {
    if axes.iter().flatten().any(|x| !x.is_finite()) {
        return Err("NaN or infinity among the coordinates".to_owned());
    }
    match axes.iter().flat_map(|a| a.windows(2)).find(|w| w[0] >= w[1]) {
        Some(w) => Err(format!("coordinates must rise, but {} follows {}", w[1], w[0])),
        None => Ok(()),
    }
}

/// Cells along an axis of so many nodes.
pub(super) fn cells(nodes: [usize; 3]) -> [usize; 3] {
    nodes.map(|n| n.saturating_sub(1).max(1))
}

/// The middles of the cells, between the first face and the last.
fn middles(axes: [Vec<f64>; 3]) -> [Vec<f64>; 3] {
    axes.map(|a| match a[..] {
        [first, .., last] => {
            let middles = a.windows(2).map(|w| 0.5 * w[0] + 0.5 * w[1]);
            std::iter::once(first).chain(middles).chain([last]).collect()
        }
        _ => a,
    })
}

/// The nodes all of whose cells a mask of cells hides.
pub(super) fn hidden(nodes: [usize; 3], kind: Validity, mask: &[f64]) -> Vec<bool> {
    let size = cells(nodes);
    let holds = |c: [usize; 3]| mask.get(c[0] + size[0] * (c[1] + size[1] * c[2])).is_some_and(|v| kind.holds(*v));
    let mut hidden = Vec::with_capacity(nodes[0] * nodes[1] * nodes[2]);
    for l in 0..nodes[2] {
        for j in 0..nodes[1] {
            for i in 0..nodes[0] {
                let around = |n: usize, c: usize| n.saturating_sub(1)..(n + 1).min(size[c]);
                let mut near =
                    around(i, 0).flat_map(|a| around(j, 1).flat_map(move |b| around(l, 2).map(move |c| [a, b, c])));
                hidden.push(!near.any(holds));
            }
        }
    }
    hidden
}
