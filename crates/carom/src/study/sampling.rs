//! Samples, and what they come to.

use crate::WallLaw;
#[cfg(not(feature = "std"))]
use crate::math::Plainly as _;
use crate::math::sqrt;
use crate::random::{Purpose, Stream};
use alloc::borrow::Cow;
use alloc::vec::Vec;

/// How to sample. A sample has the same draws at every point and on every curve (common random numbers): curves are smooth, and
/// differences between them are not noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// How many samples.
    pub samples: u32,
    /// From which seed.
    pub seed: u64,
}

impl Sampling {
    /// The uniform draw in (0, 1) of one quantity, by the number of its stream, in one sample.
    #[must_use]
    pub fn draw(&self, sample: u32, stream: u32) -> f64 {
        Stream::new(self.seed, sample.into(), Purpose::Injection, stream).open_uniform()
    }

    /// The draws of an impact on a wall that scatters, in one sample.
    #[must_use]
    pub fn impact(&self, sample: u32) -> [f64; 4] {
        Stream::new(self.seed, sample.into(), Purpose::Wall, 0).uniforms()
    }

    /// Standard error of a probability, at most: 1/(2√n).
    #[must_use]
    pub fn standard_error(&self) -> f64 {
        0.5 / sqrt(f64::from(self.samples))
    }
}

/// Median and the band from 5 to 95 % of values; those that are NaN do not count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Half lie below.
    pub median: f64,
    /// 5 % lie below.
    pub low: f64,
    /// 95 % lie below.
    pub high: f64,
}

impl Band {
    /// Of these values, which are sorted; NaN where there are none.
    #[must_use]
    pub fn of(values: &mut Vec<f64>) -> Self {
        values.retain(|v| !v.is_nan());
        values.sort_by(f64::total_cmp);
        let at = |p: f64| {
            let Some(last) = values.len().checked_sub(1) else { return f64::NAN };
            let place = p * last as f64;
            let (below, share) = (place as usize, place.fract());
            // infinite ends have no straight line between them
            if share == 0.0 || values[below] == values[below + 1] {
                return values[below];
            }
            values[below] + share * (values[below + 1] - values[below])
        };
        Self { median: at(0.5), low: at(0.05), high: at(0.95) }
    }
}

/// A probability estimated from samples, with its sampling error: Wilson's 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Hits over samples.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Share {
    /// `hits` of `n`.
    #[must_use]
    pub fn of(hits: u32, n: u32) -> Self {
        let (low, high) = wilson(hits.into(), n.into());
        Self { value: f64::from(hits) / f64::from(n), low, high }
    }
}

/// Wilson's 95 % interval of a share, `hits` of `n` (Wilson 1927, J. Am. Stat. Assoc. 22, 209–212,
/// <https://doi.org/10.2307/2276774>). The ends of none and of all are 0 and 1.
///
/// ```
/// let (low, high) = carom::study::wilson(8, 10);
/// assert!((low - 0.4902).abs() < 1e-4 && (high - 0.9433).abs() < 1e-4);
/// assert_eq!(carom::study::wilson(0, 7).0, 0.0);
/// ```
#[must_use]
pub fn wilson(hits: u64, n: u64) -> (f64, f64) {
    const Z: f64 = 1.959_963_984_540_054;
    if n == 0 {
        return (0.0, 1.0);
    }
    let (n, hits) = (n as f64, hits as f64);
    let p = hits / n;
    let z2 = Z * Z / n;
    let centre = p + 0.5 * z2;
    let reach = Z * sqrt(p * (1.0 - p) / n + 0.25 * z2 / n);
    let low = if hits == 0.0 { 0.0 } else { ((centre - reach) / (1.0 + z2)).max(0.0) };
    let high = if hits == n { 1.0 } else { ((centre + reach) / (1.0 + z2)).min(1.0) };
    (low, high)
}

/// What sampled impacts come to, point by point.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled<const N: usize> {
    /// Probability of sticking.
    pub sticking: Vec<Share>,
    /// Bands of the figures asked for.
    pub bands: [Vec<Band>; N],
}

/// Samples impacts at `points` points. `law` gives the law of a sample, `meet` one impact of it, by sample and point: whether the
/// sphere sticks, and the figures of which bands are wanted (NaN for none). The values of all samples are held in memory.
///
/// # Errors
/// The first error of `law` or `meet`.
pub fn sampled<'a, const N: usize, E>(
    sampling: &Sampling,
    points: usize,
    mut law: impl FnMut(u32) -> Result<Cow<'a, WallLaw>, E>,
    mut meet: impl FnMut(&WallLaw, u32, usize) -> Result<(bool, [f64; N]), E>,
) -> Result<Sampled<N>, E> {
    let mut hits = vec![0u32; points];
    let mut values = [(); N].map(|()| vec![Vec::with_capacity(sampling.samples as usize); points]);
    for sample in 0..sampling.samples {
        let law = law(sample)?;
        for (point, hits) in hits.iter_mut().enumerate() {
            let (sticks, figures) = meet(&law, sample, point)?;
            *hits += u32::from(sticks);
            for (figure, values) in figures.into_iter().zip(&mut values) {
                values[point].push(figure);
            }
        }
    }
    let sticking = hits.into_iter().map(|h| Share::of(h, sampling.samples)).collect();
    let bands = values.map(|mut at_points| at_points.iter_mut().map(Band::of).collect());
    Ok(Sampled { sticking, bands })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_quantiles() {
        let mut values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        values.push(f64::NAN);
        assert_eq!(Band::of(&mut values), Band { median: 50.0, low: 5.0, high: 95.0 });
        let of = Band::of(&mut vec![1.0, f64::INFINITY, f64::INFINITY]);
        assert!(of.median == f64::INFINITY && of.high == f64::INFINITY);
        assert!(Band::of(&mut Vec::new()).median.is_nan());
    }

    #[test]
    fn draws_are_those_of_sample_and_stream() {
        let sampling = Sampling { samples: 10, seed: 3 };
        assert_eq!(sampling.draw(4, 0), sampling.draw(4, 0));
        assert_ne!(sampling.draw(4, 0), sampling.draw(4, 1));
        assert_ne!(sampling.draw(4, 0), sampling.draw(5, 0));
    }

    #[test]
    fn intervals_of_none_and_all_end_there() {
        for n in [1, 7, 1000, 2361, 1_000_000] {
            assert_eq!((wilson(0, n).0, wilson(n, n).1), (0.0, 1.0));
            assert!(wilson(0, n).1 > 0.0 && wilson(n, n).0 < 1.0);
        }
        assert_eq!(wilson(0, 0), (0.0, 1.0));
    }

    #[test]
    fn wilsons_interval_is_as_published() {
        // Newcombe 1998, Stat. Med. 17, 857-872, table I, method 3: 81/263 and 0/20
        let (low, high) = wilson(81, 263);
        assert!((low - 0.2553).abs() < 5e-5 && (high - 0.3662).abs() < 5e-5, "{low} {high}");
        let (low, high) = wilson(0, 20);
        assert!(low == 0.0 && (high - 0.1611).abs() < 5e-5, "{high}");
        assert!((1..5000).all(|n| wilson(0, n).0 == 0.0 && wilson(n, n).1 == 1.0));
    }
}
