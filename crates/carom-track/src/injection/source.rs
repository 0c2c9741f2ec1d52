//! Places to start from, filled evenly at random.

use super::{InjectionError, finite3, positive};
use crate::random::Stream;
use crate::vector::{Vec3, add, cross, frame, norm, scale, sub, unit};
use std::sync::Arc;

/// Where spheres start.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// One point, m.
    Point([f64; 3]),
    /// The inside of a box along the axes; an extent may be zero.
    Box {
        /// Lower corner, m.
        low: [f64; 3],
        /// Upper corner, m.
        high: [f64; 3],
    },
    /// A disc.
    Disc {
        /// m.
        centre: [f64; 3],
        /// Any length.
        normal: [f64; 3],
        /// m.
        radius: f64,
    },
    /// A parallelogram.
    Patch {
        /// m.
        corner: [f64; 3],
        /// The two sides from the corner, m.
        sides: [[f64; 3]; 2],
    },
    /// A triangulated surface, evenly by area.
    Triangles(Vec<[[f64; 3]; 3]>),
    /// An opening of a space, evenly by area; its triangles turn so that they face into the space.
    Opening {
        /// Corners, m.
        triangles: Vec<[[f64; 3]; 3]>,
        /// How far inside centres start, radii.
        inset: f64,
    },
    /// One sphere after the other, each with its own start.
    Listed(Arc<[Listed]>),
}

impl Source {
    /// Whether it is an opening.
    pub fn is_opening(&self) -> bool {
        matches!(self, Self::Opening { .. })
    }
}

/// A sphere's own start; what is `None` is the plan's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Listed {
    /// m.
    pub position: [f64; 3],
    /// m/s.
    pub velocity: Option<[f64; 3]>,
    /// m.
    pub diameter: Option<f64>,
    /// How many spheres it stands for.
    pub weight: f64,
    /// s.
    pub time: Option<f64>,
}

/// A checked source.
#[derive(Clone, Debug)]
pub(super) enum Place {
    Point(Vec3),
    Box {
        low: Vec3,
        extent: Vec3,
    },
    Disc {
        centre: Vec3,
        across: [Vec3; 2],
    },
    Patch {
        corner: Vec3,
        sides: [Vec3; 2],
    },
    /// Cumulative area, rising to 1, and a triangle as a corner and two sides.
    Triangles(Vec<(f64, Vec3, [Vec3; 2])>),
}

impl Place {
    pub fn new(source: &Source) -> Result<Self, InjectionError> {
        match source {
            Source::Point(x) => finite3("injection point", *x).map(|()| Self::Point(*x)),
            Source::Box { low, high } => {
                finite3("lower corner of the box", *low)?;
                finite3("upper corner of the box", *high)?;
                let extent = sub(*high, *low);
                match extent.iter().find(|e| **e < 0.0) {
                    Some(e) => {
                        Err(InjectionError::value("extent of the box", *e, "zero or positive: lower corner first"))
                    }
                    None => Ok(Self::Box { low: *low, extent }),
                }
            }
            Source::Disc { centre, normal, radius } => {
                finite3("disc centre", *centre)?;
                positive("disc radius", *radius)?;
                let n = unit(*normal).ok_or(InjectionError::Shape {
                    name: "disc normal",
                    what: "must be a finite vector that is not zero",
                })?;
                let (t, b) = frame(n);
                Ok(Self::Disc { centre: *centre, across: [scale(t, *radius), scale(b, *radius)] })
            }
            Source::Patch { corner, sides } => {
                finite3("patch corner", *corner)?;
                if area(sides) > 0.0 && area(sides).is_finite() {
                    Ok(Self::Patch { corner: *corner, sides: *sides })
                } else {
                    Err(InjectionError::Shape {
                        name: "patch",
                        what: "has no area: give two sides that are not parallel",
                    })
                }
            }
            Source::Triangles(triangles) | Source::Opening { triangles, .. } => surface(triangles),
            Source::Listed(list) => listed(list),
        }
    }

    /// A point of it, and of a surface the direction it faces there.
    pub fn point(&self, draws: &mut Stream) -> (Vec3, Vec3) {
        let x = match self {
            Self::Point(x) => *x,
            Self::Box { low, extent } => {
                let u: Vec3 = draws.uniforms();
                std::array::from_fn(|i| low[i] + extent[i] * u[i])
            }
            Self::Disc { centre, across } => {
                let [a, b] = in_disc(draws);
                add(*centre, add(scale(across[0], a), scale(across[1], b)))
            }
            Self::Patch { corner, sides } => {
                let [a, b] = draws.uniforms();
                add(*corner, add(scale(sides[0], a), scale(sides[1], b)))
            }
            Self::Triangles(triangles) => {
                let [which, mut a, mut b] = draws.uniforms();
                let i = triangles.partition_point(|t| t.0 <= which).min(triangles.len() - 1);
                let (_, corner, sides) = &triangles[i];
                if a + b > 1.0 {
                    // the far half of the parallelogram folds onto the triangle
                    (a, b) = (1.0 - a, 1.0 - b);
                }
                let facing = unit(cross(sides[0], sides[1])).unwrap_or_default();
                return (add(*corner, add(scale(sides[0], a), scale(sides[1], b))), facing);
            }
        };
        (x, [0.0; 3])
    }
}

/// A point of the unit disc: the first of a square's points that falls in it, so that no sine is needed.
fn in_disc(draws: &mut Stream) -> [f64; 2] {
    loop {
        let [a, b] = draws.uniforms().map(|u: f64| 2.0 * u - 1.0);
        if a * a + b * b <= 1.0 {
            return [a, b];
        }
    }
}

fn area(sides: &[Vec3; 2]) -> f64 {
    norm(cross(sides[0], sides[1]))
}

fn surface(triangles: &[[Vec3; 3]]) -> Result<Place, InjectionError> {
    let mut sum = 0.0;
    let mut out = Vec::with_capacity(triangles.len());
    for [a, b, c] in triangles {
        let sides = [sub(*b, *a), sub(*c, *a)];
        let size = area(&sides);
        if !size.is_finite() {
            return Err(InjectionError::Shape { name: "injection surface", what: "has a corner that is not finite" });
        }
        if size > 0.0 {
            sum += size;
            out.push((sum, *a, sides));
        }
    }
    if out.is_empty() {
        return Err(InjectionError::Shape { name: "injection surface", what: "has no triangle with an area" });
    }
    out.iter_mut().for_each(|t| t.0 /= sum);
    Ok(Place::Triangles(out))
}

/// Checks every start; each is asked for by its number, not drawn.
fn listed(list: &[Listed]) -> Result<Place, InjectionError> {
    for one in list {
        finite3("position of a listed particle", one.position)?;
        one.velocity.map_or(Ok(()), |v| finite3("velocity of a listed particle", v))?;
        one.diameter.map_or(Ok(()), |d| positive("diameter of a listed particle", d))?;
        positive("weight of a listed particle", one.weight)?;
        if let Some(time) = one.time.filter(|t| !(*t >= 0.0 && t.is_finite())) {
            return Err(InjectionError::value("time of a listed particle", time, "finite and not negative"));
        }
    }
    Ok(Place::Point([0.0; 3]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Purpose;
    use crate::vector::dot;

    const SEED: u64 = 5;
    const N: u64 = 20_000;

    fn points(source: Source) -> Vec<Vec3> {
        let place = Place::new(&source).unwrap();
        (0..N).map(|i| place.point(&mut Stream::new(SEED, i, Purpose::Injection, 0)).0).collect()
    }

    fn share(points: &[Vec3], inside: impl Fn(&Vec3) -> bool) -> f64 {
        points.iter().filter(|x| inside(x)).count() as f64 / points.len() as f64
    }

    /// Four standard errors of a share.
    fn close(got: f64, want: f64) -> bool {
        (got - want).abs() < 4.0 * (want * (1.0 - want) / N as f64).sqrt()
    }

    #[test]
    fn boxes_are_filled_evenly() {
        let p = points(Source::Box { low: [0.0, 1.0, 2.0], high: [2.0, 3.0, 2.0] });
        assert!(p.iter().all(|x| (0.0..2.0).contains(&x[0]) && (1.0..3.0).contains(&x[1]) && x[2] == 2.0));
        assert!(close(share(&p, |x| x[0] < 0.5 && x[1] < 2.0), 0.125), "seed {SEED}");
    }

    #[test]
    fn discs_are_filled_evenly() {
        let (centre, n) = ([1.0, 2.0, 3.0], [0.6, 0.0, 0.8]);
        let p = points(Source::Disc { centre, normal: [3.0, 0.0, 4.0], radius: 2.0 });
        assert!(p.iter().all(|x| dot(sub(*x, centre), n).abs() < 1e-14 && norm(sub(*x, centre)) <= 2.0 + 1e-14));
        assert!(close(share(&p, |x| norm(sub(*x, centre)) < 1.0), 0.25), "seed {SEED}");
        assert!(close(share(&p, |x| x[1] > 2.0), 0.5), "seed {SEED}");
    }

    #[test]
    fn surfaces_are_filled_by_area() {
        let patch = points(Source::Patch { corner: [0.0; 3], sides: [[2.0, 0.0, 0.0], [1.0, 1.0, 0.0]] });
        assert!(close(share(&patch, |x| x[1] < 0.25), 0.25), "seed {SEED}");
        // a unit right triangle at z = 0 and one of three times the area at z = 1
        let small = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let large = [[0.0, 0.0, 1.0], [3.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
        let flat = [[0.0; 3]; 3];
        let p = points(Source::Triangles(vec![flat, small, large]));
        assert!(close(share(&p, |x| x[2] == 0.0), 0.25), "seed {SEED}");
        assert!(p.iter().all(|x| x[0] / if x[2] == 0.0 { 1.0 } else { 3.0 } + x[1] <= 1.0 + 1e-15));
        // a quarter of a triangle's area lies beyond half its height
        assert!(close(share(&p, |x| x[1] > 0.5), 0.25), "seed {SEED}");
    }

    #[test]
    fn refuses_what_has_no_place() {
        for source in [
            Source::Point([f64::NAN, 0.0, 0.0]),
            Source::Box { low: [1.0; 3], high: [0.0; 3] },
            Source::Disc { centre: [0.0; 3], normal: [0.0, 1.0, 0.0], radius: 0.0 },
            Source::Patch { corner: [0.0; 3], sides: [[1.0, 0.0, 0.0]; 2] },
            Source::Triangles(vec![[[0.0; 3]; 3]]),
            Source::Triangles(vec![]),
        ] {
            assert!(Place::new(&source).is_err(), "{source:?}");
        }
    }
}
