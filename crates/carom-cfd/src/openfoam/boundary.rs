//! The file `boundary`: patches and what they are.

use std::ops::Range;

use super::cyclic::{self, Told};
use super::dictionary::{Dict, Value, expand, plain};
use super::error::{Fault, fault};
use super::files::Contents;
use super::list::Item;
use super::scan::Scan;
use crate::{Error, Mesh, Patch, PatchKind};

/// A patch as the file has it.
#[derive(Clone, Debug)]
pub(super) struct Raw {
    pub(super) name: String,
    /// The word for what it is.
    pub(super) kind: String,
    pub(super) groups: Vec<String>,
    pub(super) faces: Range<usize>,
    /// Name of the other side of a periodic one.
    pub(super) partner: Option<String>,
    pub(super) told: Told,
    pub(super) link: Option<Link>,
}

/// A patch that joins the parts of two processors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Link {
    pub(super) own: usize,
    pub(super) other: usize,
    /// The periodic patch through which it joins them.
    pub(super) through: Option<String>,
}

impl Raw {
    /// Whether the fluid goes on at another patch.
    pub(super) fn is_periodic(&self) -> bool {
        matches!(self.kind.as_str(), "cyclic" | "cyclicSlip" | "cyclicAMI" | "processorCyclic")
    }

    pub(super) fn is_symmetry(&self) -> bool {
        matches!(self.kind.as_str(), "symmetry" | "symmetryPlane")
    }

    /// Whether fields need no entry for it.
    pub(super) fn is_constraint(&self) -> bool {
        self.is_periodic() || self.is_symmetry() || matches!(self.kind.as_str(), "empty" | "wedge")
    }

    fn is_wall(&self) -> bool {
        self.kind == "wall" || self.kind.ends_with("Wall")
    }
}

pub(super) fn read(contents: &Contents<'_>) -> Result<Vec<Raw>, Error> {
    contents.read(|scan| {
        if scan.peek() != Some(b'(') {
            scan.count()?;
        }
        scan.expect(b'(')?;
        let mut patches: Vec<Raw> = Vec::new();
        while !scan.take(b')') {
            let at = scan.at;
            let name = if scan.peek() == Some(b'"') { scan.quoted()? } else { scan.name() };
            let name = String::from_utf8_lossy(name).into_owned();
            scan.expect(b'{')?;
            // an entry of a dictionary of its own, since its end closes it
            let dict = Dict::within(scan, contents.format)?;
            let patch = one(name, &dict).map_err(|f| fault(if f.at == 0 { at } else { f.at }, f.what))?;
            if patches.iter().any(|p| p.name == patch.name) {
                return Err(fault(at, format!("there are two patches `{}`", patch.name)));
            }
            patches.push(patch);
        }
        Ok(patches)
    })
}

fn one(name: String, dict: &Dict<'_>) -> Result<Raw, Fault> {
    let text = |key: &str| match dict.find(key.as_bytes(), &[dict]) {
        Some(Value::Text(text)) => expand(*text, &[dict]).map(|t| Some((t.into_owned(), text.at))),
        _ => Ok(None),
    };
    let word = |key: &str| text(key).map(|t| t.map(|(t, _)| plain(&t).into_owned()));
    let count = |key: &str| match text(key)? {
        Some((t, at)) => Scan::new(&t).count().map_err(|f| fault(at, f.what)),
        None => Err(fault(0, format!("patch `{name}` has no {key}"))),
    };
    let vector = |keys: &[&str]| {
        for key in keys {
            if let Some((t, at)) = text(key)? {
                return <[f64; 3]>::read(&mut Scan::new(&t)).map(Some).map_err(|f| fault(at, f.what));
            }
        }
        Ok(None)
    };
    let Some(kind) = word("type")? else {
        return Err(fault(0, format!("patch `{name}` has no type")));
    };
    let (start, len) = (count("startFace")?, count("nFaces")?);
    let Some(end) = start.checked_add(len) else {
        return Err(fault(0, format!("patch `{name}` has no end")));
    };
    let groups = text("inGroups")?.map_or(Vec::new(), |(t, _)| words(&t));
    let told = Told {
        axis: vector(&["rotationAxis"])?,
        centre: vector(&["rotationCentre", "rotationCenter"])?,
        separation: vector(&["separationVector", "separation"])?,
        tolerance: word("matchTolerance")?.and_then(|t| t.parse().ok()),
    };
    let link = match kind.as_str() {
        "processor" | "processorCyclic" => {
            let through = if kind == "processorCyclic" { word("referPatch")? } else { None };
            Some(Link { own: count("myProcNo")?, other: count("neighbProcNo")?, through })
        }
        _ => None,
    };
    let partner = word("neighbourPatch")?.or(word("nbrPatch")?);
    let mut raw = Raw { name, kind, groups, faces: start..end, partner, told, link };
    // patches of these kinds are in a group of that name, said or not
    let own = if raw.is_wall() { Some("wall") } else { raw.is_constraint().then_some(raw.kind.as_str()) };
    if let Some(own) = own.map(str::to_owned)
        && !raw.groups.contains(&own)
    {
        raw.groups.push(own);
    }
    Ok(raw)
}

/// Words of a list, with or without their number before it.
fn words(list: &[u8]) -> Vec<String> {
    let inside = list.iter().position(|b| *b == b'(').map_or(list, |i| &list[i + 1..]);
    let mut scan = Scan::new(inside);
    let mut found = Vec::new();
    while !matches!(scan.peek(), None | Some(b')')) {
        let word = if scan.peek() == Some(b'"') { scan.quoted().unwrap_or_default() } else { scan.name() };
        if word.is_empty() {
            break;
        }
        found.push(String::from_utf8_lossy(word).into_owned());
    }
    found
}

/// What the patches of a whole mesh are. The mesh has everything else.
pub(super) fn patches(raw: &[Raw], mesh: &Mesh, case: &std::path::Path) -> Result<Vec<Patch>, Error> {
    raw.iter()
        .map(|p| {
            let bad = |what: String| Error::file(case, format!("patch `{}`: {what}", p.name));
            let periodic = || {
                let name = p.partner.as_deref().ok_or_else(|| bad("has no neighbourPatch".into()))?;
                let partner = raw.iter().position(|q| q.name == name);
                let partner = partner.ok_or_else(|| bad(format!("its neighbourPatch `{name}` is not there")))?;
                let (own, other) = (p.faces.clone(), raw[partner].faces.clone());
                if [&own, &other].iter().any(|r| r.end > mesh.faces.len() || r.start > r.end) {
                    return Err(bad("has faces that are not there".into()));
                }
                let carry = match p.kind.as_str() {
                    "cyclicAMI" => cyclic::between_areas(mesh, own, other, &p.told),
                    _ => cyclic::face_by_face(mesh, own, other, &p.told),
                };
                carry.map(|carry| (partner, carry)).map_err(bad)
            };
            let kind = match p.kind.as_str() {
                "empty" => PatchKind::Empty,
                "wedge" => PatchKind::Wedge,
                "symmetry" | "symmetryPlane" => PatchKind::Symmetry,
                "cyclic" | "cyclicSlip" => {
                    let (partner, carry) = periodic()?;
                    PatchKind::Cyclic { partner, carry }
                }
                "cyclicAMI" => {
                    let (partner, carry) = periodic()?;
                    PatchKind::CyclicAmi { partner, carry }
                }
                // it has no faces of its own, and joins what other patches have
                "nonConformalCyclic" => return Err(bad("patches of type nonConformalCyclic are not read".into())),
                "cyclicACMI" | "cyclicPeriodicAMI" | "overset" if !p.faces.is_empty() => {
                    return Err(bad(format!("patches of type {} are not read", p.kind)));
                }
                "processor" | "processorCyclic" => return Err(bad("joins processors in a mesh of one piece".into())),
                _ if p.is_wall() => PatchKind::Wall,
                _ => PatchKind::Plain,
            };
            Ok(Patch { name: p.name.clone(), groups: p.groups.clone(), kind, faces: p.faces.clone() })
        })
        .collect()
}
