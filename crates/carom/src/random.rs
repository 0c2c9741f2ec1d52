//! Chance by counting: Philox 4x32-10 (Salmon, Moraes, Dror & Shaw 2011, Parallel random numbers: as easy as 1, 2, 3,
//! SC'11, doi:10.1145/2063384.2063405).
//!
//! A draw is a pure function of (seed, particle, purpose, event, place in the event), so that it does not depend on
//! threads, on the order of work or on where a run was interrupted. The generator passes BigCrush.
//!
//! ```
//! use carom::random::{Purpose, Stream};
//! let mut a = Stream::new(1, 42, Purpose::Wall, 3);
//! let first = a.uniform();
//! assert_eq!(first, Stream::new(1, 42, Purpose::Wall, 3).uniform());
//! assert_ne!(first, a.uniform());
//! ```

pub use crate::math::normal::normal_quantile;

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
        core::array::from_fn(|_| self.uniform())
    }

    /// A standard normal deviate, within ±8.3.
    #[inline]
    pub fn normal(&mut self) -> f64 {
        normal_quantile(self.open_uniform())
    }

    /// `N` independent standard normal deviates.
    #[inline]
    pub fn normals<const N: usize>(&mut self) -> [f64; N] {
        core::array::from_fn(|_| self.normal())
    }

    /// A unit vector, uniform over the sphere.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            // three normals have no preferred direction; all zero is possible in principle only
            let [x, y, z]: [f64; 3] = self.normals();
            let length = crate::math::sqrt(x * x + y * y + z * z);
            if length > 0.0 {
                let scale = 1.0 / length;
                return [x * scale, y * scale, z * scale];
            }
        }
    }
}

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
