//! What happened on each triangle of the walls that have them; triangles that nothing met take no room.

use super::pairs;
use crate::exact_sum::ExactSum;
use crate::record::{Event, ImpactRecord};
use crate::summary::Amount;
use std::collections::BTreeMap;

/// Index of a wall, and of a face of it in the order of its file.
pub(crate) type Face = (u32, u32);

/// What happened on a face.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct FaceTally {
    /// Impacts on it, the last ones included.
    pub impacts: u64,
    /// Of these impacts: the spheres they stand for, and sums of speed, m/s, and of the angle from the surface, rad, weighted
    /// by them.
    weight: ExactSum,
    speed: ExactSum,
    angle: ExactSum,
    /// What it kept.
    pub kept: Amount,
    /// The same by size bin, where that is asked for; bins of which it kept nothing take no room.
    #[serde(with = "pairs", default)]
    sizes: BTreeMap<u32, Amount>,
    /// What impacts took away of it, kg.
    eroded: ExactSum,
}

/// What an impact brings to a face besides itself.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Brought {
    /// Mass of what hits, kg.
    pub mass: f64,
    /// Mass of wall that it takes away, kg, where the wall has a law of erosion.
    pub eroded: Option<f64>,
    /// Size bin, where faces count by size.
    pub size: Option<u32>,
}

impl FaceTally {
    fn merge(&mut self, other: &Self) {
        self.impacts += other.impacts;
        self.weight.merge(&other.weight);
        self.speed.merge(&other.speed);
        self.angle.merge(&other.angle);
        self.kept.merge(&other.kept);
        self.eroded.merge(&other.eroded);
        for (size, amount) in &other.sizes {
            self.sizes.entry(*size).or_default().merge(amount);
        }
    }

    /// Mass of the wall that impacts took away here, kg.
    pub fn eroded(&self) -> f64 {
        self.eroded.value()
    }

    /// What it kept of a size bin.
    pub fn kept_of(&self, size: u32) -> Option<&Amount> {
        self.sizes.get(&size)
    }

    /// Mean speed of the impacts, m/s, relative to the wall.
    pub fn mean_speed(&self) -> f64 {
        self.speed.value() / self.weight.value()
    }

    /// Mean angle of the impacts from the surface, rad.
    pub fn mean_angle(&self) -> f64 {
        self.angle.value() / self.weight.value()
    }
}

/// The faces that something met.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Faces(#[serde(with = "pairs")] BTreeMap<Face, FaceTally>);

impl Faces {
    /// What happened on a face of a wall, if anything did.
    pub fn get(&self, wall: usize, face: u32) -> Option<&FaceTally> {
        self.0.get(&(wall as u32, face))
    }

    /// All of them: index of the wall, index of the face, tally.
    pub fn iter(&self) -> impl Iterator<Item = (usize, u32, &FaceTally)> {
        self.0.iter().map(|((wall, face), tally)| (*wall as usize, *face, tally))
    }

    pub(crate) fn impact(&mut self, impact: &ImpactRecord, brought: &Brought) {
        let Some(face) = impact.face else { return };
        let tally = self.0.entry((impact.wall as u32, face)).or_default();
        let (across, along, weight) = (impact.normal_speed_in, impact.tangential_speed_in, impact.weight);
        tally.impacts += 1;
        tally.weight.add(weight);
        tally.speed.add(weight * (across * across + along * along).sqrt());
        tally.angle.add(weight * carom::math::atan2(across, along));
        if matches!(impact.event, Event::Capture | Event::Settle | Event::Trap) {
            tally.kept.add(brought.mass);
            if let Some(size) = brought.size {
                tally.sizes.entry(size).or_default().add(brought.mass);
            }
        }
        if let Some(eroded) = brought.eroded {
            tally.eroded.add(eroded);
        }
    }

    pub(crate) fn merge(&mut self, other: &Self) {
        for (face, tally) in &other.0 {
            self.0.entry(*face).or_default().merge(tally);
        }
    }
}
