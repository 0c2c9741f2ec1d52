//! The energy ledger: a list of losses, and the restitution they leave.
//!
//! e² = 1 − Σ ε_i(v), Kim & Dunn (2007), Eqs 24 and 37, J. Aerosol Sci. 38, 532–549,
//! <https://doi.org/10.1016/j.jaerosci.2007.03.006>. e² ≤ 0 is capture. At most one of the two adhesion works and one of the
//! three plastic losses may stand in a ledger: two of a kind would count the same energy twice.
//!
//! The additive sum is an approximation where losses act on the same contact: adhesion work above yield keeps the elastic
//! contact radius, and damping fitted on elastic contacts beside a plastic loss may count energy twice (`losses-overlap`).

use super::Size;
use super::adhesion::{Jkr, Work};
use super::damping::Damping;
use super::plastic::Kadomtsev;
use super::tabor::Tabor;
use super::thornton_ning::ThorntonNing;

/// One loss mechanism, by its name in a law file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// `adhesion-work`
    AdhesionWork,
    /// `adhesion-damping`
    AdhesionDamping,
    /// `hertz-damping`
    HertzDamping,
    /// `plastic-kadomtsev`
    PlasticKadomtsev,
    /// `plastic-thornton-ning`
    PlasticThorntonNing,
    /// `plastic-tabor`
    PlasticTabor,
    /// `adhesion-jkr`
    AdhesionJkr,
}

impl Loss {
    /// Every loss, in the order of the documentation.
    pub const ALL: [Self; 7] = [
        Self::AdhesionWork,
        Self::AdhesionDamping,
        Self::HertzDamping,
        Self::PlasticKadomtsev,
        Self::PlasticThorntonNing,
        Self::PlasticTabor,
        Self::AdhesionJkr,
    ];

    /// Its name in a law file.
    pub fn name(self) -> &'static str {
        match self {
            Self::AdhesionWork => "adhesion-work",
            Self::AdhesionDamping => "adhesion-damping",
            Self::HertzDamping => "hertz-damping",
            Self::PlasticKadomtsev => "plastic-kadomtsev",
            Self::PlasticThorntonNing => "plastic-thornton-ning",
            Self::PlasticTabor => "plastic-tabor",
            Self::AdhesionJkr => "adhesion-jkr",
        }
    }

    /// What it is an instance of: two losses of a kind cannot share a ledger.
    pub fn kind(self) -> &'static str {
        match self {
            Self::AdhesionWork | Self::AdhesionJkr => "adhesion work",
            Self::PlasticKadomtsev | Self::PlasticThorntonNing | Self::PlasticTabor => "plastic loss",
            Self::AdhesionDamping => "adhesion damping",
            Self::HertzDamping => "Hertzian damping",
        }
    }
}

/// The adhesion work of a ledger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Adhesion {
    /// None.
    None,
    /// Kim and Dunn's.
    Work,
    /// Thornton and Ning's.
    Jkr(Jkr),
}

/// The plastic loss of a ledger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plastic {
    /// None.
    None,
    /// Kadomtsev's.
    Kadomtsev(Kadomtsev),
    /// Thornton and Ning's.
    ThorntonNing(ThorntonNing),
    /// Tabor's.
    Tabor(Tabor),
}

/// Compiled losses. `work` holds the constants of Ψ_A whether the adhesion work itself is in the ledger or only its damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ledger {
    /// Which adhesion work counts.
    pub adhesion: Adhesion,
    /// Constants of Ψ_A.
    pub work: Work,
    /// Damping coefficients.
    pub damping: Damping,
    /// The plastic loss.
    pub plastic: Plastic,
}

/// Fractions ε_i of the normal kinetic energy, each ≥ 0; the sum may exceed 1 (capture).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Losses {
    /// Either adhesion work.
    pub adhesion: f64,
    /// Adhesion damping.
    pub adhesion_damping: f64,
    /// Hertzian damping.
    pub hertz_damping: f64,
    /// Any plastic loss.
    pub plastic: f64,
}

impl Losses {
    /// Σ ε_i, in a fixed order.
    #[inline(always)]
    pub fn total(&self) -> f64 {
        (self.plastic + self.hertz_damping) + (self.adhesion + self.adhesion_damping)
    }

    /// e, 0 when nothing is left.
    #[inline(always)]
    pub fn restitution(&self) -> f64 {
        let e2 = 1.0 - self.total();
        if e2 > 0.0 { e2.sqrt() } else { 0.0 }
    }
}

/// A plastic loss as a type, so that a batch loop holds no branch on its kind.
pub(crate) trait PlasticLoss: Copy {
    fn lost(&self, v: f64, size: &Size) -> f64;
}
#[derive(Clone, Copy)]
pub(crate) struct Elastic;
impl PlasticLoss for Elastic {
    #[inline(always)]
    fn lost(&self, _: f64, _: &Size) -> f64 {
        0.0
    }
}
impl PlasticLoss for Kadomtsev {
    #[inline(always)]
    fn lost(&self, v: f64, size: &Size) -> f64 {
        self.fraction(v, size)
    }
}
impl PlasticLoss for ThorntonNing {
    #[inline(always)]
    fn lost(&self, v: f64, size: &Size) -> f64 {
        self.fraction(v, size)
    }
}

/// The adhesive losses as a type, likewise.
pub(crate) trait AdhesiveLoss: Copy {
    /// (adhesion, adhesion damping).
    fn lost(&self, v: f64, size: &Size) -> (f64, f64);
}
/// Ψ_A (counted or not) with its damping.
#[derive(Clone, Copy)]
pub(crate) struct WorkLoss {
    pub work: Work,
    pub counted: f64,
    pub damping: Damping,
}
impl AdhesiveLoss for WorkLoss {
    #[inline(always)]
    fn lost(&self, v: f64, size: &Size) -> (f64, f64) {
        let psi = self.work.fraction(v, size);
        (self.counted * psi, self.damping.adhesion_fraction(psi, v))
    }
}
#[derive(Clone, Copy)]
pub(crate) struct NoAdhesion;
impl AdhesiveLoss for NoAdhesion {
    #[inline(always)]
    fn lost(&self, _: f64, _: &Size) -> (f64, f64) {
        (0.0, 0.0)
    }
}
#[inline(always)]
pub(crate) fn losses<A: AdhesiveLoss, P: PlasticLoss>(
    adhesive: &A,
    plastic: &P,
    damping: &Damping,
    v: f64,
    size: &Size,
) -> Losses {
    let (adhesion, adhesion_damping) = adhesive.lost(v, size);
    Losses { adhesion, adhesion_damping, hertz_damping: damping.hertz_fraction(v), plastic: plastic.lost(v, size) }
}

impl Ledger {
    /// A ledger with no loss at all: e = 1.
    pub fn lossless() -> Self {
        Self { adhesion: Adhesion::None, work: Work::default(), damping: Damping::default(), plastic: Plastic::None }
    }

    #[inline(always)]
    pub(crate) fn work_loss(&self) -> WorkLoss {
        WorkLoss {
            work: self.work,
            counted: f64::from(u8::from(self.adhesion == Adhesion::Work)),
            damping: self.damping,
        }
    }

    /// Whether Ψ_A is needed at all.
    #[inline(always)]
    pub(crate) fn uses_work(&self) -> bool {
        self.adhesion == Adhesion::Work || self.damping.adhesion != 0.0
    }

    /// The fractions lost at normal approach speed `v` (m/s).
    #[inline(always)]
    pub fn losses(&self, v: f64, size: &Size) -> Losses {
        let (work, adhesion_damping) = if self.uses_work() { self.work_loss().lost(v, size) } else { (0.0, 0.0) };
        let adhesion = match &self.adhesion {
            Adhesion::Jkr(jkr) => jkr.fraction(v, size),
            _ => work,
        };
        let plastic = match &self.plastic {
            Plastic::None => 0.0,
            Plastic::Kadomtsev(p) => p.fraction(v, size),
            Plastic::ThorntonNing(p) => p.fraction(v, size),
            Plastic::Tabor(p) => p.fraction(v),
        };
        Losses { adhesion, adhesion_damping, hertz_damping: self.damping.hertz_fraction(v), plastic }
    }

    /// Restitution at normal approach speed `v` (m/s).
    ///
    /// ```
    /// use carom::normal::{Ledger, Size, adhesion::Work, ledger::Adhesion};
    /// let ledger = Ledger { adhesion: Adhesion::Work, work: Work::new(127.8e9, 3.03, 0.15, 8000.0), ..Ledger::lossless() };
    /// assert!((ledger.restitution(1.0, &Size::flat(35e-6)) - 0.9728).abs() < 1e-4);
    /// ```
    #[inline(always)]
    pub fn restitution(&self, v: f64, size: &Size) -> f64 {
        self.losses(v, size).restitution()
    }

    /// Yield velocity of the ledger's own plastic loss, m/s.
    pub fn yield_velocity(&self, size: &Size) -> Option<f64> {
        match &self.plastic {
            Plastic::None => None,
            Plastic::Kadomtsev(p) => Some(p.yield_squared(size).sqrt()),
            Plastic::ThorntonNing(p) => Some(p.yield_squared(size).sqrt()),
            Plastic::Tabor(p) => Some(p.yield_velocity),
        }
    }

    /// (V_y)², infinite without a plastic loss; cheap enough for every impact.
    #[inline(always)]
    pub(crate) fn yield_squared(&self, size: &Size) -> f64 {
        match &self.plastic {
            Plastic::None => f64::INFINITY,
            Plastic::Kadomtsev(p) => p.yield_squared(size),
            Plastic::ThorntonNing(p) => p.yield_squared(size),
            Plastic::Tabor(p) => p.yield_velocity * p.yield_velocity,
        }
    }
}
