//! The faces of `deposit.vtp`, read again for a picture.

use super::{CELL, DEPOSIT};
use crate::run::RunError;
use crate::vector::Vec3;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom};
use std::path::Path;

/// A face of a wall made of triangles, and what happened on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepositFace {
    /// Index of the wall.
    pub wall: usize,
    /// Corners, m.
    pub corners: [Vec3; 3],
    /// Mass that it kept, kg.
    pub mass: f64,
    /// Impacts on it.
    pub impacts: u64,
    /// Mass of the wall that impacts took away, kg; not a number where the wall has no law of erosion.
    pub eroded: f64,
}

/// Header lines of our own files are short, and there are few.
const LONGEST: u64 = 1 << 16;

/// The faces of a finished run's `deposit.vtp`; none where there is no such file, or no wall of triangles.
///
/// # Errors
/// What the file system says, and a file that is not one of this program.
pub fn deposit_faces(folder: &Path) -> Result<Vec<DepositFace>, RunError> {
    let path = folder.join(DEPOSIT);
    let file = match File::open(&path) {
        Ok(file) => file,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(e) => return Err(RunError::io(&path)(e)),
    };
    let mut shown = Shown::new(file).map_err(RunError::io(&path))?;
    shown.faces().map_err(RunError::io(&path))
}

struct Shown {
    file: BufReader<File>,
    /// Where each array begins.
    arrays: BTreeMap<String, u64>,
    verts: u64,
    polys: u64,
}

fn foreign() -> std::io::Error {
    std::io::Error::new(ErrorKind::InvalidData, "not as a run writes it")
}

fn attribute<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    line.split_once(&format!(" {key}=\""))?.1.split('"').next()
}

impl Shown {
    fn new(file: File) -> std::io::Result<Self> {
        let mut file = BufReader::new(file);
        let (mut arrays, mut counts) = (BTreeMap::new(), None);
        loop {
            let mut line = String::new();
            if file.by_ref().take(LONGEST).read_line(&mut line)? == 0 {
                return Err(foreign());
            }
            if line.starts_with("<Piece") {
                let count = |key| attribute(&line, key).and_then(|n| n.parse::<u64>().ok());
                counts = count("NumberOfVerts").zip(count("NumberOfPolys"));
            } else if line.starts_with("<DataArray") {
                let offset = attribute(&line, "offset").and_then(|n| n.parse().ok()).ok_or_else(foreign)?;
                // points and cells have arrays of one name: the later ones belong to the shapes
                arrays.entry(attribute(&line, "Name").ok_or_else(foreign)?.to_owned()).or_insert(offset);
            } else if line.starts_with("<AppendedData") {
                break;
            }
        }
        let mut mark = [0];
        file.read_exact(&mut mark)?;
        let start = file.stream_position()?;
        arrays.values_mut().for_each(|at: &mut u64| *at += start + CELL as u64);
        let (verts, polys) = counts.ok_or_else(foreign)?;
        Ok(Self { file, arrays, verts, polys })
    }

    /// Values of an array from a place on.
    fn values(&mut self, name: &str, from: u64, count: u64) -> std::io::Result<Vec<[u8; CELL]>> {
        let at = *self.arrays.get(name).ok_or_else(foreign)?;
        self.file.seek(SeekFrom::Start(at + from * CELL as u64))?;
        let mut bytes = Vec::new();
        let wanted = count * CELL as u64;
        self.file.by_ref().take(wanted).read_to_end(&mut bytes)?;
        if bytes.len() as u64 == wanted { Ok(bytes.as_chunks().0.to_vec()) } else { Err(foreign()) }
    }

    fn faces(&mut self) -> std::io::Result<Vec<DepositFace>> {
        let (verts, polys) = (self.verts, self.polys);
        if polys == 0 {
            return Ok(Vec::new());
        }
        let points = self.values("points", 3 * verts, 9 * polys)?;
        let [walls, impacts, masses] = ["wall", "impacts", "mass"].map(|name| self.values(name, verts, polys));
        let (walls, impacts, masses) = (walls?, impacts?, masses?);
        let eroded = if self.arrays.contains_key("eroded_mass") {
            self.values("eroded_mass", verts, polys)?
        } else {
            vec![f64::NAN.to_le_bytes(); polys as usize]
        };
        let faces = walls.into_iter().zip(impacts).zip(masses.into_iter().zip(eroded)).enumerate();
        let corner = |n: usize| [0, 1, 2].map(|c| f64::from_le_bytes(points[3 * n + c]));
        let face = |(n, ((wall, impacts), (mass, eroded)))| DepositFace {
            wall: u64::from_le_bytes(wall) as usize,
            corners: [0, 1, 2].map(|i| corner(3 * n + i)),
            mass: f64::from_le_bytes(mass),
            impacts: u64::from_le_bytes(impacts),
            eroded: f64::from_le_bytes(eroded),
        };
        Ok(faces.map(face).collect())
    }
}
