//! One impact on a wall that scatters: facet after facet until the sphere leaves the mean wall or stays.

use super::{WallLaw, checks};
use crate::impact::{Energy, Fate, Impact, ImpactError, Outcome, Vec3};
use crate::scatter::Scatter;
use crate::vector::{add_scaled, dot, norm};

impl WallLaw {
    #[cold]
    pub(super) fn rough_impact(&self, scatter: &Scatter, impact: &Impact) -> Result<Outcome, ImpactError> {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("fma") {
            // SAFETY: the processor has the features the function is compiled for, as was just asked.
            return unsafe { rough_fma(self, scatter, impact) };
        }
        self.rough_body(scatter, impact)
    }

    #[inline(always)]
    fn rough_body(&self, scatter: &Scatter, impact: &Impact) -> Result<Outcome, ImpactError> {
        let square = dot(&impact.normal, &impact.normal);
        let normal = if checks::is_unit(square) { impact.normal } else { checks::unit(&impact.normal, square)? };
        let size = self.size(impact.diameter, impact.density)?;
        let coming = relative(&impact.velocity, &impact.wall_velocity);
        let rotational = 0.4 * (size.radius * size.radius) * dot(&impact.spin, &impact.spin);
        checks::approach(-dot(&coming, &normal), dot(&coming, &coming) + rotational)?;

        let [a, b, c, d] = impact.draws;
        if !impact.draws.iter().all(|u| (0.0..1.0).contains(u)) {
            return Err(ImpactError::NotFinite);
        }
        // in the wall's own frame, so that a moving wall costs no digits more than once
        let mut motion = Impact { normal, velocity: coming, wall_velocity: [0.0; 3], ..*impact };
        let mut path = Path::default();
        // the mean wall comes last: off it no rebound leads into it
        for draws in [Some([a, b]), Some([c, d]), None] {
            motion.normal = draws.map_or(normal, |draws| scatter.facet(&motion.velocity, &normal, draws));
            let met = match self.smooth_impact(&motion) {
                // a facet so steep that rounding hides the approach
                Err(ImpactError::NotApproaching) => match self.smooth_impact(&Impact { normal, ..motion }) {
                    Err(ImpactError::NotApproaching) if path.last.is_some() => break,
                    other => other?,
                },
                other => other?,
            };
            path.add(&met);
            (motion.velocity, motion.spin) = (met.velocity, met.spin);
            if met.fate == Fate::Capture || dot(&met.velocity, &normal) > 0.0 {
                break;
            }
        }
        path.against(&coming, &normal, &impact.wall_velocity).ok_or(ImpactError::NotApproaching)
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "fma")]
fn rough_fma(law: &WallLaw, scatter: &Scatter, impact: &Impact) -> Result<Outcome, ImpactError> {
    law.rough_body(scatter, impact)
}

fn relative(velocity: &Vec3, wall: &Vec3) -> Vec3 {
    [velocity[0] - wall[0], velocity[1] - wall[1], velocity[2] - wall[2]]
}

/// The impacts so far: the last outcome, and the energy they took of what came in.
#[derive(Default)]
struct Path {
    last: Option<Outcome>,
    energy: Energy,
}

impl Path {
    fn add(&mut self, met: &Outcome) {
        let share = if self.last.is_some() { self.energy.kept } else { 1.0 };
        let (sum, new) = (&self.energy, &met.energy);
        let add = |before: f64, now: f64| share.mul_add(now, before);
        self.energy = Energy {
            adhesion: add(sum.adhesion, new.adhesion),
            adhesion_damping: add(sum.adhesion_damping, new.adhesion_damping),
            hertz_damping: add(sum.hertz_damping, new.hertz_damping),
            plastic: add(sum.plastic, new.plastic),
            other: add(sum.other, new.other),
            friction: add(sum.friction, new.friction),
            captured: share * new.captured,
            kept: share * new.kept,
        };
        let validity = self.last.map_or(met.validity, |l| l.validity.with(met.validity));
        self.last = Some(Outcome { validity, ..*met });
    }

    /// The outcome in terms of the mean wall, for a sphere that came in at `coming` in its frame.
    fn against(self, coming: &Vec3, normal: &Vec3, wall: &Vec3) -> Option<Outcome> {
        let last = self.last?;
        let leaving = last.velocity;
        let velocity = std::array::from_fn(|i| leaving[i] + wall[i]);
        let out = Outcome { energy: self.energy, velocity, ..last };
        if out.fate == Fate::Capture {
            return Some(out);
        }
        let v_n = -dot(coming, normal);
        let up = dot(&leaving, normal).max(0.0);
        let (before, after) = (add_scaled(coming, v_n, normal), add_scaled(&leaving, -up, normal));
        let along = dot(&before, &before);
        Some(Outcome {
            restitution: up / v_n,
            impulse_ratio: norm(&relative(&after, &before)) / (v_n + up),
            tangential_restitution: if along > 0.0 { dot(&after, &before) / along } else { f64::NAN },
            ..out
        })
    }
}
