//! How fast a flow can be within a box along the axes: a bound that holds everywhere in it.

use super::Flow;
use crate::vector::{Vec3, norm, sub};

/// Room for the rounding of a velocity, relative.
const ROUNDING: f64 = 1.0 + 1e-9;

/// Reichardt's profile has a slope of 1/(1 + κδ⁺) u_τ/κδ left in the middle, so its maximum lies beside it, higher by less than 1e-4.
const PROFILE: f64 = 1.001;

impl Flow {
    /// An upper bound of the fluid's speed in a box by its lower and upper corner, m/s.
    pub(crate) fn fastest(&self, [low, high]: [Vec3; 2]) -> f64 {
        let bound = match self {
            Self::Still => 0.0,
            Self::Uniform { velocity } => norm(*velocity),
            // the speed falls from the middle to the walls
            Self::Channel(f) => PROFILE * norm(f.velocity([0.0, f.middle().clamp(low[1], high[1]), 0.0])),
            Self::Pipe(f) => {
                let middle = [0, 1, 2].map(|c| 0.5 * (low[c] + high[c]));
                PROFILE * f.speed_at((f.distance_from_axis(middle) - 0.5 * norm(sub(high, low))).max(0.0))
            }
            // linear in the place: greatest at a corner
            Self::Stagnation(f) => corners([low, high]).map(|x| norm(f.velocity(x))).fold(0.0, f64::max),
            Self::SlotJet(f) => f.speed(),
            Self::RoundJet(f) => f.speed(),
            Self::Table(f) => f.fastest([low, high]),
            Self::Cells(f) => f.fastest([low, high]),
        };
        bound * ROUNDING
    }
}

fn corners([low, high]: [Vec3; 2]) -> impl Iterator<Item = Vec3> {
    (0..8).map(move |i| [0, 1, 2].map(|c| if i >> c & 1 == 0 { low[c] } else { high[c] }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::{Channel, Fluid, Pipe, Profile, RoundJet, SlotJet, Stagnation, Symmetry, Table};
    use crate::random::{Purpose, Stream};
    use crate::vector::scale;

    #[test]
    fn nothing_in_the_box_is_faster() {
        const SEED: u64 = 11;
        let air = Fluid::default();
        let table = "x,y,u,v\n0,0,0,1\n1e-3,0,3,0\n4e-3,0,-7,2\n0,2e-3,4,1\n1e-3,2e-3,1,1\n4e-3,2e-3,0,9\n";
        let flows = [
            Flow::Still,
            Flow::Uniform { velocity: [1.0, -2.0, 3.0] },
            Flow::Channel(Channel::new(Profile::Turbulent, 2e-3, 20.0, &air).unwrap()),
            Flow::Channel(Channel::new(Profile::Laminar, 3e-3, -2.0, &air).unwrap()),
            Flow::Pipe(Pipe::new(Profile::Laminar, [1e-3; 3], [1.0, 2.0, -1.0], 2e-3, 2.0, &air).unwrap()),
            Flow::Stagnation(Stagnation::new(Symmetry::Axisymmetric, [1e-3; 3], [0.0, 1.0, 1.0], 300.0).unwrap()),
            Flow::SlotJet(SlotJet::new(1e-3, 30.0).unwrap()),
            Flow::RoundJet(RoundJet::new(1e-3, 30.0).unwrap()),
            Flow::Table(Table::from_csv(table.as_bytes()).unwrap()),
        ];
        for (n, flow) in flows.iter().enumerate() {
            let mut draws = Stream::new(SEED, n as u64, Purpose::Injection, 0);
            for _ in 0..200 {
                let [a, b]: [Vec3; 2] = [draws.uniforms(), draws.uniforms()].map(|x| scale(x, 5e-3));
                let (low, high) = ([0, 1, 2].map(|c| a[c].min(b[c])), [0, 1, 2].map(|c| a[c].max(b[c])));
                let bound = flow.fastest([low, high]);
                for _ in 0..20 {
                    let share: Vec3 = draws.uniforms();
                    let x = [0, 1, 2].map(|c| low[c] + share[c] * (high[c] - low[c]));
                    assert!(norm(flow.velocity(x)) <= bound, "seed {SEED}: flow {n} at {x:?}");
                }
            }
        }
    }
}
