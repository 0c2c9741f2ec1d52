//! Chance by counting: Philox 4x32-10 (Salmon, Moraes, Dror & Shaw 2011, Parallel random numbers: as easy as 1, 2, 3,
//! SC'11, doi:10.1145/2063384.2063405).
//!
//! A draw is a pure function of (seed, particle, purpose, event, place in the event), so that it does not depend on
//! threads, on the order of work or on where a run was interrupted. The generator passes BigCrush.
//!
//! ```
//! use carom_track::random::{Purpose, Stream};
//! let mut a = Stream::new(1, 42, Purpose::Wall, 3);
//! let first = a.uniform();
//! assert_eq!(first, Stream::new(1, 42, Purpose::Wall, 3).uniform());
//! assert_ne!(first, a.uniform());
//! ```

use carom::math::ln;

/// Ten rounds of Philox on a counter of four words with a key of two.
#[inline]
pub fn philox4x32_10(counter: [u32; 4], key: [u32; 2]) -> [u32; 4] {
    const MULTIPLIERS: [u64; 2] = [0xD251_1F53, 0xCD9E_8D57];
    const WEYL: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];
    let (mut c, mut k) = (counter, key);
    for _ in 0..10 {
        let (p0, p1) = (MULTIPLIERS[0] * u64::from(c[0]), MULTIPLIERS[1] * u64::from(c[2]));
        c = [(p1 >> 32) as u32 ^ c[1] ^ k[0], p1 as u32, (p0 >> 32) as u32 ^ c[3] ^ k[1], p0 as u32];
        k = [k[0].wrapping_add(WEYL[0]), k[1].wrapping_add(WEYL[1])];
    }
    c
}

/// What draws are for: streams of different purposes are independent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum Purpose {
    /// Where and how a particle starts; the event is the injection's number.
    Injection = 0,
    /// A wall hit; the event counts the particle's hits.
    Wall = 1,
    /// A turbulent eddy; the event counts the particle's eddies.
    Eddy = 2,
    /// A Brownian kick; the event counts the particle's steps.
    Brownian = 3,
    /// Resampled data of a fit; the particle is the resample's number.
    Resampling = 4,
}

/// The draws of one event of one particle.
#[derive(Clone, Debug)]
pub struct Stream {
    counter: [u32; 4],
    key: [u32; 2],
    spare: Option<u64>,
}

impl Stream {
    /// Draws keyed by (seed, particle, purpose, event). An event has 2^25 draws.
    #[inline]
    pub fn new(seed: u64, particle: u64, purpose: Purpose, event: u32) -> Self {
        Self {
            counter: [particle as u32, (particle >> 32) as u32, event, (purpose as u32) << 24],
            key: [seed as u32, (seed >> 32) as u32],
            spare: None,
        }
    }

    /// 64 random bits.
    #[inline]
    pub fn bits(&mut self) -> u64 {
        if let Some(bits) = self.spare.take() {
            return bits;
        }
        let w = philox4x32_10(self.counter, self.key).map(u64::from);
        // the block's number stays clear of the purpose in the top byte
        self.counter[3] = (self.counter[3] & 0xFF00_0000) | (self.counter[3].wrapping_add(1) & 0x00FF_FFFF);
        self.spare = Some(w[2] << 32 | w[3]);
        w[0] << 32 | w[1]
    }

    /// Uniform in [0, 1), a multiple of 2^−53.
    #[inline]
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Uniform in the open interval (0, 1), symmetric about ½: odd multiples of 2^−53.
    #[inline]
    pub fn open_uniform(&mut self) -> f64 {
        ((self.bits() >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64)
    }

    /// `N` uniforms in [0, 1).
    #[inline]
    pub fn uniforms<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.uniform())
    }

    /// A standard normal deviate, within ±8.3.
    #[inline]
    pub fn normal(&mut self) -> f64 {
        normal_quantile(self.open_uniform())
    }

    /// `N` independent standard normal deviates.
    #[inline]
    pub fn normals<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.normal())
    }

    /// A unit vector, uniform over the sphere.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            // three normals have no preferred direction; all zero is possible in principle only
            if let Some(n) = crate::vector::unit(self.normals()) {
                return n;
            }
        }
    }
}

/// The standard normal quantile of `p` in (0, 1), to about 1e-16 relative: algorithm AS 241, PPND16
/// (Wichura 1988, Appl. Statist. 37, 477–484, doi:10.2307/2347330).
///
/// ```
/// let z = carom_track::random::normal_quantile(0.975);
/// assert!((z - 1.959963984540054).abs() < 1e-14);
/// ```
pub fn normal_quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return q * ratio(r, &CENTRE);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    let r = (-ln(tail)).sqrt();
    let z = if r <= 5.0 { ratio(r - 1.6, &MIDDLE) } else { ratio(r - 5.0, &FAR) };
    if q < 0.0 { -z } else { z }
}

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
    fn known_answers_of_random123() {
        // kat_vectors of the authors' Random123 distribution, philox 4x32 10 rounds
        let pi = [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344];
        assert_eq!(philox4x32_10([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(philox4x32_10([u32::MAX; 4], [u32::MAX; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        assert_eq!(philox4x32_10(pi, [0xa409_3822, 0x299f_31d0]), [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]);
    }

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
    fn uniforms_and_normals_have_their_moments() {
        let seed = 20_240_601;
        let n = 100_000;
        let (mut mean, mut square, mut normal, mut normal2, mut normal4) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for particle in 0..n {
            let mut s = Stream::new(seed, particle, Purpose::Eddy, 7);
            let u = s.uniform();
            assert!((0.0..1.0).contains(&u));
            mean += u / n as f64;
            square += (u - 0.5) * (u - 0.5) / n as f64;
            let z = s.normal();
            normal += z / n as f64;
            normal2 += z * z / n as f64;
            normal4 += z.powi(4) / n as f64;
        }
        // four standard errors each
        let e = 4.0 / (n as f64).sqrt();
        assert!((mean - 0.5).abs() < e * 0.289, "seed {seed}: {mean}");
        assert!((square - 1.0 / 12.0).abs() < e * 0.075, "seed {seed}: {square}");
        assert!(normal.abs() < e && (normal2 - 1.0).abs() < e * 1.42, "seed {seed}: {normal} {normal2}");
        assert!((normal4 - 3.0).abs() < e * 9.8, "seed {seed}: {normal4}");
    }

    #[test]
    fn streams_differ_in_every_key() {
        let first = |seed, particle, purpose, event| Stream::new(seed, particle, purpose, event).bits();
        let base = first(1, 2, Purpose::Wall, 3);
        assert_ne!(base, first(2, 2, Purpose::Wall, 3));
        assert_ne!(base, first(1 << 32 | 1, 2, Purpose::Wall, 3));
        assert_ne!(base, first(1, 3, Purpose::Wall, 3));
        assert_ne!(base, first(1, 2 | 1 << 32, Purpose::Wall, 3));
        assert_ne!(base, first(1, 2, Purpose::Eddy, 3));
        assert_ne!(base, first(1, 2, Purpose::Wall, 4));
        let mut s = Stream::new(1, 2, Purpose::Wall, 3);
        let draws: std::collections::HashSet<u64> = (0..1000).map(|_| s.bits()).collect();
        assert_eq!(draws.len(), 1000);
    }
}
