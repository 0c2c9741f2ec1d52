//! The short paths: the paper's two laws, EA and EAP, with friction on a smooth wall, and two given restitutions. They do what every other law does, operation by
//! operation (the same bits: `tests/fixed_bits.rs`), in code small enough to stay in registers.

use super::impact::{Laws, Motion, Slid};
use super::{Kernel, Tables};
use crate::impact::{Impact, ImpactError, Outcome};
use crate::instructions::{Work, run_fused, run_scalar};
use crate::math::{self, Fma, Plain};
use crate::normal::adhesion;
use crate::normal::damping::HertzDamping;
use crate::normal::empirical::Lookup;
use crate::normal::plastic::Kadomtsev;
use crate::normal::{Account, Mechanism, NormalLaw, NormalResponse, ShortList, Size};
use crate::tangential::{Coulomb, Tangential};
use crate::validity::Validity;

/// One bulk loss, the adhesion work, and friction.
#[derive(Clone, Copy)]
pub(super) struct Short<'a, B> {
    pub bulk: B,
    pub work: &'a adhesion::Work,
    pub friction: Coulomb,
}

impl<B: Mechanism> Short<'_, B> {
    #[inline(always)]
    pub fn balance<F: Fma>(&self, f: F, v: f64, size: &Size) -> Account {
        let mut account = Account::default();
        self.bulk.take(f, v, size, &mut account);
        account.left = 1.0 - account.bulk;
        self.work.take(f, v, size, &mut account);
        account
    }
}

impl<B: Mechanism> Laws for Short<'_, B> {
    #[inline(always)]
    fn respond<F: Fma>(&self, f: F, v_n: f64, _: f64, size: &Size) -> NormalResponse {
        NormalResponse::of_account(&self.balance(f, v_n, size))
    }

    #[inline(always)]
    fn judge(&self, kernel: &Kernel, v_n: f64, size: &Size, response: &NormalResponse) -> Validity {
        let is_damped = self.bulk.is_damping() || self.work.is_damping();
        kernel.judge_ledger(self.bulk.yield_squared(size), is_damped, v_n, size, response)
    }

    #[inline(always)]
    fn slide<F: Fma>(&self, f: F, motion: &Motion, response: &NormalResponse) -> Result<Slid, ImpactError> {
        Ok(motion.rub(f, &self.friction, response))
    }
}

/// A law that has code of its own.
pub(super) enum ShortLaw<'a> {
    Elastic(Short<'a, HertzDamping>),
    ElasticPlastic(Short<'a, Kadomtsev>),
    Given(Given),
}

impl Kernel {
    /// The law, if it is a short one.
    #[inline(always)]
    pub(super) fn short(&self) -> Option<ShortLaw<'_>> {
        match (&self.scatter, &self.tangential, &self.normal) {
            (None, Tangential::Friction { friction, beta }, NormalLaw::Ledger(ledger)) => {
                let friction = Coulomb { friction: *friction, beta: *beta };
                match ledger.short()? {
                    ShortList::Elastic(bulk, work) => Some(ShortLaw::Elastic(Short { bulk, work, friction })),
                    ShortList::ElasticPlastic(bulk, work) => {
                        Some(ShortLaw::ElasticPlastic(Short { bulk: *bulk, work, friction }))
                    }
                }
            }
            (None, Tangential::Restitution(Lookup::Constant(along)), NormalLaw::Table(Lookup::Constant(across))) => {
                Some(ShortLaw::Given(Given { across: *across, along: *along }))
            }
            _ => None,
        }
    }

    /// One impact, by the short path if there is one: the answer is built where the caller wants it, in each arm.
    #[inline(never)]
    pub(crate) fn scalar_impact(&self, tables: &Tables, impact: &Impact) -> Result<Outcome, ImpactError> {
        match self.short() {
            Some(ShortLaw::Elastic(law)) => self.one_impact(&law, tables, impact),
            Some(ShortLaw::ElasticPlastic(law)) => self.one_impact(&law, tables, impact),
            Some(ShortLaw::Given(law)) => self.one_impact(&law, tables, impact),
            None => self.any_impact(tables, impact),
        }
    }

    #[inline(always)]
    fn one_impact<L: Laws>(&self, law: &L, tables: &Tables, impact: &Impact) -> Result<Outcome, ImpactError> {
        run_fused(OneImpact { kernel: self, law, impact }, |_| self.plain_impact(tables, impact))
    }

    /// One impact by any law: compiled here, not in each crate that asks.
    #[inline(never)]
    fn any_impact(&self, tables: &Tables, impact: &Impact) -> Result<Outcome, ImpactError> {
        if self.scatter.is_none() {
            run_scalar(AnyImpact::<false> { kernel: self, tables, impact })
        } else {
            run_scalar(AnyImpact::<true> { kernel: self, tables, impact })
        }
    }

    /// An impact by a short law without a fused multiply-add: likewise.
    #[inline(never)]
    fn plain_impact(&self, tables: &Tables, impact: &Impact) -> Result<Outcome, ImpactError> {
        match self.short() {
            Some(ShortLaw::Elastic(law)) => self.impact_by(Plain, &law, impact),
            Some(ShortLaw::ElasticPlastic(law)) => self.impact_by(Plain, &law, impact),
            Some(ShortLaw::Given(law)) => self.impact_by(Plain, &law, impact),
            None => self.any_impact(tables, impact),
        }
    }
}

/// Two restitutions given outright, the same at every angle.
pub(super) struct Given {
    across: f64,
    along: f64,
}

impl Laws for Given {
    #[inline(always)]
    fn respond<F: Fma>(&self, _: F, _: f64, _: f64, _: &Size) -> NormalResponse {
        NormalResponse::of_restitution(self.across)
    }

    #[inline(always)]
    fn judge(&self, kernel: &Kernel, _: f64, _: &Size, _: &NormalResponse) -> Validity {
        kernel.validity
    }

    #[inline(always)]
    fn slide<F: Fma>(&self, _: F, motion: &Motion, response: &NormalResponse) -> Result<Slid, ImpactError> {
        Ok(motion.restore(self.along, math::sqrt(motion.tangent2), response))
    }
}

struct OneImpact<'a, L> {
    kernel: &'a Kernel,
    law: &'a L,
    impact: &'a Impact,
}

impl<L: Laws> Work for OneImpact<'_, L> {
    type Output = Result<Outcome, ImpactError>;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, f: F) -> Self::Output {
        self.kernel.impact_by(f, self.law, self.impact)
    }
}

/// One impact by any law, on a wall that scatters or not: the many facets of one would crowd the path of the other.
struct AnyImpact<'a, const SCATTERS: bool> {
    kernel: &'a Kernel,
    tables: &'a Tables<'a>,
    impact: &'a Impact,
}

impl<const SCATTERS: bool> Work for AnyImpact<'_, SCATTERS> {
    type Output = Result<Outcome, ImpactError>;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, f: F) -> Self::Output {
        match &self.kernel.scatter {
            Some(scatter) if SCATTERS => self.kernel.rough_impact(f, self.tables, scatter, self.impact),
            _ => self.kernel.smooth_impact(f, self.tables, self.impact),
        }
    }
}
