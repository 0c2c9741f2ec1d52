//! Reads a case, says what it holds and how long that took: `cargo run --release -p carom-cfd --example read_openfoam -- CASE [TIME]`.
//! With `--make N CASE [--binary]` before it, a case of N³ cells is written first.

use std::io::{BufWriter, Write};
use std::path::Path;
use std::time::Instant;

use carom_cfd::block::{Kind, block};
use carom_cfd::openfoam::{Options, read};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args: Vec<String> = std::env::args().skip(1).collect();
    let binary = args.iter().position(|a| a == "--binary").map(|i| args.remove(i)).is_some();
    if args.first().is_some_and(|a| a == "--make") {
        make(args[1].parse()?, Path::new(&args[2]), binary)?;
        args.drain(..2);
    }
    let start = Instant::now();
    let options = Options { time: args.get(1).cloned(), ..Options::default() };
    let result = read(Path::new(&args[0]), &options)?;
    let (mesh, seconds) = (&result.mesh, start.elapsed().as_secs_f64());
    println!("{} cells, {} faces, {} points: {seconds:.2} s", mesh.cells, mesh.faces.len(), mesh.points.len());
    for p in &mesh.patches {
        println!("  {} {:?} {:?} {:?}", p.name, p.kind, p.faces, p.groups);
    }
    println!("time {:?}, other fields {:?}", result.time, result.fields.others);
    result.notes.iter().for_each(|note| println!("  {note}"));
    Ok(())
}

struct Writer {
    out: BufWriter<std::fs::File>,
    binary: bool,
}

impl Writer {
    fn new(path: &Path, class: &str, binary: bool) -> std::io::Result<Self> {
        std::fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
        let mut out = BufWriter::new(std::fs::File::create(path)?);
        let format = if binary { "binary" } else { "ascii" };
        writeln!(out, "FoamFile {{ format {format}; class {class}; arch \"LSB;label=32;scalar=64\"; }}")?;
        Ok(Self { out, binary })
    }

    fn labels(&mut self, labels: &[u32]) -> std::io::Result<()> {
        write!(self.out, "{}\n(", labels.len())?;
        for l in labels {
            match self.binary {
                true => self.out.write_all(&l.to_le_bytes())?,
                false => write!(self.out, "\n{l}")?,
            }
        }
        writeln!(self.out, ")")
    }

    fn reals(&mut self, values: &[f64], components: usize) -> std::io::Result<()> {
        write!(self.out, "{}\n(", values.len() / components)?;
        for v in values.chunks(components) {
            match (self.binary, v) {
                (true, v) => v.iter().try_for_each(|x| self.out.write_all(&x.to_le_bytes()))?,
                (false, [x, y, z]) => write!(self.out, "\n({x:.9} {y:.9} {z:.9})")?,
                (false, v) => write!(self.out, "\n{:.9}", v[0])?,
            }
        }
        writeln!(self.out, ")")
    }
}

fn make(n: usize, case: &Path, binary: bool) -> std::io::Result<()> {
    let mesh = block(Kind::Hexahedra, [n; 3], |x| x);
    let folder = case.join("constant/polyMesh");
    let points: Vec<f64> = mesh.points.iter().flatten().copied().collect();
    Writer::new(&folder.join("points"), "vectorField", binary)?.reals(&points, 3)?;
    let mut faces = Writer::new(&folder.join("faces"), if binary { "faceCompactList" } else { "faceList" }, binary)?;
    if binary {
        faces.labels(&mesh.faces.starts)?;
        faces.labels(&mesh.faces.corners)?;
    } else {
        writeln!(faces.out, "{}\n(", mesh.faces.len())?;
        for f in 0..mesh.faces.len() {
            let c = mesh.faces.get(f);
            writeln!(faces.out, "4({} {} {} {})", c[0], c[1], c[2], c[3])?;
        }
        writeln!(faces.out, ")")?;
    }
    Writer::new(&folder.join("owner"), "labelList", binary)?.labels(&mesh.owner)?;
    Writer::new(&folder.join("neighbour"), "labelList", binary)?.labels(&mesh.neighbour)?;
    let mut boundary = Writer::new(&folder.join("boundary"), "polyBoundaryMesh", false)?.out;
    writeln!(boundary, "{}(", mesh.patches.len())?;
    for p in &mesh.patches {
        let (start, len) = (p.faces.start, p.faces.len());
        writeln!(boundary, "{} {{ type wall; startFace {start}; nFaces {len}; }}", p.name)?;
    }
    writeln!(boundary, ")")?;
    let value = |i: usize, c: usize| ((i * 7919 + c * 104_729) % 1_000_003) as f64 / 1_000_003.0;
    for (name, components) in [("U", 3), ("p", 1), ("k", 1), ("epsilon", 1)] {
        let class = if components == 3 { "volVectorField" } else { "volScalarField" };
        let mut field = Writer::new(&case.join("100").join(name), class, binary)?;
        let list = if components == 3 { "vector" } else { "scalar" };
        writeln!(field.out, "internalField nonuniform List<{list}>")?;
        let values: Vec<f64> = (0..mesh.cells * components).map(|i| value(i / components, i % components)).collect();
        field.reals(&values, components)?;
        let entry = if components == 3 { "type noSlip;" } else { "type zeroGradient;" };
        writeln!(field.out, ";\nboundaryField {{ \".*\" {{ {entry} }} }}")?;
    }
    Ok(())
}
