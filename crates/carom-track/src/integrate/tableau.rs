//! Dormand & Prince's coefficients, and what they make of accelerations in a position.

pub(super) const STAGES: usize = 7;

/// Dormand–Prince coefficients; the last row is the fifth-order weights.
pub(super) const A: [[f64; 6]; STAGES] = [
    [0.0; 6],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

pub(super) const C: [f64; STAGES] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];

/// Fifth- minus fourth-order weights.
pub(super) const E: [f64; STAGES] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Weights of the quartic term of the spin's interpolant.
pub(super) const D: [f64; STAGES] = [
    -12715105075.0 / 11282082432.0,
    0.0,
    87487479700.0 / 32700410799.0,
    -10690763975.0 / 1880347072.0,
    701980252875.0 / 199316789632.0,
    -1453857185.0 / 822651844.0,
    69997945.0 / 29380423.0,
];

/// Σᵢ wᵢ aᵢⱼ: what a sum over stage velocities weighs the accelerations with.
const fn through(w: &[f64; STAGES]) -> [f64; 6] {
    let mut out = [0.0; 6];
    let mut j = 0;
    while j < 6 {
        let mut i = 0;
        while i < STAGES {
            out[j] += w[i] * A[i][j];
            i += 1;
        }
        j += 1;
    }
    out
}

const fn widen(row: &[f64; 6]) -> [f64; STAGES] {
    [row[0], row[1], row[2], row[3], row[4], row[5], 0.0]
}

/// Weights of the accelerations in each stage's position.
pub(super) const AA: [[f64; 6]; STAGES] = {
    let mut out = [[0.0; 6]; STAGES];
    let mut i = 0;
    while i < STAGES {
        out[i] = through(&widen(&A[i]));
        i += 1;
    }
    out
};

/// Fifth- minus fourth-order weights of the accelerations in the position.
pub(super) const EA: [f64; 6] = through(&E);
