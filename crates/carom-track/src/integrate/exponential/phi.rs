//! Moments of the exponential kernel, gₘ = ∫₀ᶜ e^{−z(c − s)} sᵐ ds = m! cᵐ⁺¹ φₘ₊₁(−cz), for z ≥ 0.
//!
//! φ₁(y) = (eʸ − 1)/y, φₖ₊₁(y) = (φₖ(y) − 1/k!)/y. With y = −cz: from y = −2 on (and to −∞) that recurrence, each step of which divides
//! errors by 2 at least; before it φ₆ by its series, Σ yⁿ/(n + 6)!, and the recurrence downwards.

use crate::integrate::Lanes;
use carom::math::exp;

/// g₀ to g₅.
pub type Moments<const W: usize> = [Lanes<W>; 6];

/// cz from which the recurrence goes up.
const FAR: f64 = 2.0;
/// Terms of the series: the next is below 2⁻⁵³ of the sum there.
const TERMS: usize = 21;

/// 1/(n + 6)!
const SERIES: [f64; TERMS] = {
    let mut out = [1.0 / 720.0; TERMS];
    let mut n = 1;
    while n < TERMS {
        out[n] = out[n - 1] / (n + 6) as f64;
        n += 1;
    }
    out
};

/// 1/k!
const INVERSE: [f64; 6] = [1.0, 1.0, 0.5, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0];
const FACTORIALS: [f64; 6] = [1.0, 1.0, 2.0, 6.0, 24.0, 120.0];

/// The moments up to `c` for `z` of each lane.
#[inline(always)]
pub fn moments<const W: usize>(c: f64, z: &Lanes<W>, out: &mut Moments<W>) {
    let (mut near, mut far) = (false, false);
    for l in 0..W {
        // what is not a number stays none by the recurrence
        let is_near = c * z[l] < FAR;
        near |= is_near;
        far |= !is_near;
    }
    let mut power = c;
    let (mut up, mut down) = ([[0.0; W]; 6], [[0.0; W]; 6]);
    if far {
        upwards(c, z, &mut up);
    }
    if near {
        downwards(c, z, &mut down);
    }
    for m in 0..6 {
        for l in 0..W {
            let phi = if c * z[l] < FAR { down[m][l] } else { up[m][l] };
            out[m][l] = FACTORIALS[m] * power * phi;
        }
        power *= c;
    }
}

#[inline(always)]
fn upwards<const W: usize>(c: f64, z: &Lanes<W>, phi: &mut Moments<W>) {
    for l in 0..W {
        let y = c * z[l];
        // where another lane wants it only
        let y = if y < FAR { FAR } else { y };
        phi[0][l] = (1.0 - exp(-y)) / y;
        for k in 1..6 {
            phi[k][l] = (INVERSE[k] - phi[k - 1][l]) / y;
        }
    }
}

#[inline(always)]
fn downwards<const W: usize>(c: f64, z: &Lanes<W>, phi: &mut Moments<W>) {
    for l in 0..W {
        let y = c * z[l];
        let y = if y < FAR { y } else { FAR };
        let mut sum = SERIES[TERMS - 1];
        for term in SERIES[..TERMS - 1].iter().rev() {
            sum = sum.mul_add(-y, *term);
        }
        phi[5][l] = sum;
        for k in (1..6).rev() {
            phi[k - 1][l] = phi[k][l].mul_add(-y, INVERSE[k]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_right_from_no_drag_to_any() {
        // by an independent program with 60 digits: g₀ … g₅ for c = ¾
        for (z, want) in REFERENCE {
            let mut got = [[0.0]; 6];
            moments(0.75, &[z], &mut got);
            for (m, want) in want.iter().enumerate() {
                assert!((got[m][0] / want - 1.0).abs() < 2e-13, "g{m} at {z:e}: {:e} {want:e}", got[m][0]);
            }
        }
    }

    #[test]
    fn lanes_do_not_mix() {
        let z = [0.0, 1e-9, 0.3, 2.6, 2.7, 40.0, 1e9, 1e30];
        let mut all = [[0.0; 8]; 6];
        moments(0.75, &z, &mut all);
        for l in 0..8 {
            let mut one = [[0.0]; 6];
            moments(0.75, &[z[l]], &mut one);
            for m in 0..6 {
                assert_eq!(one[m][0].to_bits(), all[m][l].to_bits(), "g{m} at {}", z[l]);
            }
        }
    }

    const REFERENCE: [(f64, [f64; 6]); 9] = [
        (0.0, [0.75, 0.28125, 0.140625, 0.0791015625, 0.0474609375, 0.0296630859375]),
        (
            1e-9,
            [
                0.74999999971875,
                0.2812499999296875,
                0.1406249999736328,
                0.07910156248813477,
                0.047460937494067386,
                0.029663085934321813,
            ],
        ),
        (
            1e-3,
            [
                0.7497188202993184,
                0.28117970068161646,
                0.14059863676708378,
                0.0790896987486204,
                0.04745500551839047,
                0.02965990804765126,
            ],
        ),
        (
            0.4,
            [
                0.6479544482957054,
                0.25511387926073664,
                0.13068060369631668,
                0.07458297227762486,
                0.045185902223751406,
                0.028437940953107428,
            ],
        ),
        (
            2.6,
            [
                0.3298945878513409,
                0.16157900467256117,
                0.09205461179033755,
                0.05604275562653359,
                0.035475087497640626,
                0.02304971154299879,
            ],
        ),
        (
            2.7,
            [
                0.3214837617822851,
                0.15870971785841292,
                0.09077057936413857,
                0.055393800706512696,
                0.03512261006442564,
                0.02284875451032289,
            ],
        ),
        (
            7.0,
            [
                0.14210749737154552,
                0.08684178608977922,
                0.0555452039743488,
                0.036462769725279086,
                0.024365024442697666,
                0.016497080755215953,
            ],
        ),
        (100.0, [0.01, 0.0074, 0.005477, 0.00405444, 0.0030018849, 0.00222295263]),
        (1e9, [1e-09, 7.49999999e-10, 5.624999985e-10, 4.218749983125e-10, 3.164062483125e-10, 2.373046859179688e-10]),
    ];
}
