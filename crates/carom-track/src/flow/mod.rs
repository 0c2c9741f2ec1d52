//! What the fluid does at a point: velocity for the drag, and gradients and turbulence for what asks for them.
//!
//! Flows are steady functions of position. They have no walls of their own: a point beyond a channel's or a pipe's
//! wall sees the fluid at rest there.

pub mod cells;
mod channel;
mod fastest;
mod fluid;
mod gas;
mod gas_nodes;
mod humid;
mod jet;
mod local_gas;
mod piece;
mod pipe;
mod profile;
mod round_jet;
mod stagnation;
mod table;

pub use cells::Cells;
pub use channel::Channel;
pub use fluid::Fluid;
pub(crate) use gas::mean_free_path;
pub use gas::{Gas, GasState, StateError};
pub use jet::SlotJet;
pub use local_gas::LocalGas;
pub use piece::{Exit, Piece};
pub use pipe::Pipe;
pub use profile::Profile;
pub use round_jet::RoundJet;
pub use stagnation::{Stagnation, Symmetry};
pub use table::{Named, Table, TableError};

use crate::geometry::Path;
use crate::vector::Vec3;

/// All that a force may ask of the fluid at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Local {
    /// Mean velocity, m/s.
    pub velocity: [f64; 3],
    /// Velocity gradient, `gradient[i][j]` = ∂u_i/∂x_j, 1/s.
    pub gradient: [[f64; 3]; 3],
    /// Acceleration of the fluid, Du/Dt = (u·∇)u in a steady flow, m/s².
    pub acceleration: [f64; 3],
    /// Turbulent kinetic energy, m²/s²; 0 where there is no turbulence.
    pub k: f64,
    /// Dissipation rate of turbulent kinetic energy, m²/s³.
    pub epsilon: f64,
    /// Distance to the nearest wall the flow knows of, m; infinite where it knows none.
    pub wall_distance: f64,
    /// Unit normal of that wall, into the fluid; zero where the flow knows none.
    pub wall_normal: [f64; 3],
    /// Friction velocity of that wall, m/s; 0 where the flow knows none.
    pub friction_velocity: f64,
    /// The nearest wall that is met, where a force asks for it.
    pub wall: Option<crate::force::wall_drag::Nearest>,
    /// The gas's state here, where the flow gives one; where it gives none, the run's holds everywhere.
    pub gas: Option<LocalGas>,
}

impl Local {
    /// A fluid that moves with one velocity everywhere, without turbulence or walls.
    pub fn uniform(velocity: [f64; 3]) -> Self {
        Self {
            velocity,
            gradient: [[0.0; 3]; 3],
            acceleration: [0.0; 3],
            k: 0.0,
            epsilon: 0.0,
            wall_distance: f64::INFINITY,
            wall_normal: [0.0; 3],
            friction_velocity: 0.0,
            wall: None,
            gas: None,
        }
    }

    /// Velocity and gradient of a steady flow, Du/Dt = (u·∇)u filled in.
    pub(crate) fn steady(velocity: Vec3, gradient: [Vec3; 3]) -> Self {
        let acceleration = gradient.map(|row| crate::vector::dot(row, velocity));
        Self { gradient, acceleration, ..Self::uniform(velocity) }
    }

    /// Vorticity ∇ × u, 1/s.
    #[inline]
    pub fn vorticity(&self) -> [f64; 3] {
        let g = &self.gradient;
        [g[2][1] - g[1][2], g[0][2] - g[2][0], g[1][0] - g[0][1]]
    }
}

/// A steady flow field.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Flow {
    /// Fluid at rest.
    Still,
    /// One velocity everywhere.
    Uniform {
        /// Velocity, m/s.
        velocity: [f64; 3],
    },
    /// Between two parallel plates.
    Channel(Channel),
    /// In a round pipe.
    Pipe(Pipe),
    /// Potential flow against a plate.
    Stagnation(Stagnation),
    /// A slot jet on a plate.
    SlotJet(SlotJet),
    /// A round jet on a plate.
    RoundJet(RoundJet),
    /// Values on a rectilinear grid.
    Table(Table),
    /// A finished CFD result on a mesh of cells.
    Cells(std::sync::Arc<Cells>),
}

impl Flow {
    /// Fluid velocity at `x`, m/s: what drag needs, and no more.
    #[inline(always)]
    pub fn velocity(&self, x: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Still => [0.0; 3],
            Self::Uniform { velocity } => *velocity,
            Self::Channel(f) => f.velocity(x),
            Self::Pipe(f) => f.velocity(x),
            Self::Stagnation(f) => f.velocity(x),
            Self::SlotJet(f) => f.velocity(x),
            Self::RoundJet(f) => f.velocity(x),
            Self::Table(f) => f.velocity(x),
            Self::Cells(f) => f.velocity(x),
        }
    }

    /// The smooth piece that a point lies in.
    #[inline]
    pub fn piece(&self, x: [f64; 3]) -> Piece {
        match self {
            Self::Still | Self::Uniform { .. } | Self::Stagnation(_) | Self::Cells(_) => Piece::default(),
            Self::Channel(f) => f.piece(x),
            Self::Pipe(f) => f.piece(x),
            Self::SlotJet(f) => f.piece(x),
            Self::RoundJet(f) => f.piece(x),
            Self::Table(f) => f.piece(x),
        }
    }

    /// Whether it is smooth everywhere, and of one scale.
    #[inline(always)]
    pub fn is_one_piece(&self) -> bool {
        match self {
            Self::Still | Self::Uniform { .. } | Self::Stagnation(_) => true,
            Self::Channel(f) => f.is_one_piece(),
            Self::Pipe(f) => f.is_one_piece(),
            Self::SlotJet(_) | Self::RoundJet(_) | Self::Table(_) | Self::Cells(_) => false,
        }
    }

    /// Where a path leaves a piece, and into which.
    #[inline]
    pub fn exit(&self, piece: Piece, path: &Path) -> Option<Exit> {
        match self {
            Self::Still | Self::Uniform { .. } | Self::Stagnation(_) | Self::Cells(_) => None,
            Self::Channel(f) => f.exit(piece, path),
            Self::Pipe(f) => f.exit(piece, path),
            Self::SlotJet(f) => f.exit(piece, path),
            Self::RoundJet(f) => f.exit(piece, path),
            Self::Table(f) => f.exit(piece, path),
        }
    }

    /// Whether a box, by its lower and upper corner, surely lies within a piece, and within what a step may span there.
    #[inline]
    pub(crate) fn holds(&self, piece: Piece, [low, high]: [Vec3; 2]) -> bool {
        let within = |[a, b]: [f64; 2], c: usize| low[c] > a && high[c] < b;
        match self {
            Self::Still | Self::Uniform { .. } | Self::Stagnation(_) => true,
            Self::Channel(f) => within(f.bounds(piece), 1),
            Self::Table(f) => (0..3).all(|c| within(f.edges(piece, c), c)),
            // round: left to the look at the path
            Self::Pipe(_) | Self::SlotJet(_) | Self::RoundJet(_) | Self::Cells(_) => false,
        }
    }

    /// How far a step from `x` may go within a piece, m.
    #[inline(always)]
    pub fn reach(&self, piece: Piece, x: [f64; 3]) -> f64 {
        match self {
            Self::SlotJet(f) => f.reach(piece, x),
            Self::RoundJet(f) => f.reach(x),
            _ => f64::INFINITY,
        }
    }

    /// How soon a straight path from `x` at `v` leaves a piece, s; infinite where that is not known.
    #[inline]
    pub fn soonest(&self, piece: Piece, x: [f64; 3], v: [f64; 3]) -> f64 {
        match self {
            Self::Channel(f) => f.soonest(piece, x, v),
            Self::Pipe(f) => f.soonest(piece, x, v),
            Self::Table(f) => f.soonest(piece, x, v),
            Self::Still
            | Self::Uniform { .. }
            | Self::Stagnation(_)
            | Self::SlotJet(_)
            | Self::RoundJet(_)
            | Self::Cells(_) => f64::INFINITY,
        }
    }

    /// Fluid velocity at `x` by the formula of a piece, m/s.
    #[inline(always)]
    pub fn velocity_in(&self, piece: Piece, x: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Still => [0.0; 3],
            Self::Uniform { velocity } => *velocity,
            Self::Channel(f) => {
                let mut u = [0.0];
                f.velocities(&[piece], &[x[1]], &mut u);
                [u[0], 0.0, 0.0]
            }
            Self::Pipe(f) => f.velocity_in(piece, x),
            Self::Stagnation(f) => f.velocity(x),
            Self::SlotJet(f) => f.velocity_in(piece, x),
            Self::RoundJet(f) => f.velocity_in(piece, x),
            Self::Table(f) => f.velocity_in(piece, x),
            Self::Cells(f) => f.velocity(x),
        }
    }

    /// [`Flow::velocity_in`] at `N` points at once, coordinates as columns; the same bits, in loops that vectorise.
    #[inline(always)]
    pub fn velocities<const N: usize>(&self, pieces: &[Piece; N], x: &[[f64; N]; 3]) -> [[f64; N]; 3] {
        let mut u = [[0.0; N]; 3];
        match self {
            Self::Still => {}
            Self::Uniform { velocity } => u = velocity.map(|c| [c; N]),
            Self::Channel(f) => f.velocities(pieces, &x[1], &mut u[0]),
            _ => {
                for lane in 0..N {
                    let v = self.velocity_in(pieces[lane], [x[0][lane], x[1][lane], x[2][lane]]);
                    for (column, c) in u.iter_mut().zip(v) {
                        column[lane] = c;
                    }
                }
            }
        }
        u
    }

    /// Whether it gives the gas's state, place by place.
    #[inline(always)]
    pub fn varies_gas(&self) -> bool {
        match self {
            Self::Table(f) => f.has_gas(),
            Self::Cells(f) => f.has_gas(),
            _ => false,
        }
    }

    /// Whether it knows the friction velocity of its walls.
    pub fn has_friction_velocity(&self) -> bool {
        match self {
            Self::Channel(f) => f.friction_velocity() > 0.0,
            Self::Pipe(f) => f.friction_velocity() > 0.0,
            Self::Cells(_) => true,
            _ => false,
        }
    }

    /// Everything known of the fluid at `x`.
    pub fn sample(&self, x: [f64; 3]) -> Local {
        self.sample_in(self.piece(x), x)
    }

    /// Everything known of the fluid at `x`, by the formulas of a piece.
    #[inline(always)]
    pub fn sample_in(&self, piece: Piece, x: [f64; 3]) -> Local {
        match self {
            Self::Still => Local::uniform([0.0; 3]),
            Self::Uniform { velocity } => Local::uniform(*velocity),
            Self::Channel(f) => f.sample_in(piece, x),
            Self::Pipe(f) => f.sample_in(piece, x),
            Self::Stagnation(f) => f.sample(x),
            Self::SlotJet(f) => f.sample_in(piece, x),
            Self::RoundJet(f) => f.sample_in(piece, x),
            Self::Table(f) => f.sample_in(piece, x),
            Self::Cells(f) => f.sample(x),
        }
    }
}

/// A flow that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlowError {
    /// A value out of its range.
    #[error("{name} is {value}; it must be {want}")]
    Value {
        /// What the value is for.
        name: &'static str,
        /// The value, SI.
        value: f64,
        /// What would be right.
        want: &'static str,
    },
    /// A direction without length.
    #[error("{name} has no direction: give a finite vector that is not zero")]
    Direction {
        /// What the direction is for.
        name: &'static str,
    },
}

impl FlowError {
    pub(crate) fn value(name: &'static str, value: f64, want: &'static str) -> Self {
        Self::Value { name, value, want }
    }

    pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), Self> {
        if value > 0.0 && value.is_finite() { Ok(()) } else { Err(Self::value(name, value, "positive and finite")) }
    }

    pub(crate) fn finite(name: &'static str, value: f64) -> Result<(), Self> {
        if value.is_finite() { Ok(()) } else { Err(Self::value(name, value, "finite")) }
    }
}
