//! Tables: restitution as a constant, or by angle of incidence.
//!
//! The angle is measured from the surface, (0°, 90°]. Three forms, as in Fluent's `reflect` condition and in Kim & Dunn (2007),
//! §7: a polynomial in the angle in radians, a piecewise-linear table in degrees (constant beyond its ends), and polynomials by
//! piece. Values are clamped to the range a restitution may have; a curve that leaves it is refused when it is read.
//! Grant & Tabakoff's curves (1975, J. Aircraft 12, 471–478, <https://doi.org/10.2514/3.59826>), sand on 2024 aluminium, come as
//! data under the name `grant-tabakoff`.
//!
//! ```
//! use carom::normal::empirical::AngleTable;
//! let table = AngleTable::piecewise_linear(&[10.0, 45.0, 90.0], &[0.9, 0.7, 0.6])?;
//! assert!((table.at(45f64.to_radians()) - 0.7).abs() < 1e-15);
//! assert_eq!(table.at(0.01), 0.9);
//! # Ok::<(), carom::LawError>(())
//! ```

use crate::error::LawError;
use crate::math::{self, BEST, Fma};
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::f64::consts::FRAC_PI_2;

/// Most coefficients of one polynomial.
pub const MAX_COEFFICIENTS: usize = 8;
/// Most points or pieces of one table.
pub const MAX_PIECES: usize = 64;

/// One polynomial on `[from, to]` (rad), in powers of (angle − origin), lowest first: plain numbers, for the kernel's tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    from: f64,
    to: f64,
    origin: f64,
    coefficients: [f64; MAX_COEFFICIENTS],
}

impl Piece {
    fn new(from: f64, to: f64, origin: f64, given: &[f64]) -> Result<Self, LawError> {
        if given.is_empty() || given.len() > MAX_COEFFICIENTS {
            return Err(LawError::new(format!("a polynomial with {} coefficients", given.len()))
                .help(format!("1 to {MAX_COEFFICIENTS} are read, lowest power first")));
        }
        let mut coefficients = [0.0; MAX_COEFFICIENTS];
        for (slot, &c) in coefficients.iter_mut().zip(given) {
            if !c.is_finite() {
                return Err(LawError::new(format!("coefficient {c} is not finite")));
            }
            *slot = c;
        }
        Ok(Self { from, to, origin, coefficients })
    }

    #[inline(always)]
    fn at<F: Fma>(&self, f: F, angle: f64) -> f64 {
        let x = angle.max(self.from).min(self.to) - self.origin;
        self.coefficients.iter().rev().fold(0.0, |sum, &c| f.fma(sum, x, c))
    }
}

/// A table as it was given. It is kept beside the pieces made of it, since no other form would read back to the same bits.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// One polynomial in the angle (rad), lowest power first.
    Polynomial(Vec<f64>),
    /// Straight lines through (angle in degrees, value).
    Linear(Vec<f64>, Vec<f64>),
    /// Polynomials in the angle (rad) by piece, (from, to) in degrees.
    Pieces(Vec<(f64, f64, Vec<f64>)>),
}

/// A value by angle of incidence.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleTable {
    pieces: Box<[Piece]>,
    form: Form,
}

impl AngleTable {
    /// One polynomial in the angle (rad), lowest power first.
    ///
    /// # Errors
    /// No, too many or non-finite coefficients.
    pub fn polynomial(coefficients: &[f64]) -> Result<Self, LawError> {
        let pieces = Box::new([Piece::new(0.0, FRAC_PI_2, 0.0, coefficients)?]);
        Ok(Self { pieces, form: Form::Polynomial(coefficients.to_vec()) })
    }

    /// Straight lines through (angle in degrees, value), constant beyond the ends.
    ///
    /// # Errors
    /// Lengths that differ, angles outside [0°, 90°] or not rising.
    pub fn piecewise_linear(degrees: &[f64], values: &[f64]) -> Result<Self, LawError> {
        if degrees.len() != values.len() || degrees.len() < 2 || degrees.len() > MAX_PIECES {
            return Err(LawError::new(format!("{} angles and {} values", degrees.len(), values.len()))
                .help(format!("give as many values as angles, 2 to {MAX_PIECES}")));
        }
        let mut pieces = Vec::with_capacity(degrees.len() - 1);
        for (d, v) in degrees.windows(2).zip(values.windows(2)) {
            check_interval(d[0], d[1])?;
            let (from, to) = (d[0].to_radians(), d[1].to_radians());
            pieces.push(Piece::new(from, to, from, &[v[0], (v[1] - v[0]) / (to - from)])?);
        }
        Ok(Self { pieces: pieces.into(), form: Form::Linear(degrees.to_vec(), values.to_vec()) })
    }

    /// Polynomials in the angle (rad) by piece, (from, to) in degrees; the pieces join without gaps.
    ///
    /// # Errors
    /// Pieces that leave a gap or overlap, or as in the other forms.
    pub fn piecewise_polynomial(given: &[(f64, f64, Vec<f64>)]) -> Result<Self, LawError> {
        if given.is_empty() || given.len() > MAX_PIECES {
            return Err(LawError::new(format!("{} pieces", given.len())).help(format!("1 to {MAX_PIECES} are read")));
        }
        let mut pieces: Vec<Piece> = Vec::with_capacity(given.len());
        for (i, (from, to, coefficients)) in given.iter().enumerate() {
            check_interval(*from, *to)?;
            if i > 0 && given[i - 1].1 != *from {
                return Err(LawError::new(format!(
                    "a piece ends at {}° and the next begins at {from}°",
                    given[i - 1].1
                ))
                .help("pieces join, in rising order"));
            }
            pieces.push(Piece::new(from.to_radians(), to.to_radians(), 0.0, coefficients)?);
        }
        Ok(Self { pieces: pieces.into(), form: Form::Pieces(given.to_vec()) })
    }

    /// As it was given: made of that again, it has the same bits.
    pub fn form(&self) -> &Form {
        &self.form
    }

    /// Value at an angle from the surface (rad), [0, π/2].
    pub fn at(&self, angle: f64) -> f64 {
        value_at(BEST, &self.pieces, angle)
    }

    /// Refuses a curve that leaves [low, high] somewhere in (0°, 90°].
    ///
    /// # Errors
    /// The angle and the value there.
    pub fn check_range(&self, low: f64, high: f64) -> Result<(), LawError> {
        let steps = 3600;
        for i in 1..=steps {
            let angle = FRAC_PI_2 * f64::from(i) / f64::from(steps);
            let value = self.at(angle);
            if !(value >= low - 1e-12 && value <= high + 1e-12) {
                return Err(LawError::new(format!("the curve gives {value:.4} at {:.2} deg", angle.to_degrees()))
                    .help(format!("it must stay between {low} and {high}")));
            }
        }
        Ok(())
    }
}

/// Value of a curve at an angle from the surface (rad), [0, π/2].
#[inline(always)]
fn value_at<F: Fma>(f: F, pieces: &[Piece], angle: f64) -> f64 {
    debug_assert!(!pieces.is_empty(), "a curve has at least one piece");
    let chosen = pieces.iter().position(|p| angle <= p.to).unwrap_or(pieces.len().saturating_sub(1));
    pieces.get(chosen).map_or(0.0, |p| p.at(f, angle))
}

fn check_interval(from: f64, to: f64) -> Result<(), LawError> {
    if from >= 0.0 && to <= 90.0 && from < to {
        Ok(())
    } else {
        Err(LawError::new(format!("angles {from} deg to {to} deg"))
            .help("angles rise from 0 to 90 deg, measured from the surface"))
    }
}

/// A constant, or a value by angle.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// The same at every angle.
    Constant(f64),
    /// By angle of incidence.
    ByAngle(AngleTable),
}

impl Curve {
    /// As plain numbers; its pieces, if any, go to the end of `tables`.
    pub(crate) fn look_up_in(&self, tables: &mut Vec<Piece>) -> Lookup {
        match self {
            Self::Constant(value) => Lookup::Constant(*value),
            Self::ByAngle(table) => {
                let first = tables.len() as u32;
                tables.extend_from_slice(&table.pieces);
                Lookup::ByAngle { first, count: table.pieces.len() as u32 }
            }
        }
    }
}

/// A compiled curve: a constant, or where its pieces stand in the kernel's tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lookup {
    /// The same at every angle.
    Constant(f64),
    /// By angle of incidence.
    ByAngle {
        /// Index of the first piece.
        first: u32,
        /// How many pieces.
        count: u32,
    },
}

impl Lookup {
    /// Value for the given normal and tangential approach speeds, clamped to [low, high].
    #[inline(always)]
    pub(crate) fn at<F: Fma>(&self, f: F, pieces: &[Piece], normal: f64, tangential: f64, low: f64, high: f64) -> f64 {
        match *self {
            Self::Constant(value) => value,
            Self::ByAngle { first, count } => {
                let own = pieces.get(first as usize..first as usize + count as usize).unwrap_or(&[]);
                value_at(f, own, math::angle_on(f, tangential, normal)).max(low).min(high)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grant_tabakoff_normal() {
        let t = AngleTable::polynomial(&[0.993, -1.76, 1.56, -0.49]).expect("fine");
        let b = 30f64.to_radians();
        assert!((t.at(b) - (0.993 - 1.76 * b + 1.56 * b * b - 0.49 * b * b * b)).abs() < 1e-15);
        t.check_range(0.0, 1.0).expect("within 0..1");
    }

    #[test]
    fn pieces_join_and_ends_hold() {
        let t =
            AngleTable::piecewise_polynomial(&[(0.0, 30.0, vec![0.5, 0.1]), (30.0, 90.0, vec![0.6])]).expect("fine");
        assert!((t.at(0.1) - 0.51).abs() < 1e-15);
        assert_eq!(t.at(1.0), 0.6);
        assert!(AngleTable::piecewise_polynomial(&[(0.0, 30.0, vec![0.5]), (40.0, 90.0, vec![0.6])]).is_err());
        assert!(AngleTable::piecewise_linear(&[0.0, 95.0], &[0.1, 0.2]).is_err());
        assert!(AngleTable::piecewise_linear(&[0.0, 50.0], &[0.1]).is_err());
        assert!(AngleTable::polynomial(&[]).is_err());
    }

    #[test]
    fn a_curve_above_one_is_refused() {
        let t = AngleTable::polynomial(&[0.9, 0.2]).expect("fine");
        assert!(t.check_range(0.0, 1.0).is_err_and(|e| e.to_string().contains("deg")));
    }
}
