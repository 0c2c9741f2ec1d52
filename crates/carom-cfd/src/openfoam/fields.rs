//! Fields: values of the cells, and what the entries of the patches give on the boundary.

use std::borrow::Cow;
use std::path::Path;

use super::boundary::Raw;
use super::dictionary::{Dict, Scopes, Text, Value, expand, plain};
use super::error::{Fault, fault};
use super::files::Contents;
use super::header::Format;
use super::layout::Layout;
use super::list::{self, Item};
use super::scan::Scan;
use super::stitch::Joint;
use crate::geometry::face_centre_and_area;
use crate::geometry::vector::{dot, scaled, sub, unit};
use crate::{Error, Field, Mesh};

/// What a field may be made of.
pub(super) trait Quantity: Item + PartialEq + Copy {
    const NAN: Self;
    const ZERO: Self;
    /// The class of its fields.
    const CLASS: &'static str;
    /// The part along a plane of this normal.
    fn along(self, normal: [f64; 3]) -> Self;
}

impl Quantity for [f64; 1] {
    const NAN: Self = [f64::NAN];
    const ZERO: Self = [0.0];
    const CLASS: &'static str = "volScalarField";

    fn along(self, _: [f64; 3]) -> Self {
        self
    }
}

impl Quantity for [f64; 3] {
    const NAN: Self = [f64::NAN; 3];
    const ZERO: Self = [0.0; 3];
    const CLASS: &'static str = "volVectorField";

    fn along(self, normal: [f64; 3]) -> Self {
        sub(self, scaled(dot(self, normal), normal))
    }
}

/// A field as it is asked for.
pub(super) struct Asked<'a> {
    pub(super) file: &'a str,
    /// What it is called in messages.
    pub(super) name: &'a str,
    /// Exponents of kg, m, s, K that it may have.
    pub(super) dimensions: &'a [[i8; 4]],
    /// Whether one of other dimensions is another quantity, which is told and left alone.
    pub(super) may_differ: bool,
}

/// A field, and which of the dimensions it has.
pub(super) struct Found<T> {
    pub(super) cells: Vec<T>,
    pub(super) boundary: Vec<T>,
    pub(super) dimensions: Option<usize>,
}

impl<const N: usize> From<Found<[f64; N]>> for Field<N> {
    fn from(found: Found<[f64; N]>) -> Self {
        Self::Cells { cells: found.cells, boundary: found.boundary }
    }
}

enum Values<T> {
    One(T),
    Many(Vec<T>),
}

/// Reads a field of all parts; nothing where there is no such file.
pub(super) fn read<T: Quantity>(
    layout: &Layout,
    asked: &Asked<'_>,
    mesh: &Mesh,
    joints: &[Joint],
    notes: &mut Vec<String>,
) -> Result<Option<Found<T>>, Error> {
    let mut field =
        Found { cells: Vec::new(), boundary: vec![T::NAN; mesh.faces.len() - mesh.inner_faces()], dimensions: None };
    let (mut parts, mut differs) = (0, None);
    let there = layout.each(asked.file, |i, contents| {
        parts = i + 1;
        let Some(joint) = joints.get(i) else {
            return Err(Error::file(contents.path, "is of more processors than the mesh"));
        };
        differs = differs.take().or(one_part(contents, asked, mesh, joint, &mut field, notes)?);
        Ok(())
    })?;
    if !there {
        return Ok(None);
    }
    if parts != joints.len() {
        let what = format!("is of {parts} processors, and the mesh of {}", joints.len());
        return Err(Error::file(Path::new(asked.file), what));
    }
    if let Some(what) = differs {
        notes.push(format!("{what}: it is another quantity, and left out"));
        return Ok(None);
    }
    Ok(Some(field))
}

/// Reads a part; or says how its dimensions differ, where they may.
fn one_part<T: Quantity>(
    contents: &Contents<'_>,
    asked: &Asked<'_>,
    mesh: &Mesh,
    joint: &Joint,
    field: &mut Found<T>,
    notes: &mut Vec<String>,
) -> Result<Option<String>, Error> {
    if contents.class != T::CLASS {
        let what = format!("is a {} where a {} was expected", contents.class, T::CLASS);
        return Err(Error::file(contents.path, what));
    }
    let dict = contents.read(|scan| Dict::read(scan, contents.format))?;
    let fail = |fault| contents.error(fault);
    field.dimensions = match dimensions(&dict, asked) {
        Err(differs) if asked.may_differ => return Ok(Some(differs.what)),
        known => known.map_err(fail)?,
    };
    let internal = match dict.find(b"internalField", &[&dict]) {
        Some(Value::Text(text)) => *text,
        _ => return Err(fail(fault(contents.start, "no internalField"))),
    };
    let Some(values) = values::<T>(internal, &[&dict], contents.format, joint.count).map_err(fail)? else {
        return Err(fail(fault(internal.at, "internalField is neither uniform nor nonuniform")));
    };
    if let Values::Many(list) = &values
        && list.len() != joint.count
    {
        let what =
            format!("{} has {} values for {} cells: it belongs to another mesh", asked.name, list.len(), joint.count);
        return Err(fail(fault(internal.at, what)));
    }
    match (values, &joint.cells) {
        (Values::Many(list), None) => field.cells = list,
        (Values::One(value), None) => field.cells = vec![value; joint.count],
        (values, Some(numbers)) => {
            field.cells.resize(mesh.cells, T::NAN);
            for (i, c) in numbers.iter().enumerate() {
                field.cells[*c as usize] = match &values {
                    Values::One(value) => *value,
                    Values::Many(list) => list[i],
                };
            }
        }
    }
    let none = Dict::default();
    let (boundary, at) = match dict.find(b"boundaryField", &[&dict]) {
        Some(Value::Dict(boundary)) => (boundary, boundary.start()),
        _ => (&none, contents.start),
    };
    for patch in joint.patches.iter().filter(|p| !p.faces.is_empty() && p.kind != "processor") {
        let given = given::<T>(patch, boundary, &dict, contents.format)
            .map_err(|f| fail(if f.at == 0 { fault(at, f.what) } else { f }))?;
        if let Some(why) = given.note {
            let note = format!("{}: {why}", asked.name);
            if !notes.contains(&note) {
                notes.push(note);
            }
        }
        set(patch, &given.what, mesh, joint, field);
    }
    Ok(None)
}

/// What an entry gives.
enum What<T> {
    Values(Values<T>),
    /// The cell's value.
    Cell,
    /// The cell's, less what goes through the face.
    Along,
}

struct Given<T> {
    what: What<T>,
    note: Option<String>,
}

fn given<T: Quantity>(patch: &Raw, boundary: &Dict<'_>, root: &Dict<'_>, format: Format) -> Result<Given<T>, Fault> {
    let plainly = |what| Ok(Given { what, note: None });
    if patch.is_symmetry() {
        return plainly(What::Along);
    }
    if patch.is_constraint() {
        return plainly(What::Cell);
    }
    let scopes = [root, boundary];
    let Some(entry) = entry(patch, boundary, &scopes) else {
        return Err(fault(0, format!("no entry in boundaryField for patch `{}`", patch.name)));
    };
    let Value::Dict(entry) = entry else {
        return Err(fault(0, format!("the entry of patch `{}` is no dictionary", patch.name)));
    };
    let scopes = [root, boundary, entry];
    let name = &patch.name;
    let kind = match entry.find(b"type", &scopes) {
        Some(Value::Text(text)) => plain(&expand(*text, &scopes)?).into_owned(),
        _ => return Err(fault(entry.start(), format!("the entry of patch `{name}` has no type"))),
    };
    if let Some(Value::Text(text)) = entry.find(b"value", &scopes) {
        let Some(values) = values::<T>(*text, &scopes, format, patch.faces.len())? else {
            return Err(fault(text.at, format!("the value of patch `{name}` is neither uniform nor nonuniform")));
        };
        if let Values::Many(list) = &values
            && list.len() != patch.faces.len()
        {
            let (found, due) = (list.len(), patch.faces.len());
            let what = format!("patch `{name}` has {found} values for {due} faces: the field belongs to another mesh");
            return Err(fault(text.at, what));
        }
        return plainly(What::Values(values));
    }
    match kind.as_str() {
        "noSlip" => plainly(What::Values(Values::One(T::ZERO))),
        "slip" | "symmetry" | "symmetryPlane" | "basicSymmetry" => plainly(What::Along),
        "zeroGradient" | "inletOutlet" | "outletInlet" | "calculated" | "empty" | "wedge" => plainly(What::Cell),
        "fixedValue" => Err(fault(entry.start(), format!("the entry of patch `{name}` has no value"))),
        kind => {
            let note = format!("patch `{name}` is a {kind} without values; there it is as in the cells beside it");
            Ok(Given { what: What::Cell, note: Some(note) })
        }
    }
}

/// The entry of a patch: by its name, else by a group's, else by a pattern that fits its name; the last of each.
fn entry<'d, 'a>(patch: &Raw, boundary: &'d Dict<'a>, scopes: &Scopes<'d, 'a>) -> Option<&'d Value<'a>> {
    let name = patch.name.as_bytes();
    let by_group = || {
        let key = boundary.names().rev().find(|k| patch.groups.iter().any(|g| g.as_bytes() == *k))?;
        boundary.exact(key, scopes)
    };
    boundary.exact(name, scopes).or_else(by_group).or_else(|| boundary.fitting(name))
}

fn set<T: Quantity>(patch: &Raw, what: &What<T>, mesh: &Mesh, joint: &Joint, field: &mut Found<T>) {
    let inner = mesh.inner_faces();
    for (i, f) in patch.faces.clone().enumerate() {
        let f = joint.boundary.as_ref().map_or(f, |numbers| numbers[f - joint.inner] as usize);
        let cell = || field.cells[mesh.owner[f] as usize];
        field.boundary[f - inner] = match what {
            What::Values(Values::One(value)) => *value,
            What::Values(Values::Many(list)) => list[i],
            What::Cell => cell(),
            What::Along => {
                let normal = unit(face_centre_and_area(&mesh.points, mesh.faces.get(f)).1);
                normal.map_or(cell(), |n| cell().along(n))
            }
        };
    }
}

/// Values, `uniform` or `nonuniform`; none where they are something else.
fn values<'a, T: Quantity>(
    text: Text<'a>,
    scopes: &Scopes<'_, 'a>,
    format: Format,
    most: usize,
) -> Result<Option<Values<T>>, Fault> {
    let expanded = expand(text, scopes)?;
    // a place in what a macro stands for is that of the macro
    let borrowed = matches!(&expanded, Cow::Borrowed(b) if b.as_ptr() == text.bytes.as_ptr());
    let place = |f: Fault| fault(text.at + if borrowed { f.at } else { 0 }, f.what);
    let mut scan = Scan::new(&expanded);
    match scan.word() {
        b"uniform" | b"constant" => T::read(&mut scan).map(|v| Some(Values::One(v))).map_err(place),
        b"nonuniform" => {
            if scan.peek() == Some(b'L') {
                let class = scan.word();
                let due = if T::CLASS == "volVectorField" { b"List<vector>" } else { b"List<scalar>" };
                if class != due {
                    return Err(place(scan.fault(format!(
                        "a {} where a {} was expected",
                        String::from_utf8_lossy(class),
                        String::from_utf8_lossy(due)
                    ))));
                }
            }
            list::list(&mut scan, format, most).map(|l| Some(Values::Many(l))).map_err(place)
        }
        [b'#', ..] => Err(place(fault(0, "values that OpenFOAM works out are not read"))),
        _ => Ok(None),
    }
}

/// Which of the dimensions asked for a field has; none where it does not say so in numbers.
fn dimensions(dict: &Dict<'_>, asked: &Asked<'_>) -> Result<Option<usize>, Fault> {
    let Some(Value::Text(Text { bytes, at })) = dict.find(b"dimensions", &[dict]) else { return Ok(None) };
    let text = plain(bytes);
    let mut scan = Scan::new(text.as_bytes());
    let mut found = Vec::new();
    if scan.take(b'[') {
        while let Ok(number) = scan.number() {
            found.push(number);
        }
    }
    if found.len() < 5 || scan.peek() != Some(b']') {
        return Ok(None);
    }
    let fits = |due: &[i8; 4]| found.iter().enumerate().all(|(i, x)| *x == f64::from(due.get(i).copied().unwrap_or(0)));
    match asked.dimensions.iter().position(fits) {
        Some(place) => Ok(Some(place)),
        None => {
            let due = asked.dimensions.iter().map(|d| format!("[{} {} {} {} 0 0 0]", d[0], d[1], d[2], d[3]));
            let due = due.collect::<Vec<_>>().join(" or ");
            Err(fault(*at, format!("{} has the dimensions {text}, and not {due}", asked.name)))
        }
    }
}

/// Names of the files of a time that hold fields of cells.
pub(super) fn names(layout: &Layout, time: &str) -> Result<Vec<String>, Error> {
    let folder = layout.store.first().join(time);
    let is_field = |name: &String| {
        let bytes = super::files::beginning(&folder.join(name))?;
        super::files::class(&bytes).filter(|class| class.starts_with("vol"))
    };
    let mut found: Vec<_> = super::layout::names(&folder)?
        .into_iter()
        .filter(|name| is_field(name).is_some())
        .map(|name| name.strip_suffix(".gz").map_or(name.clone(), str::to_owned))
        .collect();
    found.dedup();
    Ok(found)
}
