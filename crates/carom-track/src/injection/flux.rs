//! Starts in proportion to the fluid's velocity through an area, as an aerosol of even concentration enters it.
//!
//! The density of starts is u·n/∫u·n dA where u·n > 0, n the direction of the inflow: along a disc's normal, into a box
//! through its six faces, through a patch or a surface the way that more fluid goes. Exact, by rejection: the area is cut into
//! tiles, each with a bound of the speed on it; a tile is drawn by area times bound, a point of it evenly, and kept with
//! probability u·n/bound. Every draw belongs to (seed, particle), so the starts are the same for any shard.

use super::{InjectionError, Source};
use crate::flow::Flow;
use crate::random::Stream;
use crate::vector::{Vec3, add, cross, dot, frame, norm, scale, sub, unit};

/// Tiles along each side of an area.
const TILES: usize = 16;
/// Points along each side of a tile at which the flow is looked at for whether anything flows in.
const LOOKS: usize = 4;

/// An area through which fluid flows in.
#[derive(Clone, Debug)]
pub(super) struct Inflow {
    tiles: Vec<Tile>,
    /// Sums of area times bound, rising to 1.
    shares: Vec<f64>,
    /// Centre and square of the radius, where only a disc of the tiles counts.
    disc: Option<(Vec3, f64)>,
    /// Flow out of the area over flow into it.
    outflow: f64,
}

#[derive(Clone, Copy, Debug)]
struct Tile {
    corner: Vec3,
    sides: [Vec3; 2],
    /// Of length 1, the way the fluid is to flow.
    normal: Vec3,
    triangle: bool,
    bound: f64,
}

impl Tile {
    fn area(&self) -> f64 {
        norm(cross(self.sides[0], self.sides[1])) * if self.triangle { 0.5 } else { 1.0 }
    }

    fn at(&self, mut a: f64, mut b: f64) -> Vec3 {
        if self.triangle && a + b > 1.0 {
            // the far half of the parallelogram folds onto the triangle
            (a, b) = (1.0 - a, 1.0 - b);
        }
        add(self.corner, add(scale(self.sides[0], a), scale(self.sides[1], b)))
    }

    fn bounded(mut self, flow: &Flow) -> Self {
        let [s, t] = self.sides;
        let corners = [self.corner, add(self.corner, s), add(self.corner, t), add(self.corner, add(s, t))];
        let around = |pick: fn(f64, f64) -> f64| {
            [0, 1, 2].map(|c: usize| corners.iter().map(|x| x[c]).reduce(pick).unwrap_or_default())
        };
        self.bound = flow.fastest([around(f64::min), around(f64::max)]);
        self
    }
}

impl Inflow {
    /// The inflow of a source that was found to be one.
    pub fn new(source: &Source, flow: &Flow) -> Result<Self, InjectionError> {
        let mut disc = None;
        let (tiles, turns) = match source {
            Source::Point(_) | Source::Listed(_) => {
                return Err(InjectionError::Shape {
                    name: "injection by flux",
                    what: "needs an area, and a point has none: give a disc, a patch or a box",
                });
            }
            Source::Box { low, high } => (faces(*low, sub(*high, *low)), false),
            Source::Disc { centre, normal, radius } => {
                let n = unit(*normal).unwrap_or([0.0, 1.0, 0.0]);
                let (t, b) = frame(n);
                let sides = [scale(t, 2.0 * radius), scale(b, 2.0 * radius)];
                let corner = sub(*centre, scale(add(sides[0], sides[1]), 0.5));
                disc = Some((*centre, radius * radius));
                (cut(corner, sides, n), false)
            }
            Source::Patch { corner, sides } => {
                (cut(*corner, *sides, unit(cross(sides[0], sides[1])).unwrap_or_default()), true)
            }
            Source::Triangles(triangles) => (triangles.iter().filter_map(|t| triangle(*t)).collect(), true),
            Source::Opening { triangles, .. } => (triangles.iter().filter_map(|t| triangle(*t)).collect(), false),
        };
        let mut inflow = Self { tiles, shares: Vec::new(), disc, outflow: 0.0 };
        let [mut forward, mut back] = inflow.look(flow);
        if turns && back > forward {
            inflow.tiles.iter_mut().for_each(|t| t.normal = scale(t.normal, -1.0));
            (forward, back) = (back, forward);
        }
        if forward <= 0.0 {
            let what = match (back > 0.0, source) {
                (true, Source::Disc { .. }) => {
                    "has nothing to follow: the fluid flows against the disc's normal everywhere; turn the normal round"
                }
                _ => "has nothing to follow: no fluid flows in there",
            };
            return Err(InjectionError::Shape { name: "injection by flux", what });
        }
        inflow.outflow = back / forward;
        inflow.tiles = inflow.tiles.iter().map(|t| t.bounded(flow)).filter(|t| t.bound * t.area() > 0.0).collect();
        let mut sum = 0.0;
        inflow.shares = inflow.tiles.iter().map(|t| (sum += t.area() * t.bound, sum).1).collect();
        inflow.shares.iter_mut().for_each(|s| *s /= sum);
        Ok(inflow)
    }

    /// Flow out of the area over flow into it, about.
    pub fn outflow(&self) -> f64 {
        self.outflow
    }

    /// Flow along the normals and against them, about.
    fn look(&self, flow: &Flow) -> [f64; 2] {
        let mut sums = [0.0; 2];
        let middle = |i: usize| (i as f64 + 0.5) / LOOKS as f64;
        for tile in &self.tiles {
            let part = tile.area() / (LOOKS * LOOKS) as f64;
            for (i, j) in (0..LOOKS * LOOKS).map(|n| (n / LOOKS, n % LOOKS)) {
                let x = tile.at(middle(i), middle(j));
                if self.counts(x) {
                    let through = part * dot(flow.velocity(x), tile.normal);
                    sums[usize::from(through < 0.0)] += through.abs();
                }
            }
        }
        sums
    }

    fn counts(&self, x: Vec3) -> bool {
        self.disc.is_none_or(|(centre, square)| {
            let d = sub(x, centre);
            dot(d, d) <= square
        })
    }

    /// A start and the way the fluid flows in there; the fluid's velocity is asked where one is tried.
    pub fn point(&self, draws: &mut Stream, velocity: impl Fn(Vec3) -> Vec3) -> (Vec3, Vec3) {
        loop {
            let [which, a, b, keep] = draws.uniforms();
            let tile = &self.tiles[self.shares.partition_point(|s| *s <= which).min(self.tiles.len() - 1)];
            let x = tile.at(a, b);
            if self.counts(x) && keep * tile.bound < dot(velocity(x), tile.normal) {
                return (x, tile.normal);
            }
        }
    }
}

/// A parallelogram as tiles.
fn cut(corner: Vec3, sides: [Vec3; 2], normal: Vec3) -> Vec<Tile> {
    let step = sides.map(|s| scale(s, 1.0 / TILES as f64));
    let at = |i: usize, j: usize| add(corner, add(scale(step[0], i as f64), scale(step[1], j as f64)));
    (0..TILES * TILES)
        .map(|n| Tile { corner: at(n / TILES, n % TILES), sides: step, normal, triangle: false, bound: 0.0 })
        .collect()
}

/// The faces of a box that have an area, with their normals inward.
fn faces(low: Vec3, extent: Vec3) -> Vec<Tile> {
    let along = |c: usize, length: f64| [0, 1, 2].map(|i| if i == c { length } else { 0.0 });
    let face = |n: usize| {
        let (c, far) = (n / 2, n % 2 == 1);
        let (i, j) = ((c + 1) % 3, (c + 2) % 3);
        let corner = add(low, along(c, if far { extent[c] } else { 0.0 }));
        let sides = [along(i, extent[i]), along(j, extent[j])];
        (extent[i] * extent[j] > 0.0).then(|| cut(corner, sides, along(c, if far { -1.0 } else { 1.0 })))
    };
    (0..6).filter_map(face).flatten().collect()
}

fn triangle([a, b, c]: [Vec3; 3]) -> Option<Tile> {
    let sides = [sub(b, a), sub(c, a)];
    let normal = unit(cross(sides[0], sides[1]))?;
    Some(Tile { corner: a, sides, normal, triangle: true, bound: 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::{Channel, Fluid, Pipe, Profile, Table};
    use crate::random::Purpose;

    const SEED: u64 = 9;
    const N: u64 = 20_000;

    fn starts(source: &Source, flow: &Flow) -> Vec<Vec3> {
        let inflow = Inflow::new(source, flow).unwrap();
        let draws = |i| Stream::new(SEED, i, Purpose::Injection, 0);
        (0..N).map(|i| inflow.point(&mut draws(i), |x| flow.velocity(x)).0).collect()
    }

    /// χ² of ten classes of equal share, by the distribution function; 27.9 is passed by chance once in a thousand.
    fn even(shares: impl Iterator<Item = f64>) {
        let mut counts = [0.0f64; 10];
        shares.for_each(|s| counts[((s * 10.0) as usize).min(9)] += 1.0);
        let want = N as f64 / 10.0;
        let chi2: f64 = counts.iter().map(|n| (n - want) * (n - want) / want).sum();
        assert!(chi2 < 27.9, "seed {SEED}: {chi2} {counts:?}");
    }

    #[test]
    fn a_laminar_pipe() {
        // u ∝ 1 − r²/R²: a share s = 2q − q² of the flow within r, q = r²/R²
        let (centre, axis, radius) = ([0.1, -0.2, 0.05], [1.0, 2.0, 2.0], 5e-3);
        let pipe = Pipe::new(Profile::Laminar, centre, axis, radius, 0.3, &Fluid::default()).unwrap();
        let points = starts(&Source::Disc { centre, normal: axis, radius }, &Flow::Pipe(pipe));
        even(points.iter().map(|x| {
            let q = dot(sub(*x, centre), sub(*x, centre)) / (radius * radius);
            q * (2.0 - q)
        }));
        let (t, b) = frame(unit(axis).unwrap());
        let turn = |x: &Vec3| carom::math::atan2(dot(sub(*x, centre), t), dot(sub(*x, centre), b));
        even(points.iter().map(|x| (turn(x) / std::f64::consts::TAU).rem_euclid(1.0)));
    }

    #[test]
    fn a_laminar_channel_through_a_patch_and_a_box() {
        // u ∝ y(1 − y): a share 3y² − 2y³ below y
        let flow = Flow::Channel(Channel::new(Profile::Laminar, 0.02, 1.0, &Fluid::default()).unwrap());
        let below = |x: &Vec3| {
            let y = x[1] / 0.02;
            y * y * (3.0 - 2.0 * y)
        };
        for sides in [[[0.0, 0.02, 0.0], [0.0, 0.0, 0.01]], [[0.0, 0.0, 0.01], [0.0, 0.02, 0.0]]] {
            let points = starts(&Source::Patch { corner: [0.0; 3], sides }, &flow);
            even(points.iter().map(below));
            even(points.iter().map(|x| x[2] / 0.01));
        }
        let points = starts(&Source::Box { low: [0.3, 0.0, 0.0], high: [0.4, 0.02, 0.01] }, &flow);
        even(points.iter().map(below));
        // it enters by the face upstream alone
        assert!(points.iter().all(|x| x[0] == 0.3));
        let flat = starts(&Source::Box { low: [0.3, 0.0, 0.0], high: [0.3, 0.02, 0.01] }, &flow);
        even(flat.iter().map(below));
    }

    #[test]
    fn only_the_inflow_counts() {
        // u = y through a square from y = −1 to 2: in above 0, a share y²/4 below y; a quarter as much flows out
        let flow = Flow::Table(Table::from_csv("y,u\n-1,-1\n0,0\n2,2\n".as_bytes()).unwrap());
        let source = Source::Disc { centre: [0.0; 3], normal: [-1.0, 0.0, 0.0], radius: 0.5 };
        assert!((Inflow::new(&source, &flow).unwrap().outflow() - 1.0).abs() < 1e-9);
        let patch = Source::Patch { corner: [0.0, -1.0, 0.0], sides: [[0.0, 3.0, 0.0], [0.0, 0.0, 1.0]] };
        assert!((Inflow::new(&patch, &flow).unwrap().outflow() - 0.25).abs() < 0.01);
        even(starts(&patch, &flow).iter().map(|x| 0.25 * x[1] * x[1]));
        let triangles = Source::Triangles(vec![[[0.0; 3], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]]);
        // density y(2 − y): a share (3y² − y³)/4 below y
        even(starts(&triangles, &flow).iter().map(|x| 0.25 * x[1] * x[1] * (3.0 - x[1])));
    }

    #[test]
    fn refuses_where_nothing_flows_in() {
        let wind = Flow::Uniform { velocity: [1.0, 0.0, 0.0] };
        let disc = |normal| Source::Disc { centre: [0.0; 3], normal, radius: 1.0 };
        let refused = |source: &Source, flow: &Flow, words: &str| {
            let error = Inflow::new(source, flow).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        };
        refused(&disc([1.0, 0.0, 0.0]), &Flow::Still, "no fluid flows in there");
        refused(&disc([-1.0, 0.0, 0.0]), &wind, "turn the normal round");
        refused(&disc([0.0, 1.0, 0.0]), &wind, "no fluid flows in there");
        refused(&Source::Point([0.0; 3]), &wind, "needs an area");
        refused(&Source::Box { low: [0.0; 3], high: [1.0, 0.0, 0.0] }, &wind, "no fluid flows in there");
        assert!(Inflow::new(&disc([1.0, 0.0, 0.0]), &wind).is_ok());
    }
}
