//! The arrays of a file that are used, chosen by name before any is read.

use super::cells::is_solid;
use super::{Options, grid::Grid};
use crate::{Error, Wanted};
use carom_table::quoted;
use std::path::Path;

/// How many quantities there are.
pub(super) const COUNT: usize = 7;

/// A quantity, in the order of [`Names::all`](crate::Names::all): its name, how many components it has, and the names that programs write, the likeliest first.
pub(super) const QUANTITIES: [(&str, usize, &[&str]); COUNT] = [
    ("velocity", 3, &["u", "velocity", "velocity_field"]),
    (
        "k",
        1,
        &[
            "k",
            "tke",
            "turb_kin_energy",
            "turb_kinetic_energy",
            "turbulent_kinetic_energy",
            "turbulence_kinetic_energy",
            "turbulentkineticenergy",
        ],
    ),
    ("epsilon", 1, &["epsilon", "eps", "turb_diss_rate", "turbulent_dissipation_rate", "turbulence_eddy_dissipation"]),
    ("omega", 1, &["omega", "specific_diss_rate", "specific_dissipation_rate", "turbulence_eddy_frequency"]),
    ("density", 1, &["rho", "density"]),
    ("temperature", 1, &["t", "temperature"]),
    ("pressure", 1, &["p", "pressure"]),
];

/// Values of the array that names patches.
#[derive(Clone, Debug)]
pub(super) enum Labels {
    Numbers(Vec<f64>),
    Texts(Vec<String>),
}

impl Labels {
    pub fn name(&self, cell: usize) -> Option<String> {
        match self {
            Self::Numbers(all) => all.get(cell).map(f64::to_string),
            Self::Texts(all) => all.get(cell).cloned(),
        }
    }
}

/// The arrays that were read.
#[derive(Clone, Debug, Default)]
pub(super) struct Data {
    /// Of points, for each quantity.
    pub points: [Option<Vec<f64>>; COUNT],
    /// Of cells, for each quantity.
    pub cells: [Option<Vec<f64>>; COUNT],
    pub labels: Option<Labels>,
    /// Names of the arrays that are not used.
    pub others: Vec<String>,
    /// How many cells are copies of another piece's.
    pub ghosts: usize,
}

/// An array as its file describes it.
#[derive(Clone, Debug)]
pub(super) struct Described {
    pub name: String,
    pub components: usize,
}

/// Arrays of points and of cells in a file.
pub(super) trait Arrays {
    /// All of them: those of points, those of cells.
    fn listed(&self) -> &[Vec<Described>; 2];
    /// The values of one.
    fn read(&mut self, of_cells: bool, index: usize) -> Result<Vec<f64>, String>;
    /// Names of the cell arrays of texts.
    fn text_names(&self) -> Vec<String>;
    /// The texts of a cell array of that name.
    fn texts(&mut self, name: &str) -> Option<Result<Vec<String>, String>>;
}

/// Reads what is used of the arrays of a grid whose cells are known. Ghosts among its cells are left out.
pub(super) fn gather(grid: &mut Grid, arrays: &mut dyn Arrays, path: &Path, options: &Options) -> Result<(), Error> {
    let fail = |what: String| Error::file(path, what);
    let listed = arrays.listed().clone();
    let solid = grid.has_solids();
    let mut used = [vec![false; listed[0].len()], vec![false; listed[1].len()]];
    let mut places = [None; COUNT];
    for (q, place) in places.iter_mut().enumerate() {
        *place = find(&listed, q, path, options, solid)?;
    }
    // the others are taken where the velocity is, if they are there
    let by_cells = matches!(places[0], Some((true, _)));
    for (q, place) in places.iter_mut().enumerate().skip(1) {
        if let Some((false, i)) = *place
            && by_cells
            && let Some(other) =
                listed[1].iter().position(|a| a.name == listed[0][i].name && a.components == QUANTITIES[q].1)
        {
            *place = Some((true, other));
        }
    }
    for (q, place) in places.iter().copied().enumerate() {
        let Some((of_cells, i)) = place else { continue };
        used[usize::from(of_cells)][i] = true;
        let mut values = arrays.read(of_cells, i).map_err(fail)?;
        if q == 0 && listed[usize::from(of_cells)][i].components == 2 {
            values = values.as_chunks::<2>().0.iter().flat_map(|[u, v]| [*u, *v, 0.0]).collect();
        }
        (if of_cells { &mut grid.data.cells } else { &mut grid.data.points })[q] = Some(values);
    }
    masks(grid, arrays, &listed, &mut used).map_err(fail)?;
    // what only ghosts have, or no cell, is of no matter
    grid.check_places().map_err(fail)?;
    for (q, place) in places.into_iter().enumerate() {
        let Some((of_cells, i)) = place else { continue };
        finite(grid, q, of_cells, &listed[usize::from(of_cells)][i].name).map_err(fail)?;
    }
    if let Some(name) = &options.patches {
        let number = listed[1].iter().position(|a| a.name == *name && a.components == 1);
        grid.data.labels = match (number, arrays.texts(name)) {
            (Some(i), _) => {
                used[1][i] = true;
                Some(Labels::Numbers(arrays.read(true, i).map_err(fail)?))
            }
            (None, Some(texts)) => Some(Labels::Texts(texts.map_err(fail)?)),
            (None, None) => None,
        };
    }
    let names = |list: usize, taken: bool| {
        let all = listed[list].iter().zip(&used[list]);
        all.filter(move |(_, used)| **used == taken).map(|(a, _)| a.name.clone())
    };
    let taken: Vec<String> = names(0, true).chain(names(1, true)).collect();
    let texts = arrays.text_names().into_iter().filter(|n| options.patches.as_ref() != Some(n));
    grid.data.others = names(0, false).chain(names(1, false)).chain(texts).filter(|n| !taken.contains(n)).collect();
    grid.data.others.sort();
    grid.data.others.dedup();
    Ok(())
}

/// Where a quantity is: whether among the cells' arrays, and which.
fn find(
    listed: &[Vec<Described>; 2],
    quantity: usize,
    path: &Path,
    options: &Options,
    solid: bool,
) -> Result<Option<(bool, usize)>, Error> {
    let (_, components, aliases) = QUANTITIES[quantity];
    // of a surface of solid cells, only what its faces hold is of use
    let lists: &[usize] = if solid { &[0, 1] } else { &[1, 0] };
    let place = |fits: &dyn Fn(&str) -> bool| {
        lists.iter().find_map(|list| {
            // of polygons, the velocity may be that in their plane
            let fits_width = |n: usize| n == components || (quantity == 0 && n == 2 && !solid);
            let i = listed[*list].iter().position(|a| fits_width(a.components) && fits(&a.name))?;
            Some((*list == 1, i))
        })
    };
    let missing = |name: &str| {
        let describe =
            |a: &Described| if a.components == 1 { a.name.clone() } else { format!("{} ({})", a.name, a.components) };
        let mut there: Vec<String> = listed.iter().flatten().map(describe).collect();
        there.sort();
        there.dedup();
        Error::Missing { path: path.to_owned(), kind: "field", name: name.to_owned(), there }
    };
    let names = options.names.all();
    match names[quantity] {
        Wanted::Named(name) => {
            let found = place(&|n| n == name);
            return if found.is_none() && solid { Err(missing(name)) } else { Ok(found) };
        }
        Wanted::None => return Ok(None),
        Wanted::Usual => {}
    }
    let taken = |name: &str| names.contains(&Wanted::Named(name));
    let found = aliases.iter().find_map(|alias| place(&|n| plain(n) == *alias && !taken(n)));
    if found.is_none() && solid && quantity == 0 { Err(missing("U")) } else { Ok(found) }
}

/// Refuses values that are none in solid cells or at their points.
fn finite(grid: &Grid, quantity: usize, of_cells: bool, name: &str) -> Result<(), String> {
    let data = if of_cells { &grid.data.cells } else { &grid.data.points };
    let values = data[quantity].as_deref().unwrap_or_default();
    if values.iter().all(|x| x.is_finite()) {
        return Ok(());
    }
    let used = if of_cells { grid.kinds.iter().map(|k| is_solid(*k)).collect() } else { grid.used(is_solid) };
    let tuples = values.chunks(QUANTITIES[quantity].1).zip(used).enumerate().filter(|(_, (_, used))| *used);
    for (n, (tuple, _)) in tuples {
        if let Some(x) = tuple.iter().find(|x| !x.is_finite()) {
            let what = if of_cells { "cell" } else { "point" };
            return Err(format!("{} is {x} in {what} {n}: NaN or infinity is no value", quoted(name)));
        }
    }
    Ok(())
}

/// A name in lower case, with underscores for what stands between words.
fn plain(name: &str) -> String {
    name.trim().to_ascii_lowercase().replace([' ', '-', '.'], "_")
}

/// Leaves ghosts out, and refuses what is hidden or not valid.
fn masks(
    grid: &mut Grid,
    arrays: &mut dyn Arrays,
    listed: &[Vec<Described>; 2],
    used: &mut [Vec<bool>; 2],
) -> Result<(), String> {
    for (list, of_cells) in [(0, false), (1, true)] {
        for (i, array) in listed[list].iter().enumerate().filter(|(_, a)| a.components == 1) {
            let name = array.name.to_ascii_lowercase();
            if !matches!(name.as_str(), "vtkghosttype" | "vtkghostlevels" | "vtkvalidpointmask" | "vtkvalidcellmask") {
                continue;
            }
            used[list][i] = true;
            for (n, value) in arrays.read(of_cells, i)?.into_iter().enumerate() {
                let bits = value as u32;
                let (ghost, hidden) = match name.as_str() {
                    // vtkDataSetAttributes: a copy is 1; of points, hidden is 2; of cells, hidden is 32 and refined 8
                    "vtkghosttype" => (bits & 1 != 0, bits & if of_cells { 32 | 8 } else { 2 } != 0),
                    "vtkghostlevels" => (value > 0.0, false),
                    _ => (false, value == 0.0),
                };
                if ghost && of_cells {
                    let kind = grid.kinds.get_mut(n).map(std::mem::take);
                    grid.data.ghosts += usize::from(kind.is_some_and(is_solid));
                } else if hidden && (!of_cells || grid.kinds.get(n).is_some_and(|k| *k != 0)) {
                    let what = if of_cells { "cell" } else { "point" };
                    return Err(format!(
                        "{what} {n} is hidden or not valid ({}): a mesh without holes is wanted",
                        array.name
                    ));
                }
            }
        }
    }
    Ok(())
}
