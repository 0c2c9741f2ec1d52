//! The short paths: the paper's two laws, EA and EAP, with friction on a smooth wall. They do what every other law does, operation by
//! operation (the same bits: `tests/fixed_bits.rs`), in code small enough to stay in registers.

use super::Kernel;
use super::impact::{Laws, Motion, Slid};
use crate::impact::{Impact, ImpactError, Outcome};
use crate::instructions::{Work, run_scalar};
use crate::math::Fma;
use crate::normal::adhesion;
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
    fn judge<F: Fma>(&self, f: F, kernel: &Kernel, v_n: f64, size: &Size, response: &NormalResponse) -> Validity {
        let is_damped = self.bulk.is_damping() || self.work.is_damping();
        kernel.judge_ledger(f, self.bulk.yield_squared(size), is_damped, v_n, size, response)
    }

    #[inline(always)]
    fn slide<F: Fma>(&self, f: F, motion: &Motion, response: &NormalResponse) -> Result<Slid, ImpactError> {
        Ok(motion.rub(f, &self.friction, response))
    }
}

/// What is done with a short law whose type is known.
pub(super) trait OnShort {
    type Output;
    fn run<B: Mechanism>(self, law: &Short<B>) -> Self::Output;
}

impl Kernel {
    /// Does `then` with the law if it is a short one, else gives it back.
    #[inline(always)]
    pub(super) fn if_short<T: OnShort>(&self, then: T) -> Result<T::Output, T> {
        let (None, Tangential::Friction { friction, beta }, NormalLaw::Ledger(ledger)) =
            (&self.scatter, &self.tangential, &self.normal)
        else {
            return Err(then);
        };
        let friction = Coulomb { friction: *friction, beta: *beta };
        match ledger.short() {
            Some(ShortList::Elastic(bulk, work)) => Ok(then.run(&Short { bulk, work, friction })),
            Some(ShortList::ElasticPlastic(bulk, work)) => Ok(then.run(&Short { bulk: *bulk, work, friction })),
            None => Err(then),
        }
    }

    /// One impact, if the law is a short one.
    #[inline(always)]
    pub(crate) fn short_impact(&self, impact: &Impact) -> Option<Result<Outcome, ImpactError>> {
        self.if_short(Scalar { kernel: self, impact }).ok()
    }
}

struct Scalar<'a> {
    kernel: &'a Kernel,
    impact: &'a Impact,
}

impl OnShort for Scalar<'_> {
    type Output = Result<Outcome, ImpactError>;

    #[inline(always)]
    fn run<B: Mechanism>(self, law: &Short<B>) -> Self::Output {
        run_scalar(OneImpact { kernel: self.kernel, law, impact: self.impact })
    }
}

struct OneImpact<'a, 'b, B> {
    kernel: &'a Kernel,
    law: &'a Short<'b, B>,
    impact: &'a Impact,
}

impl<B: Mechanism> Work for OneImpact<'_, '_, B> {
    type Output = Result<Outcome, ImpactError>;

    #[inline(always)]
    fn run<F: Fma, const LANES: usize>(self, f: F) -> Self::Output {
        self.kernel.impact_by(f, self.law, self.impact)
    }
}
