//! What a run tells as it goes.

pub(crate) mod columns;
pub(crate) mod text;

use crate::tracker::Particle;
use crate::vector::Vec3;
use carom::removal::Mode;

/// How a particle ends; what a single impact comes to is [`carom::Fate`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ParticleFate {
    /// Held by adhesion.
    Captured,
    /// At rest on a wall, its bounces below the stated height.
    Settled,
    /// It met a `trap` wall.
    Trapped,
    /// It left through an `escape` wall.
    Escaped,
    /// Still flying when the run ended.
    Airborne,
    /// Caught by a wall and taken off it again by the flow; where it goes then is not followed.
    Removed,
    /// In contact with a wall and still moving along it when the run ended.
    Sliding,
    /// It started where a wall is, and was not followed.
    Overlapping,
    /// Lost in a broken mesh, in the cell it was last in.
    Stuck,
}

impl ParticleFate {
    /// All of them, in the order of the results.
    pub const ALL: [Self; 9] = [
        Self::Captured,
        Self::Settled,
        Self::Trapped,
        Self::Escaped,
        Self::Airborne,
        Self::Removed,
        Self::Sliding,
        Self::Overlapping,
        Self::Stuck,
    ];

    /// Those of spheres that end at a wall.
    pub const AT_WALLS: [Self; 7] =
        [Self::Captured, Self::Settled, Self::Trapped, Self::Escaped, Self::Removed, Self::Sliding, Self::Overlapping];

    /// The word in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Captured => "captured",
            Self::Settled => "settled",
            Self::Trapped => "trapped",
            Self::Escaped => "escaped",
            Self::Airborne => "airborne",
            Self::Removed => "removed",
            Self::Sliding => "sliding",
            Self::Overlapping => "overlapping",
            Self::Stuck => "stuck",
        }
    }
}

/// What an impact led to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// It flies on.
    Rebound,
    /// Adhesion holds it.
    Capture,
    /// Its next bounce would rise less than the stated height: it stays.
    Settle,
    /// The wall traps all.
    Trap,
    /// It leaves the domain.
    Escape,
    /// It would stay, but the flow takes it off again.
    Remove(Mode),
    /// Contact motion ends: the sphere rolls off the wall.
    RollOff,
    /// Contact motion ends: the sphere slides off the wall.
    SlideOff,
    /// Contact motion ends: nothing presses the sphere against the wall any more.
    LiftOff,
}

impl Event {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Rebound,
        Self::Capture,
        Self::Settle,
        Self::Trap,
        Self::Escape,
        Self::Remove(Mode::Rolling),
        Self::Remove(Mode::Sliding),
        Self::Remove(Mode::Lifting),
        Self::RollOff,
        Self::SlideOff,
        Self::LiftOff,
    ];

    /// Its place among [`Event::ALL`].
    pub(crate) fn index(self) -> u32 {
        let place = Self::ALL.iter().position(|event| *event == self);
        debug_assert!(place.is_some(), "{self:?} is not among all events");
        place.map_or(columns::NO_WORD, |place| place as u32)
    }

    /// The word in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rebound => "rebound",
            Self::Capture => "capture",
            Self::Settle => "settle",
            Self::Trap => "trap",
            Self::Escape => "escape",
            Self::Remove(Mode::Rolling) | Self::RollOff => "roll-off",
            Self::Remove(Mode::Sliding) | Self::SlideOff => "slide-off",
            Self::Remove(Mode::Lifting) | Self::LiftOff => "lift-off",
        }
    }
}

/// One impact, speeds relative to the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactRecord {
    /// The particle's number.
    pub particle: u64,
    /// Time, s.
    pub time: f64,
    /// Centre of the sphere, m.
    pub position: Vec3,
    /// Unit normal of the wall.
    pub normal: Vec3,
    /// Index of the wall.
    pub wall: usize,
    /// The wall's face in the order of its file, where it is made of triangles.
    pub face: Option<u32>,
    /// Diameter, m.
    pub diameter: f64,
    /// Real particles it stands for.
    pub weight: f64,
    /// Speed towards the wall, m/s.
    pub normal_speed_in: f64,
    /// Speed along the wall, m/s.
    pub tangential_speed_in: f64,
    /// Spin, rad/s, positive when it rolls forward.
    pub spin_in: f64,
    /// e; NaN where the wall has none.
    pub restitution: f64,
    /// Impulse ratio; NaN where there is none.
    pub impulse_ratio: f64,
    /// What it led to.
    pub event: Event,
    /// Speed from the wall, m/s; through it for an escape.
    pub normal_speed_out: f64,
    /// Speed along the wall, m/s.
    pub tangential_speed_out: f64,
    /// Spin, rad/s.
    pub spin_out: f64,
    /// Where the incident energy went, as fractions; all zero where no law decides.
    pub energy: carom::Energy,
    /// What to mind about the law's answer.
    pub validity: carom::Validity,
}

/// How a particle ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// As it was injected.
    pub particle: Particle,
    /// Its fate.
    pub fate: ParticleFate,
    /// The wall that ended it.
    pub wall: Option<usize>,
    /// When, s.
    pub time: f64,
    /// Where, m.
    pub position: Vec3,
    /// Velocity then, m/s.
    pub velocity: Vec3,
    /// Spin then, rad/s.
    pub spin: Vec3,
    /// Trial steps it took.
    pub steps: u64,
    /// Of a sphere that got stuck, the cell of the mesh that it was last in; none where it began outside the mesh.
    pub cell: Option<u32>,
}

/// Who listens to a run. Events of one particle come in order.
pub trait Sink {
    /// A particle begins; `true` if the points of its path are wanted.
    fn start(&mut self, _particle: &Particle) -> bool {
        false
    }
    /// An impact.
    fn impact(&mut self, _impact: &ImpactRecord) {}
    /// The end of a contact motion that lasted: no impact, but a row like one. Its incoming speeds are those at the beginning. Taken as
    /// an impact unless the listener tells them apart.
    fn contact_ended(&mut self, row: &ImpactRecord) {
        self.impact(row);
    }
    /// A point of a wanted path.
    fn point(&mut self, _particle: u64, _time: f64, _position: Vec3, _velocity: Vec3, _spin: Vec3) {}
    /// A particle ended.
    fn end(&mut self, _end: &End) {}
    /// A particle was left where it was because its steps ran out.
    fn stalled(&mut self) {}
    /// A particle is, for the first time, where nothing is known of the fluid: outside a table.
    fn strayed(&mut self) {}
}
