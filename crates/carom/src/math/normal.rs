//! The standard normal distribution, with fixed bits.

use super::{BEST, Fma, exp_on, ln_on, sqrt};
use core::f64::consts::{FRAC_1_SQRT_2, PI};

/// Density e^{−x²/2}/√(2π).
#[inline(always)]
pub fn normal_density(x: f64) -> f64 {
    normal_density_on(BEST, x)
}

/// As [`normal_density`].
#[inline(always)]
pub fn normal_density_on<F: Fma>(f: F, x: f64) -> f64 {
    exp_on(f, -0.5 * x * x) / sqrt(2.0 * PI)
}

/// Probability that a standard normal deviate is at most `x`; the lower tail keeps its digits.
///
/// ```
/// use carom::math::normal::normal_probability;
/// assert!((normal_probability(1.959963984540054) - 0.975).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn normal_probability(x: f64) -> f64 {
    0.5 * libm::erfc(-x * FRAC_1_SQRT_2)
}

/// The standard normal quantile of `p` in (0, 1), to about 1e-16 relative: algorithm AS 241, PPND16
/// (Wichura 1988, Appl. Statist. 37, 477–484, doi:10.2307/2347330).
///
/// ```
/// let z = carom::math::normal::normal_quantile(0.975);
/// assert!((z - 1.959963984540054).abs() < 1e-14);
/// ```
#[inline]
pub fn normal_quantile(p: f64) -> f64 {
    normal_quantile_on(BEST, p)
}

/// As [`normal_quantile`].
#[inline]
pub fn normal_quantile_on<F: Fma>(f: F, p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return q * ratio(r, &CENTRE);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    let r = sqrt(-ln_on(f, tail));
    let z = if r <= 5.0 { ratio(r - 1.6, &MIDDLE) } else { ratio(r - 5.0, &FAR) };
    if q < 0.0 { -z } else { z }
}

#[inline(always)]
fn ratio(r: f64, c: &[[f64; 8]; 2]) -> f64 {
    let horner = |c: &[f64; 8]| c.iter().rev().fold(0.0, |sum, a| sum * r + a);
    horner(&c[0]) / horner(&c[1])
}

// numerator and denominator, from the constant term up, with the digits published
#[allow(clippy::excessive_precision)]
#[rustfmt::skip]
const CENTRE: [[f64; 8]; 2] = [
    [3.387_132_872_796_366_608, 1.331_416_678_917_843_774_5e2, 1.971_590_950_306_551_442_7e3, 1.373_169_376_550_946_112_5e4,
     4.592_195_393_154_987_145_7e4, 6.726_577_092_700_870_085_3e4, 3.343_057_558_358_812_810_5e4, 2.509_080_928_730_122_672_7e3],
    [1.0, 4.231_333_070_160_091_125_2e1, 6.871_870_074_920_579_083e2, 5.394_196_021_424_751_107_7e3,
     2.121_379_430_158_659_586_7e4, 3.930_789_580_009_271_061e4, 2.872_908_573_572_194_267_4e4, 5.226_495_278_852_854_561e3],
];
#[allow(clippy::excessive_precision)]
#[rustfmt::skip]
const MIDDLE: [[f64; 8]; 2] = [
    [1.423_437_110_749_683_577_34, 4.630_337_846_156_545_295_9, 5.769_497_221_460_691_405_5, 3.647_848_324_763_204_605_04,
     1.270_458_252_452_368_382_58, 2.417_807_251_774_506_117_7e-1, 2.272_384_498_926_918_458_33e-2, 7.745_450_142_783_414_076_4e-4],
    [1.0, 2.053_191_626_637_758_821_87, 1.676_384_830_183_803_849_4, 6.897_673_349_851_000_045_5e-1,
     1.481_039_764_274_800_745_9e-1, 1.519_866_656_361_645_719_66e-2, 5.475_938_084_995_344_946e-4, 1.050_750_071_644_416_843_24e-9],
];
#[allow(clippy::excessive_precision)]
#[rustfmt::skip]
const FAR: [[f64; 8]; 2] = [
    [6.657_904_643_501_103_777_2, 5.463_784_911_164_114_369_9, 1.784_826_539_917_291_335_8, 2.965_605_718_285_048_912_3e-1,
     2.653_218_952_657_612_309_3e-2, 1.242_660_947_388_078_438_6e-3, 2.711_555_568_743_487_578_15e-5, 2.010_334_399_292_288_132_65e-7],
    [1.0, 5.998_322_065_558_879_376_9e-1, 1.369_298_809_227_358_053_1e-1, 1.487_536_129_085_061_485_25e-2,
     7.868_691_311_456_132_591e-4, 1.846_318_317_510_054_681_8e-5, 1.421_511_758_316_445_888_7e-7, 2.044_263_103_389_939_785_64e-15],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_quantiles_of_as241() {
        // the test values the algorithm was published with
        for (p, z) in
            [(0.25, -0.674_489_750_196_081_7), (1e-3, -3.090_232_306_167_814), (1e-20, -9.262_340_089_798_408)]
        {
            let got = normal_quantile(p);
            assert!((got / z - 1.0f64).abs() < 1e-14, "{p} {got}");
        }
        assert_eq!(normal_quantile(0.5), 0.0);
        assert_eq!(normal_quantile(0.75), -normal_quantile(0.25));
    }

    #[test]
    fn probability_and_quantile_are_inverse() {
        for i in 1..2000 {
            let p = f64::from(i) / 2000.0;
            assert!((normal_probability(normal_quantile(p)) - p).abs() < 4e-16, "{p}");
        }
        // Abramowitz & Stegun, table 26.2: Q(5) = 2.86652e-7
        assert!((normal_probability(-5.0) / 2.866_515_718_791_939e-7 - 1.0).abs() < 1e-13);
    }
}
