//! The section of the duct: an endless channel, or the square with its side walls and secondary currents, as a mesh that carom reads.
//!
//! Mean velocity, k and ε at a point of the square are those of the channel at the distance d of its nearest wall: "four independent flat walls,
//! each controlling a quarter of the flow" describe the mean velocity of square ducts with good accuracy, and the secondary currents are of 1 to
//! 2 % of the mean speed at any Reynolds number, in the core near eigenfunctions of Laplace's operator (Pirozzoli, Modesti, Orlandi & Grasso 2018,
//! J. Fluid Mech. 840, 631–655, doi:10.1017/jfm.2018.66). The lowest with eight vortices is
//!
//! ψ = sin 2πy sin πz − sin πy sin 2πz, v = ∂ψ/∂z, w = −∂ψ/∂y,
//!
//! y and z from the middle in half heights; along the diagonals it flows into the corners. It slips along walls, so here it is taken times
//! f(y) f(z), f the mean velocity of the channel over that in its middle, and scaled so that its greatest speed is the given share of the mean.

use crate::study::{CaseFile, Result, linspace};
use crate::{HEIGHT, air};
use carom_track::flow::{Channel, Profile};
use std::f64::consts::PI;
use std::fmt::Write;
use std::path::Path;

/// What spheres fly through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Section {
    /// Two plates.
    Channel,
    /// Two plates as a mesh, as wide as high, between mirrors: what the mesh itself changes.
    Meshed,
    /// Four walls, and the greatest speed of the secondary currents over the mean speed.
    Square(f64),
}

/// Width of the plates in the middle of each side, m.
const PLATE: f64 = 0.10;
/// Layers of cells from a wall to the middle, and the first one's thickness in wall units.
const LAYERS: usize = 24;
const FIRST: f64 = 2.0;
/// Length of a cell along the duct, m.
const CELL: f64 = 1.0;

/// The square as a mesh of a channel of the same walls.
struct Square {
    channel: Channel,
    section: Section,
    /// Of ψ, m²/s.
    strength: f64,
}

impl Section {
    /// Speed that the spheres' passing is counted with, m/s, and area of the section over the width of the plates, m.
    pub fn mean_and_width(self, channel_speed: f64) -> Result<(f64, f64)> {
        Ok(match self {
            Self::Channel | Self::Meshed => (channel_speed, HEIGHT),
            Self::Square(_) => (square_mean(&channel(channel_speed)?), HEIGHT * HEIGHT / PLATE),
        })
    }

    /// Which side of the duct a place is at, if its plates reach there: ceiling, walls, floor.
    pub fn side(self, [_, y, z]: [f64; 3]) -> Option<usize> {
        let beside = |across: f64| (across - 0.5 * HEIGHT).abs() < 0.5 * PLATE;
        let up_or_down = if y > 0.5 * HEIGHT { 0 } else { 2 };
        match self {
            Self::Channel | Self::Meshed => Some(up_or_down),
            Self::Square(_) if y.min(HEIGHT - y) < z.min(HEIGHT - z) => beside(z).then_some(up_or_down),
            Self::Square(_) => beside(y).then_some(1),
        }
    }

    /// Puts a mesh of the section, `length` m long, in place of the channel of a case.
    pub fn put(self, case: CaseFile, channel_speed: f64, length: f64, file: &Path) -> Result<CaseFile> {
        if self == Self::Channel {
            return Ok(case);
        }
        std::fs::write(file, Square::new(self, channel(channel_speed)?)?.vtk(length)?)?;
        let file = file.canonicalize()?.to_string_lossy().into_owned();
        let mut case = case.without("flow").set("flow.kind", "vtk").set("flow.file", file).set("flow.patches", "zone");
        let sides = if self == Self::Meshed { "symmetry" } else { "trap" };
        let walls = [("1", "trap"), ("2", sides), ("3", "escape")].map(|(patch, law)| {
            let entries = [("patch", patch), ("law", law)].map(|(key, value)| (key.to_owned(), value.into()));
            toml::Value::Table(entries.into_iter().collect())
        });
        case = case.set("wall", walls.to_vec());
        let meters = |v: [f64; 3]| toml::Value::from(v.to_vec());
        let wide = HEIGHT - 1e-3;
        for injection in case.list("injection") {
            let mut patch = toml::Table::new();
            patch.insert("corner".into(), meters([1e-4, 5e-4, 5e-4]));
            patch.insert("sides".into(), vec![meters([0.0, wide, 0.0]), meters([0.0, 0.0, wide])].into());
            let position: toml::Table = [("patch".to_owned(), patch.into())].into_iter().collect();
            injection.insert("position".into(), position.into());
        }
        Ok(case)
    }
}

fn channel(speed: f64) -> Result<Channel> {
    Ok(Channel::new(Profile::Turbulent, HEIGHT, speed, &air()?)?)
}

/// Mean speed of the square, m/s: the channel's velocity at d has the share 2 (1 − d/δ)/δ of the section.
fn square_mean(channel: &Channel) -> f64 {
    // finer towards the wall: d/δ = s³, at the middles of equal steps of s
    let n = 20_000;
    let share = |i: usize| {
        let s = (i as f64 + 0.5) / n as f64;
        let d = s * s * s;
        channel.velocity([0.0, 0.5 * HEIGHT * d, 0.0])[0] * 2.0 * (1.0 - d) * 3.0 * s * s
    };
    (0..n).map(share).sum::<f64>() / n as f64
}

/// From wall to wall, finer towards both, m.
fn nodes(first: f64) -> Vec<f64> {
    let length = |ratio: f64| (0..LAYERS).map(|i| first * ratio.powi(i as i32)).sum::<f64>();
    let (mut low, mut high) = (1.0, 3.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if length(middle) < 0.5 * HEIGHT { low = middle } else { high = middle }
    }
    let thick = (0..LAYERS).map(|i| first * low.powi(i as i32));
    let half: Vec<f64> = std::iter::once(0.0)
        .chain(thick.scan(0.0, |at, d| {
            *at += d;
            Some(*at)
        }))
        .collect();
    let scale = 0.5 * HEIGHT / half[LAYERS];
    let lower = half.iter().map(|y| y * scale);
    lower.chain(half.iter().rev().skip(1).map(|y| HEIGHT - y * scale)).collect()
}

impl Square {
    fn new(section: Section, channel: Channel) -> Result<Self> {
        let unit = Self { channel, section, strength: 1.0 };
        let Section::Square(share) = section else { return Ok(Self { strength: 0.0, ..unit }) };
        let grid = linspace(0.0, HEIGHT, 201);
        let speeds = grid.iter().flat_map(|y| grid.iter().map(|z| unit.secondary(*y, *z)));
        let greatest = speeds.map(|[v, w]| v.hypot(w)).fold(0.0, f64::max);
        Ok(Self { strength: share * square_mean(&unit.channel) / greatest, ..unit })
    }

    /// v and w, m/s.
    fn secondary(&self, y: f64, z: f64) -> [f64; 2] {
        if self.strength == 0.0 {
            return [0.0; 2];
        }
        let half = 0.5 * HEIGHT;
        let damping = |y: f64| {
            let local = self.channel.sample([0.0, y, 0.0]);
            let top = self.channel.velocity([0.0, half, 0.0])[0];
            [local.velocity[0] / top, local.gradient[0][1] / top]
        };
        let waves = |y: f64| {
            let (s, c) = (PI * (y / half - 1.0)).sin_cos();
            // sin and sin of twice the angle, and their slopes
            [s, 2.0 * s * c, PI / half * c, 2.0 * PI / half * (2.0 * c * c - 1.0)]
        };
        let ([f, f_y], [g, g_z]) = (damping(y), damping(z));
        let ([a, b, a_y, b_y], [p, q, p_z, q_z]) = (waves(y), waves(z));
        let psi = b * p - a * q;
        let (psi_y, psi_z) = (b_y * p - a_y * q, b * p_z - a * q_z);
        [f * (psi_z * g + psi * g_z), -g * (psi_y * f + psi * f_y)].map(|v| v * self.strength)
    }

    /// A legacy file of VTK.
    fn vtk(&self, length: f64) -> Result<String> {
        let unit = air()?.kinematic_viscosity() / self.channel.friction_velocity();
        let across = nodes(FIRST * unit);
        let along = linspace(0.0, length, (length / CELL).round() as usize + 1);
        let (n, m) = (across.len(), along.len());
        let at = |i: usize, j: usize, k: usize| (i * n + j) * n + k;
        let mut cells: Vec<(u8, i32, Vec<usize>)> = Vec::new();
        for (i, j, k) in grid(m - 1, n - 1, n - 1) {
            let corner = |d: usize| at(i + (d & 1), j + (d >> 1 & 1), k + (d >> 2));
            cells.push((12, 0, [0, 1, 3, 2, 4, 5, 7, 6].map(corner).to_vec()));
        }
        for (i, a, _) in grid(m - 1, n - 1, 1) {
            for end in [0, n - 1] {
                cells.push((9, 1, vec![at(i, end, a), at(i + 1, end, a), at(i + 1, end, a + 1), at(i, end, a + 1)]));
                cells.push((9, 2, vec![at(i, a, end), at(i + 1, a, end), at(i + 1, a + 1, end), at(i, a + 1, end)]));
            }
        }
        for (j, k, _) in grid(n - 1, n - 1, 1) {
            for end in [0, m - 1] {
                cells.push((9, 3, vec![at(end, j, k), at(end, j + 1, k), at(end, j + 1, k + 1), at(end, j, k + 1)]));
            }
        }
        let places: Vec<[f64; 3]> = grid(m, n, n).map(|(i, j, k)| [along[i], across[j], across[k]]).collect();
        let mut out = String::from("# vtk DataFile Version 3.0\nA duct\nASCII\nDATASET UNSTRUCTURED_GRID\n");
        writeln!(out, "POINTS {} double", places.len())?;
        for [x, y, z] in &places {
            writeln!(out, "{x} {y} {z}")?;
        }
        let numbers: usize = cells.iter().map(|(_, _, corners)| corners.len() + 1).sum();
        writeln!(out, "CELLS {} {numbers}", cells.len())?;
        for (_, _, corners) in &cells {
            write!(out, "{}", corners.len())?;
            corners.iter().try_for_each(|c| write!(out, " {c}"))?;
            out.push('\n');
        }
        writeln!(out, "CELL_TYPES {}", cells.len())?;
        cells.iter().try_for_each(|(kind, ..)| writeln!(out, "{kind}"))?;
        writeln!(out, "CELL_DATA {}\nSCALARS zone int 1\nLOOKUP_TABLE default", cells.len())?;
        cells.iter().try_for_each(|(_, zone, _)| writeln!(out, "{zone}"))?;
        self.fields(&mut out, &places)?;
        Ok(out)
    }

    fn fields(&self, out: &mut String, places: &[[f64; 3]]) -> Result<()> {
        let nearest = |[_, y, z]: &[f64; 3]| {
            let d = y.min(HEIGHT - y);
            let d = if self.section == Section::Meshed { d } else { d.min(*z).min(HEIGHT - z) };
            self.channel.sample([0.0, d, 0.0])
        };
        writeln!(out, "POINT_DATA {}\nVECTORS U double", places.len())?;
        for x in places {
            let [v, w] = self.secondary(x[1], x[2]);
            writeln!(out, "{} {v:e} {w:e}", nearest(x).velocity[0])?;
        }
        writeln!(out, "SCALARS k double 1\nLOOKUP_TABLE default")?;
        places.iter().try_for_each(|x| writeln!(out, "{:e}", nearest(x).k))?;
        writeln!(out, "SCALARS epsilon double 1\nLOOKUP_TABLE default")?;
        places.iter().try_for_each(|x| writeln!(out, "{:e}", nearest(x).epsilon))?;
        Ok(())
    }
}

fn grid(a: usize, b: usize, c: usize) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..a).flat_map(move |i| (0..b).flat_map(move |j| (0..c).map(move |k| (i, j, k))))
}
