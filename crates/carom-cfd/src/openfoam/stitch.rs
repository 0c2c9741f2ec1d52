//! One mesh from the parts of several processors.

use std::collections::HashMap;

use super::boundary::Raw;
use super::layout::Layout;
use super::list;
use super::poly_mesh::Part;
use crate::geometry::vector::{length, sub};
use crate::{Error, Polygons};

/// Two faces that lie on each other may begin at corners this far apart, so that one of very many corners takes no time.
const SHIFTS: usize = 64;

/// Numbers that a part's cells, points and faces have in the whole.
#[derive(Debug, Default)]
struct Numbers {
    cells: Vec<u32>,
    points: Vec<u32>,
    /// One more than the number; negative where the face is turned.
    faces: Vec<i64>,
}

/// Where a part's cells and boundary lie in the whole.
#[derive(Debug)]
pub(super) struct Joint {
    /// Number of each cell; none: the same.
    pub(super) cells: Option<Vec<u32>>,
    /// Number of each face of the boundary; none: the same.
    pub(super) boundary: Option<Vec<u32>>,
    pub(super) inner: usize,
    pub(super) patches: Vec<Raw>,
    pub(super) count: usize,
}

/// Puts the parts together. The whole has no patches between processors.
pub(super) fn join(
    layout: &Layout,
    folder: &str,
    mut parts: Vec<Part>,
    notes: &mut Vec<String>,
) -> Result<(Part, Vec<Joint>), Error> {
    let alone = parts.len() == 1 && parts[0].patches.iter().all(|p| p.link.is_none());
    if let Some(whole) = parts.pop_if(|_| alone) {
        let (inner, patches, count) = (whole.neighbour.len(), whole.patches.clone(), whole.cells);
        return Ok((whole, vec![Joint { cells: None, boundary: None, inner, patches, count }]));
    }
    let bad = |what: String| Error::file(&layout.store.first().join(folder), what);
    let numbers = match told(layout, folder, &parts)? {
        Some(numbers) => numbers,
        None => {
            notes.push("the processors' parts are joined by their common faces, as no addressing fits them".into());
            by_faces(&parts).map_err(bad)?
        }
    };
    let whole = assemble(&parts, &numbers).map_err(bad)?;
    let joints = parts.into_iter().zip(numbers).map(|(part, numbers)| {
        let inner = part.neighbour.len();
        let boundary = numbers.faces[inner..].iter().map(|f| (f.unsigned_abs() - 1) as u32).collect();
        Joint { cells: Some(numbers.cells), boundary: Some(boundary), inner, patches: part.patches, count: part.cells }
    });
    Ok((whole, joints.collect()))
}

/// The numbers that files tell; none where they are not there or belong to another mesh.
fn told(layout: &Layout, folder: &str, parts: &[Part]) -> Result<Option<Vec<Numbers>>, Error> {
    let mut numbers: Vec<Numbers> = Vec::new();
    numbers.resize_with(parts.len(), Numbers::default);
    for name in ["cell", "point", "face"] {
        let found = layout.each(&format!("{folder}/{name}ProcAddressing"), |i, c| {
            let Some(n) = numbers.get_mut(i) else { return Ok(()) };
            match name {
                "cell" => n.cells = c.read(|scan| list::list(scan, c.format, parts[i].cells))?,
                "point" => n.points = c.read(|scan| list::list(scan, c.format, 0))?,
                _ => n.faces = c.read(|scan| list::list(scan, c.format, 0))?,
            }
            Ok(())
        })?;
        if !found {
            return Ok(None);
        }
    }
    let total = |count: fn(&Part) -> usize| parts.iter().map(count).sum::<usize>();
    let (cells, points, faces) = (total(|p| p.cells), total(|p| p.points.len()), total(|p| p.faces.len()));
    let fits = |(part, n): (&Part, &Numbers)| {
        n.cells.len() == part.cells
            && n.points.len() == part.points.len()
            && n.faces.len() == part.faces.len()
            && n.cells.iter().all(|c| (*c as usize) < cells)
            && n.points.iter().all(|p| (*p as usize) < points)
            && n.faces.iter().all(|f| *f != 0 && f.unsigned_abs() as usize <= faces)
    };
    let mut seen = vec![false; cells];
    let once = |c: u32| !std::mem::replace(&mut seen[c as usize], true);
    let all = parts.iter().zip(&numbers).all(fits) && numbers.iter().flat_map(|n| &n.cells).copied().all(once);
    Ok(all.then_some(numbers))
}

/// Numbers from the faces that parts have in common: face by face in order, turned.
fn by_faces(parts: &[Part]) -> Result<Vec<Numbers>, String> {
    let mut numbers = Vec::new();
    let mut first = 0_u32;
    for part in parts {
        let end = first.checked_add(part.cells as u32).ok_or("too many cells")?;
        numbers.push(Numbers { cells: (first..end).collect(), points: vec![], faces: vec![0; part.faces.len()] });
        first = end;
    }
    let mut next = 0_i64;
    let mut new = || {
        next += 1;
        next
    };
    for (part, n) in parts.iter().zip(&mut numbers) {
        n.faces[..part.neighbour.len()].iter_mut().for_each(|f| *f = new());
    }
    let mut merge = Merge::new(parts);
    for a in 0..parts.len() {
        for patch in parts[a].patches.iter().filter(|p| p.kind == "processor") {
            let (b, other) = opposite(parts, a, patch, None)?;
            if a < b {
                for (f, g) in patch.faces.clone().zip(other.faces.clone()) {
                    let number = new();
                    numbers[a].faces[f] = number;
                    numbers[b].faces[g] = -number;
                    merge.faces(parts, (a, f), (b, g))?;
                }
            }
        }
    }
    // the faces of a patch follow each other, those of both sides of a pair in the same order
    let names = patch_names(parts);
    for (at, name) in names.iter().enumerate() {
        let partner = parts[0].patches.iter().find(|p| p.name == *name).and_then(|p| p.partner.as_deref());
        let second = partner.is_some_and(|p| names[..at].contains(&p));
        for a in 0..parts.len() {
            for patch in &parts[a].patches {
                let through = patch.link.as_ref().and_then(|l| l.through.as_deref());
                let (part, faces) = match through {
                    None if patch.name == *name && patch.link.is_none() => (a, patch.faces.clone()),
                    Some(t) if !second && t == *name => (a, patch.faces.clone()),
                    Some(t) if second && Some(t) == partner => {
                        let (b, other) = opposite(parts, a, patch, Some(name))?;
                        (b, other.faces.clone())
                    }
                    _ => continue,
                };
                numbers[part].faces[faces].iter_mut().for_each(|f| *f = new());
            }
        }
    }
    if numbers.iter().any(|n| n.faces.contains(&0)) {
        return Err("some faces between processors belong to no patch".into());
    }
    merge.number(parts, &mut numbers);
    Ok(numbers)
}

/// The other side of a patch between processors, and whose it is.
fn opposite<'p>(parts: &'p [Part], a: usize, patch: &Raw, through: Option<&str>) -> Result<(usize, &'p Raw), String> {
    let lost = || match parts.len() {
        1 => format!("patch `{}` joins it to another processor's part: the case is the folder above", patch.name),
        _ => format!("processor {a}: patch `{}` has no other side of as many faces", patch.name),
    };
    let link = patch.link.as_ref().filter(|l| l.own == a).ok_or_else(lost)?;
    let fits = |p: &&Raw| {
        p.faces.len() == patch.faces.len()
            && p.link.as_ref().is_some_and(|l| l.own == link.other && l.other == a && l.through.as_deref() == through)
    };
    let part = parts.get(link.other).filter(|_| link.other != a).ok_or_else(lost)?;
    part.patches.iter().find(fits).map(|p| (link.other, p)).ok_or_else(lost)
}

/// Names of the patches that are not between processors, in order.
fn patch_names(parts: &[Part]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for patch in parts.iter().flat_map(|p| &p.patches).filter(|p| p.link.is_none()) {
        if !names.contains(&patch.name.as_str()) {
            names.push(&patch.name);
        }
    }
    names
}

/// Points of all parts in a row, and which are the same.
struct Merge {
    first: Vec<usize>,
    same: Vec<u32>,
}

impl Merge {
    fn new(parts: &[Part]) -> Self {
        let mut first = vec![0];
        parts.iter().for_each(|p| first.push(first[first.len() - 1] + p.points.len()));
        Self { same: (0..first[parts.len()] as u32).collect(), first }
    }

    fn root(&mut self, mut i: u32) -> u32 {
        while self.same[i as usize] != i {
            let up = self.same[self.same[i as usize] as usize];
            self.same[i as usize] = up;
            i = up;
        }
        i
    }

    /// Joins the corners of two faces, of which one is the other turned.
    fn faces(&mut self, parts: &[Part], (a, f): (usize, usize), (b, g): (usize, usize)) -> Result<(), String> {
        let (own, other) = (parts[a].faces.get(f), parts[b].faces.get(g));
        let n = own.len();
        let at = |part: usize, corner: u32| parts[part].points[corner as usize];
        let size = own.iter().map(|c| length(sub(at(a, *c), at(a, own[0])))).fold(0.0, f64::max);
        // they begin at the same corner, as OpenFOAM writes them, or else at another
        let off = |shift: usize| {
            let pairs = (0..n).map(|k| length(sub(at(a, own[k]), at(b, other[(shift + n - k) % n]))));
            pairs.fold(0.0, |m: f64, x| if x > m || x.is_nan() { x } else { m })
        };
        let tried = if n == other.len() { n.min(SHIFTS) } else { 0 };
        let shift = (0..tried).find(|s| off(*s) <= 1e-4 * size);
        let Some(shift) = shift else {
            return Err(format!("face {f} of processor {a} and face {g} of processor {b} do not lie on each other"));
        };
        for k in 0..n {
            let p = self.root((self.first[a] + own[k] as usize) as u32);
            let q = self.root((self.first[b] + other[(shift + n - k) % n] as usize) as u32);
            self.same[p.max(q) as usize] = p.min(q);
        }
        Ok(())
    }

    fn number(mut self, parts: &[Part], numbers: &mut [Numbers]) {
        let mut next = 0;
        let mut of = vec![u32::MAX; self.same.len()];
        for (i, part) in parts.iter().enumerate() {
            let range = self.first[i]..self.first[i] + part.points.len();
            for p in range {
                let root = self.root(p as u32) as usize;
                if of[root] == u32::MAX {
                    of[root] = next;
                    next += 1;
                }
                numbers[i].points.push(of[root]);
            }
        }
    }
}

/// The whole mesh, by the numbers.
fn assemble(parts: &[Part], numbers: &[Numbers]) -> Result<Part, String> {
    let most = |of: fn(&Numbers) -> u64| numbers.iter().map(of).max().unwrap_or(0) as usize;
    let points = most(|n| n.points.iter().map(|p| u64::from(*p) + 1).max().unwrap_or(0));
    let faces = most(|n| n.faces.iter().map(|f| f.unsigned_abs()).max().unwrap_or(0));
    let mut whole = Part { cells: parts.iter().map(|p| p.cells).sum(), ..Part::default() };
    whole.points = vec![[f64::NAN; 3]; points];
    let mut starts = vec![0_u32; faces + 1];
    for (part, n) in parts.iter().zip(numbers) {
        for (p, x) in n.points.iter().zip(&part.points) {
            whole.points[*p as usize] = *x;
        }
        for (f, number) in n.faces.iter().enumerate() {
            starts[number.unsigned_abs() as usize] = part.faces.get(f).len() as u32;
        }
    }
    for f in 0..faces {
        starts[f + 1] = starts[f].checked_add(starts[f + 1]).ok_or("too many corners of faces")?;
    }
    whole.faces = Polygons { corners: vec![u32::MAX; starts[faces] as usize], starts };
    whole.owner = vec![u32::MAX; faces];
    whole.neighbour = vec![u32::MAX; faces];
    for (part, n) in parts.iter().zip(numbers) {
        for (f, number) in n.faces.iter().enumerate() {
            let (g, turned) = (number.unsigned_abs() as usize - 1, *number < 0);
            let corners = part.faces.get(f);
            let room = whole.faces.starts[g] as usize..whole.faces.starts[g + 1] as usize;
            if room.len() != corners.len() {
                return Err(format!("face {g} has not the same corners in all parts"));
            }
            for (k, place) in room.enumerate() {
                let k = if turned { (corners.len() - k) % corners.len() } else { k };
                whole.faces.corners[place] = n.points[corners[k] as usize];
            }
            let own = n.cells[part.owner[f] as usize];
            let other = part.neighbour.get(f).map(|c| n.cells[*c as usize]);
            let (owner, neighbour) = if turned { (other, Some(own)) } else { (Some(own), other) };
            owner.into_iter().for_each(|c| whole.owner[g] = c);
            neighbour.into_iter().for_each(|c| whole.neighbour[g] = c);
        }
    }
    let inner = whole.neighbour.iter().position(|c| *c == u32::MAX).unwrap_or(faces);
    if whole.neighbour[inner..].iter().any(|c| *c != u32::MAX) || whole.owner.contains(&u32::MAX) {
        return Err("faces between cells and those of the boundary are mixed up by faceProcAddressing".into());
    }
    whole.neighbour.truncate(inner);
    whole.patches = patches(parts, numbers, inner, faces)?;
    Ok(whole)
}

fn patches(parts: &[Part], numbers: &[Numbers], inner: usize, faces: usize) -> Result<Vec<Raw>, String> {
    // how many faces each has, and between which numbers they lie
    let mut found: HashMap<&str, (usize, usize, usize)> = HashMap::new();
    for (part, n) in parts.iter().zip(numbers) {
        for patch in &part.patches {
            let name = match &patch.link {
                None => patch.name.as_str(),
                Some(link) => match &link.through {
                    Some(through) => through.as_str(),
                    None => continue,
                },
            };
            let entry = found.entry(name).or_insert((0, usize::MAX, 0));
            for f in &n.faces[patch.faces.clone()] {
                let g = f.unsigned_abs() as usize - 1;
                *entry = (entry.0 + 1, entry.1.min(g), entry.2.max(g + 1));
            }
        }
    }
    let mut next = inner;
    let mut whole = Vec::new();
    for name in patch_names(parts) {
        let raw = parts.iter().flat_map(|p| &p.patches).find(|p| p.name == name && p.link.is_none());
        let (count, from, to) = found.get(name).copied().unwrap_or((0, usize::MAX, 0));
        if count > 0 && (from != next || to != from + count) {
            return Err(format!("the faces of patch `{name}` do not follow each other"));
        }
        whole.extend(raw.map(|raw| Raw { faces: next..next + count, ..raw.clone() }));
        next += count;
    }
    if next != faces {
        return Err(format!("{} faces of the boundary are in no patch", faces - next));
    }
    Ok(whole)
}
