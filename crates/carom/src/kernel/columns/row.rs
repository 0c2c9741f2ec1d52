//! One row of a batch: its motion, friction in its plane, and how it is written.

use super::{Out, Rows};
use crate::kernel::impact::Rubbed;
use crate::kernel::judge;
use crate::math::Fma;
use crate::normal::{Losses, NormalResponse};
use crate::tangential::FrictionLaw;

/// What a row brings.
#[derive(Clone, Copy)]
pub(super) struct Row {
    pub v_n: f64,
    pub v_t: f64,
    pub spin: f64,
    pub diameter: f64,
}

/// How a row leaves, if it does.
pub(super) struct Leaving {
    pub e: f64,
    pub v_t: f64,
    pub spin: f64,
    pub ratio: f64,
}

impl Row {
    #[inline(always)]
    pub fn at(rows: &Rows, i: usize) -> Self {
        Self { v_n: rows.normal[i], v_t: rows.tangential[i], spin: rows.spin[i], diameter: rows.diameter[i] }
    }

    /// Friction, and the rebound.
    #[inline(always)]
    pub fn rub<F: Fma, L: FrictionLaw, const MORE: bool>(
        &self,
        f: F,
        law: &L,
        e: f64,
        friction_share: f64,
        out: &mut Out,
        i: usize,
    ) -> bool {
        let radius = 0.5 * self.diameter;
        let normal_impulse = (1.0 + e) * self.v_n;
        let slip = f.fma(-radius, self.spin, self.v_t);
        let response = NormalResponse { e, losses: Losses::default(), friction_share };
        let rubbed = Rubbed::new(f, law, slip.abs(), normal_impulse, &response);
        let direction = if slip < 0.0 { -1.0 } else { 1.0 };
        let rebound = Leaving {
            e,
            v_t: self.v_t - direction * rubbed.impulse,
            spin: rubbed.spin(radius) * direction + self.spin,
            ratio: rubbed.impulse / normal_impulse,
        };
        self.write::<_, MORE>(f, true, &rebound, out, i)
    }

    /// Writes the row: the rebound, zeros for a capture, NaN for a row that is no impact or was not answered.
    #[inline(always)]
    pub fn write<F: Fma, const MORE: bool>(
        &self,
        f: F,
        answered: bool,
        leaving: &Leaving,
        out: &mut Out,
        i: usize,
    ) -> bool {
        let fine = judge::row_is_fine(f, self.v_n, self.v_t, self.spin, self.diameter) & answered;
        let rebounds = leaving.e > 0.0;
        let pick = |value: f64, captured: f64| {
            let settled = if rebounds { value } else { captured };
            if fine { settled } else { f64::NAN }
        };
        out.normal[i] = pick(leaving.e * self.v_n, 0.0);
        out.tangential[i] = pick(leaving.v_t, 0.0);
        out.spin[i] = pick(leaving.spin, 0.0);
        if MORE && let Some((e, ratio)) = &mut out.more {
            e[i] = pick(leaving.e, 0.0);
            ratio[i] = pick(leaving.ratio, f64::NAN);
        }
        fine
    }
}
