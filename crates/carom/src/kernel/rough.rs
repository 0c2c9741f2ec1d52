//! One impact on a wall that scatters: facet after facet until the sphere leaves the mean wall or stays.

use super::{Kernel, Tables, judge};
use crate::impact::{Energy, Fate, Impact, ImpactError, Outcome, Vec3};
use crate::math::Fma;
use crate::scatter::Scatter;
use crate::vector::{add_scaled, dot, minus, norm, plus};

impl Kernel {
    #[inline(always)]
    pub(crate) fn rough_impact<F: Fma>(
        &self,
        f: F,
        tables: &Tables,
        scatter: &Scatter,
        impact: &Impact,
    ) -> Result<Outcome, ImpactError> {
        let normal = judge::unit_normal(f, &impact.normal)?;
        let size = self.size(f, impact.diameter, impact.density)?;
        let coming = minus(&impact.velocity, &impact.wall_velocity);
        let rotational = 0.4 * (size.radius * size.radius) * dot(f, &impact.spin, &impact.spin);
        judge::approach(-dot(f, &coming, &normal), dot(f, &coming, &coming) + rotational)?;

        let [a, b, c, d] = impact.draws;
        if !impact.draws.iter().all(|u| (0.0..1.0).contains(u)) {
            return Err(ImpactError::NotFinite);
        }
        // in the wall's own frame, so that a moving wall costs no digits more than once
        let mut motion = Impact { normal, velocity: coming, wall_velocity: [0.0; 3], ..*impact };
        let mut path = Path::default();
        // the mean wall comes last: off it no rebound leads into it
        for draws in [Some([a, b]), Some([c, d]), None] {
            motion.normal = draws.map_or(normal, |draws| scatter.facet(f, &motion.velocity, &normal, draws));
            let met = match self.smooth_impact(f, tables, &motion) {
                // a facet so steep that rounding hides the approach
                Err(ImpactError::NotApproaching) => match self.smooth_impact(f, tables, &Impact { normal, ..motion }) {
                    Err(ImpactError::NotApproaching) if path.last.is_some() => break,
                    other => other?,
                },
                other => other?,
            };
            path.add(f, &met);
            (motion.velocity, motion.spin) = (met.velocity, met.spin);
            if met.fate == Fate::Capture || dot(f, &met.velocity, &normal) > 0.0 {
                break;
            }
        }
        path.against(f, &coming, &normal, &impact.wall_velocity).ok_or(ImpactError::NotApproaching)
    }
}

/// The impacts so far: the last outcome, and the energy they took of what came in.
#[derive(Default)]
struct Path {
    last: Option<Outcome>,
    energy: Energy,
}

impl Path {
    fn add<F: Fma>(&mut self, f: F, met: &Outcome) {
        let share = if self.last.is_some() { self.energy.kept } else { 1.0 };
        let (sum, new) = (&self.energy, &met.energy);
        let add = |before: f64, now: f64| f.fma(share, now, before);
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
    fn against<F: Fma>(self, f: F, coming: &Vec3, normal: &Vec3, wall: &Vec3) -> Option<Outcome> {
        let last = self.last?;
        let leaving = last.velocity;
        let velocity = plus(&leaving, wall);
        let out = Outcome { energy: self.energy, velocity, ..last };
        if out.fate == Fate::Capture {
            return Some(out);
        }
        let v_n = -dot(f, coming, normal);
        let up = dot(f, &leaving, normal).max(0.0);
        let (before, after) = (add_scaled(f, coming, v_n, normal), add_scaled(f, &leaving, -up, normal));
        let along = dot(f, &before, &before);
        Some(Outcome {
            restitution: up / v_n,
            impulse_ratio: norm(f, &minus(&after, &before)) / (v_n + up),
            tangential_restitution: if along > 0.0 { dot(f, &after, &before) / along } else { f64::NAN },
            ..out
        })
    }
}
