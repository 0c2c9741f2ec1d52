//! `carom info`: what a mesh or field file holds, and the tables of a case file that read it.

mod suggest;
mod table;

use crate::failure::{Failure, of_file};
use crate::output;
use crate::text::{Lines, number, quantity};
use carom_cfd::quality::{Named, Quality, Range, Worst, quality, ranges};
use carom_cfd::{Error, PatchKind, Snapshot, openfoam, vtk};
use carom_report::{Column, Table};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Read as _;
use std::path::{Path, PathBuf};

const EXAMPLE: &str = "\
Examples:
  carom info pitzDaily
  carom info duct --time 500 --json
  carom info duct.vtu
  carom info flow.vti

It ends with the tables of a case file that read this flow, to paste.";

/// Show what a mesh or a field file holds: cells, patches, fields, quality, and the tables that read it
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLE)]
pub struct Args {
    /// A folder with a case of OpenFOAM, a mesh of VTK (.vtu, .pvtu, .vtm, .vtpd, .vtpc, .vtk) or Fluent (.cas.h5), or a flow table (.csv, .vti, .vtr, .vtk)
    case: PathBuf,
    /// Time of a case of OpenFOAM; the latest without it
    #[arg(long, value_name = "NAME")]
    time: Option<String>,
    /// Axis that a result of VTK or Fluent goes round whose cells are polygons of a plane: x, y or z; plane without it
    #[arg(long, value_name = "AXIS", value_parser = axis)]
    axisymmetric: Option<vtk::Axis>,
    /// Print JSON, SI units
    #[arg(long, help_heading = "Output")]
    json: bool,
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<(), Failure> {
    let case = folder_of_marker(&args.case);
    std::fs::metadata(case).map_err(|e| of_file(&case.display().to_string(), &e))?;
    let mut info = if case.is_dir() {
        if args.axisymmetric.is_some() {
            let what = "--axisymmetric is of a mesh of VTK or Fluent: OpenFOAM's has patches of type wedge";
            return Err(Failure::input(what));
        }
        let options = openfoam::Options { time: args.time.clone(), ..openfoam::Options::default() };
        let times = openfoam::times(case).map_err(failure)?;
        let snapshot = openfoam::read(case, &options).map_err(failure)?;
        Info::new("OpenFOAM", case, times, &snapshot)
    } else if args.time.is_some() {
        return Err(Failure::input("--time is of a case of OpenFOAM, which is a folder"));
    } else if is_mesh_of_vtk(case) {
        let options = vtk::Options { axis: args.axisymmetric, ..vtk::Options::default() };
        let mut snapshot = vtk::read(case, &options).map_err(failure)?;
        let gaps = carom_track::flow::Cells::new(&snapshot).ok().and_then(|cells| cells.boundary_inside());
        snapshot.notes.extend(gaps);
        Info::new("VTK", case, Vec::new(), &snapshot)
    } else if case.to_string_lossy().to_ascii_lowercase().ends_with(".cas.h5") {
        Info::new("Fluent", case, Vec::new(), &fluent(case, args.axisymmetric)?)
    } else {
        return match args.axisymmetric {
            Some(_) => Err(Failure::input("--axisymmetric is of a mesh of VTK or Fluent")),
            None => table::run(case, args.json),
        };
    };
    if let Some(axis) = args.axisymmetric {
        let _ = writeln!(info.flow, "axisymmetric = \"{}\"", axis.name());
    }
    if args.json { output::print_json(&info) } else { output::print(&info.tell()?) }
}

fn axis(name: &str) -> Result<vtk::Axis, String> {
    vtk::Axis::named(name).ok_or_else(|| "x, y or z is wanted".to_owned())
}

/// A case may be named by the empty file in it by which ParaView opens it.
fn folder_of_marker(case: &Path) -> &Path {
    let marker = case.extension().is_some_and(|e| e == "foam" || e == "OpenFOAM") && case.is_file();
    let folder = case.parent().filter(|_| marker);
    folder.map_or(case, |f| if f.as_os_str().is_empty() { Path::new(".") } else { f })
}

#[cfg(feature = "fluent")]
fn fluent(case: &Path, axis: Option<vtk::Axis>) -> Result<Snapshot, Failure> {
    use carom_cfd::fluent;
    fluent::read(case, &fluent::Options { axis, ..fluent::Options::default() }).map_err(failure)
}

#[cfg(not(feature = "fluent"))]
fn fluent(case: &Path, _: Option<vtk::Axis>) -> Result<Snapshot, Failure> {
    Err(Failure::input(format!("{}: this carom was built without the feature `fluent`", case.display())))
}

/// What of VTK's is a mesh, or holds some. Grids along axes are flow tables.
const MESHES: [&str; 6] = [
    "unstructuredgrid",
    "punstructuredgrid",
    "vtkmultiblockdataset",
    "vtkpartitioneddataset",
    "vtkpartitioneddatasetcollection",
    // of times: refused by a reader that says why
    "collection",
];

/// Whether a file is a mesh of VTK, by its first bytes, as the reader goes by them.
fn is_mesh_of_vtk(file: &Path) -> bool {
    let mut start = Vec::new();
    let read = std::fs::File::open(file).and_then(|f| f.take(8192).read_to_end(&mut start));
    let start = String::from_utf8_lossy(&start).to_ascii_lowercase();
    if start.starts_with("# vtk datafile") {
        let words: Vec<&str> = start.lines().skip(2).flat_map(str::split_whitespace).collect();
        return words.windows(2).any(|w| w == ["dataset", "unstructured_grid"]);
    }
    let tag = start.split_once("<vtkfile").and_then(|(_, rest)| rest.split('>').next());
    let kind = tag.and_then(|tag| tag.split_once("type")).and_then(|(_, rest)| rest.split(['"', '\'']).nth(1));
    read.is_ok() && kind.is_some_and(|kind| MESHES.contains(&kind.trim()))
}

/// A result that cannot be read is the user's mistake, but for a disk that fails.
fn failure(error: Error) -> Failure {
    match error {
        Error::Io { path, source } => of_file(&path.display().to_string(), &source),
        other => Failure::input(other.to_string()),
    }
}

/// What there is to say of a mesh with fields.
#[derive(serde::Serialize)]
struct Info {
    kind: &'static str,
    path: String,
    time: Option<String>,
    times: Vec<String>,
    cells: Cells,
    faces: usize,
    inner_faces: usize,
    points: usize,
    low: [f64; 3],
    high: [f64; 3],
    volume: f64,
    quality: Measures,
    patches: Vec<Patch>,
    fields: Vec<FieldRange>,
    other_fields: Vec<String>,
    notes: Vec<String>,
    flow: String,
    walls: String,
}

#[derive(serde::Serialize)]
struct Cells {
    all: usize,
    kinds: BTreeMap<&'static str, usize>,
}

#[derive(serde::Serialize)]
struct Measures {
    smallest_cell: At,
    largest_cell: At,
    non_orthogonality_deg: At,
    mean_non_orthogonality_deg: f64,
    skewness: At,
    aspect_ratio: At,
    inverted: Cut,
    negative_volume: Cut,
}

#[derive(serde::Serialize)]
struct At {
    value: f64,
    cell: u32,
}

impl From<Worst> for At {
    fn from(w: Worst) -> Self {
        Self { value: w.value, cell: w.cell }
    }
}

/// A number of cells, and the first of them.
#[derive(serde::Serialize)]
struct Cut {
    count: usize,
    cells: Vec<u32>,
}

impl From<Named> for Cut {
    fn from(n: Named) -> Self {
        Self { count: n.count, cells: n.cells }
    }
}

impl Cut {
    fn tell(&self) -> String {
        if self.count == 0 {
            return "none".into();
        }
        let cells: Vec<_> = self.cells.iter().map(u32::to_string).collect();
        let more = if self.count > self.cells.len() { ", …" } else { "" };
        format!("{} cells: {}{more}", self.count, cells.join(", "))
    }
}

#[derive(serde::Serialize)]
struct Patch {
    name: String,
    #[serde(rename = "type")]
    kind: &'static str,
    groups: Vec<String>,
    faces: usize,
    area: f64,
    partner: Option<String>,
}

#[derive(serde::Serialize)]
struct FieldRange {
    name: &'static str,
    unit: &'static str,
    low: f64,
    high: f64,
}

impl From<Range> for FieldRange {
    fn from(r: Range) -> Self {
        let unit = match r.name {
            "velocity" => "m/s",
            "k" => "m2/s2",
            "epsilon" => "m2/s3",
            "omega" => "1/s",
            "density" => "kg/m3",
            "temperature" => "K",
            _ => "Pa",
        };
        Self { name: r.name, unit, low: r.low, high: r.high }
    }
}

impl Info {
    fn new(kind: &'static str, path: &Path, times: Vec<String>, s: &Snapshot) -> Self {
        let (mesh, q) = (&s.mesh, quality(&s.mesh));
        let path = path.display().to_string();
        let [low, high] = q.bounds;
        let mut fields: Vec<FieldRange> = ranges(&s.fields).into_iter().map(FieldRange::from).collect();
        let over_density = s.notes.iter().any(|n| n.starts_with("pressure") && n.contains("over the density"));
        fields.iter_mut().filter(|f| f.name == "pressure" && over_density).for_each(|f| f.unit = "m2/s2");
        Self {
            kind,
            time: s.time.clone(),
            times,
            cells: Cells { all: mesh.cells, kinds: q.kinds.named().into_iter().filter(|k| k.1 > 0).collect() },
            faces: mesh.faces.len(),
            inner_faces: mesh.inner_faces(),
            points: mesh.points.len(),
            low,
            high,
            volume: q.volume,
            patches: patches(s, &q),
            quality: Measures {
                smallest_cell: q.smallest.into(),
                largest_cell: q.largest.into(),
                non_orthogonality_deg: q.non_orthogonality.into(),
                mean_non_orthogonality_deg: q.mean_non_orthogonality,
                skewness: q.skewness.into(),
                aspect_ratio: q.aspect_ratio.into(),
                inverted: q.inverted.into(),
                negative_volume: q.negative.into(),
            },
            fields,
            other_fields: s.fields.others.clone(),
            notes: s.notes.clone(),
            flow: suggest::flow(kind, &path, s.time.as_deref()),
            walls: suggest::walls(&mesh.patches),
            path,
        }
    }

    fn tell(&self) -> Result<String, Failure> {
        let mut text = format!("{}: {}", self.path, self.kind);
        if let Some(time) = &self.time {
            let _ = write!(text, ", time {time}");
        }
        text += "\n\n";
        let mut lines = Lines::default();
        if self.times.len() > 1 {
            lines.add("times", shortened(&self.times));
        }
        let kinds: Vec<_> = self.cells.kinds.iter().map(|(kind, n)| format!("{n} {kind}")).collect();
        lines.add("cells", format!("{} ({})", self.cells.all, kinds.join(", ")));
        lines.add("faces", format!("{}, of which {} between cells", self.faces, self.inner_faces));
        lines.add("points", self.points.to_string());
        lines.add("box", format!("{} to {} m", triple(self.low), triple(self.high)));
        let q = &self.quality;
        let (least, most) = (number(q.smallest_cell.value), number(q.largest_cell.value));
        lines.add("volume", format!("{}; cells {least} to {most} m3", quantity(self.volume, "m3")));
        let at = |name: &str, m: &At| format!("{name} {} (cell {})", number(tidy(m.value)), m.cell);
        let angle = tidy(q.non_orthogonality_deg.value);
        let mean = number(tidy(q.mean_non_orthogonality_deg));
        let lean =
            format!("non-orthogonality {} deg (cell {}), mean {mean}", number(angle), q.non_orthogonality_deg.cell);
        lines.add("quality", [lean, at("skewness", &q.skewness), at("aspect ratio", &q.aspect_ratio)].join("; "));
        lines.add("inverted tetrahedra", q.inverted.tell());
        if q.negative_volume.count > 0 {
            lines.add("negative volume", q.negative_volume.tell());
        }
        if !self.other_fields.is_empty() {
            lines.add("other fields", self.other_fields.join(", "));
        }
        let _ = write!(text, "{lines}\n{}", self.patch_table()?);
        if !self.fields.is_empty() {
            let _ = write!(text, "\n{}", self.field_table()?);
        }
        for note in &self.notes {
            let _ = write!(text, "\nnote: {note}");
        }
        let _ = write!(text, "\n\nFor a case file:\n\n{}\n{}", self.flow, self.walls);
        Ok(text)
    }

    fn patch_table(&self) -> Result<String, Failure> {
        let kind = |p: &Patch| p.partner.as_ref().map_or(p.kind.to_owned(), |other| format!("{} to {other}", p.kind));
        let table = Table::new([
            Column::text("patch", self.patches.iter().map(|p| p.name.as_str())),
            Column::text("type", self.patches.iter().map(kind)),
            Column::count("faces", self.patches.iter().map(|p| p.faces as u64)),
            Column::float("area", "m2", self.patches.iter().map(|p| Some(p.area)).collect::<Vec<_>>()),
            Column::text("groups", self.patches.iter().map(|p| p.groups.join(" "))),
        ])?;
        Ok(table.to_text())
    }

    fn field_table(&self) -> Result<String, Failure> {
        let column = |name: &str, get: fn(&FieldRange) -> f64| {
            Column::float(name, "", self.fields.iter().map(|f| Some(get(f))).collect::<Vec<_>>())
        };
        let table = Table::new([
            Column::text("field", self.fields.iter().map(|f| f.name)),
            column("least", |f| f.low),
            column("largest", |f| f.high),
            Column::text("unit", self.fields.iter().map(|f| f.unit)),
        ])?;
        Ok(table.to_text())
    }
}

fn patches(s: &Snapshot, q: &Quality) -> Vec<Patch> {
    let all = &s.mesh.patches;
    let one = |(p, area): (&carom_cfd::Patch, &f64)| {
        let partner = match p.kind {
            PatchKind::Cyclic { partner, .. } | PatchKind::CyclicAmi { partner, .. } => Some(partner),
            _ => None,
        };
        let partner = partner.map(|i| all[i].name.clone());
        Patch {
            name: p.name.clone(),
            kind: p.kind.name(),
            groups: p.groups.clone(),
            faces: p.faces.len(),
            area: *area,
            partner,
        }
    };
    all.iter().zip(&q.areas).map(one).collect()
}

/// What rounding leaves of nothing is nothing.
fn tidy(value: f64) -> f64 {
    if value.abs() < 1e-5 { 0.0 } else { value }
}

fn triple(x: [f64; 3]) -> String {
    format!("({})", x.map(number).join(" "))
}

/// Names one after the other, of many the first and the last.
fn shortened(names: &[String]) -> String {
    match names {
        [first, .., last] if names.len() > 12 => format!("{} from {first} to {last}", names.len()),
        _ => names.join(", "),
    }
}
