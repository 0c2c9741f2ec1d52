//! The energy ledger: a list of losses, and the restitution they leave.
//!
//! e² = 1 − Σ ε_i(v), Kim & Dunn (2007), Eqs 24 and 37, J. Aerosol Sci. 38, 532–549,
//! <https://doi.org/10.1016/j.jaerosci.2007.03.006>. e² ≤ 0 is capture. At most one of the two adhesion works and one of the
//! four plastic losses may stand in a ledger: two of a kind would count the same energy twice.
//!
//! The additive sum is an approximation where losses act on the same contact: adhesion work above yield keeps the elastic
//! contact radius, and damping fitted on elastic contacts beside a plastic loss may count energy twice (`losses-overlap`).

use super::Size;
use super::adhesion::{Jkr, Work};
use super::bons::Bons;
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
    /// `plastic-bons`
    PlasticBons,
    /// `adhesion-jkr`
    AdhesionJkr,
}

impl Loss {
    /// Every loss, in the order of the documentation.
    pub const ALL: [Self; 8] = [
        Self::AdhesionWork,
        Self::AdhesionDamping,
        Self::HertzDamping,
        Self::PlasticKadomtsev,
        Self::PlasticThorntonNing,
        Self::PlasticTabor,
        Self::PlasticBons,
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
            Self::PlasticBons => "plastic-bons",
            Self::AdhesionJkr => "adhesion-jkr",
        }
    }

    /// What it is an instance of: two losses of a kind cannot share a ledger.
    pub fn kind(self) -> &'static str {
        match self {
            Self::AdhesionWork | Self::AdhesionJkr => "adhesion work",
            Self::PlasticKadomtsev | Self::PlasticThorntonNing | Self::PlasticTabor | Self::PlasticBons => {
                "plastic loss"
            }
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
    /// Bons'.
    Bons(Bons),
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
impl PlasticLoss for Bons {
    #[inline(always)]
    fn lost(&self, v: f64, size: &Size) -> f64 {
        self.fraction(v, size)
    }
}

/// What the losses took and what they left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Balance {
    pub losses: Losses,
    /// e², not above zero for a capture: 1 − Σ ε_i with the fewest operations after the last-known number, Ψ_A.
    pub left: f64,
}

impl Balance {
    #[inline(always)]
    pub fn restitution(&self) -> f64 {
        if self.left > 0.0 { self.left.sqrt() } else { 0.0 }
    }
}

/// The losses that grow with Ψ_A, as a type, likewise.
pub(crate) trait AdhesiveLoss: Copy {
    fn share(&self, v: f64, size: &Size) -> Adhesive;
}
/// (adhesion, adhesion damping), and their sum as a product.
#[derive(Clone, Copy, Default)]
pub(crate) struct Adhesive {
    adhesion: f64,
    damping: f64,
    power: f64,
    weight: f64,
}
/// Ψ_A (counted or not) with its damping.
#[derive(Clone, Copy)]
pub(crate) struct WorkLoss {
    work: Work,
    counted: f64,
    damping: f64,
}
impl AdhesiveLoss for WorkLoss {
    #[inline(always)]
    fn share(&self, v: f64, size: &Size) -> Adhesive {
        let power = self.work.power(v, size);
        let psi = self.work.scale() * power;
        let damped = self.damping * v;
        let weight = self.work.scale() * (self.counted + damped);
        Adhesive { adhesion: self.counted * psi, damping: psi * damped, power, weight }
    }
}
#[derive(Clone, Copy)]
pub(crate) struct NoAdhesion;
impl AdhesiveLoss for NoAdhesion {
    #[inline(always)]
    fn share(&self, _: f64, _: &Size) -> Adhesive {
        Adhesive::default()
    }
}

#[inline(always)]
pub(crate) fn balance<A: AdhesiveLoss, P: PlasticLoss>(
    adhesive: &A,
    plastic: &P,
    damping: &Damping,
    v: f64,
    size: &Size,
) -> Balance {
    settle(&adhesive.share(v, size), plastic.lost(v, size), damping.hertz_fraction(v), 0.0)
}

#[inline(always)]
fn settle(adhesive: &Adhesive, plastic: f64, hertz: f64, jkr: f64) -> Balance {
    Balance {
        losses: Losses {
            adhesion: adhesive.adhesion + jkr,
            adhesion_damping: adhesive.damping,
            hertz_damping: hertz,
            plastic,
        },
        left: (-adhesive.power).mul_add(adhesive.weight, 1.0 - (plastic + hertz) - jkr),
    }
}

impl Ledger {
    /// A ledger with no loss at all: e = 1.
    pub fn lossless() -> Self {
        Self { adhesion: Adhesion::None, work: Work::default(), damping: Damping::default(), plastic: Plastic::None }
    }

    #[inline(always)]
    pub(crate) fn work_loss(&self) -> WorkLoss {
        let counted = f64::from(u8::from(self.adhesion == Adhesion::Work));
        WorkLoss { work: self.work, counted, damping: self.damping.adhesion }
    }

    /// Whether Ψ_A is needed at all.
    #[inline(always)]
    pub(crate) fn uses_work(&self) -> bool {
        self.adhesion == Adhesion::Work || self.damping.adhesion != 0.0
    }

    #[inline(always)]
    pub(crate) fn balance(&self, v: f64, size: &Size) -> Balance {
        let adhesive = if self.uses_work() { self.work_loss().share(v, size) } else { Adhesive::default() };
        let jkr = match &self.adhesion {
            Adhesion::Jkr(jkr) => jkr.fraction(v, size),
            _ => 0.0,
        };
        let plastic = match &self.plastic {
            Plastic::None => 0.0,
            Plastic::Kadomtsev(p) => p.fraction(v, size),
            Plastic::ThorntonNing(p) => p.fraction(v, size),
            Plastic::Tabor(p) => p.fraction(v),
            Plastic::Bons(p) => p.fraction(v, size),
        };
        settle(&adhesive, plastic, self.damping.hertz_fraction(v), jkr)
    }

    /// The fractions lost at normal approach speed `v` (m/s).
    pub fn losses(&self, v: f64, size: &Size) -> Losses {
        self.balance(v, size).losses
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
        self.balance(v, size).restitution()
    }

    /// Yield velocity of the ledger's own plastic loss, m/s.
    pub fn yield_velocity(&self, size: &Size) -> Option<f64> {
        match &self.plastic {
            Plastic::None => None,
            Plastic::Kadomtsev(p) => Some(p.yield_squared(size).sqrt()),
            Plastic::ThorntonNing(p) => Some(p.yield_squared(size).sqrt()),
            Plastic::Tabor(p) => Some(p.yield_velocity),
            Plastic::Bons(p) => Some(p.yield_squared(size).sqrt()),
        }
    }

    /// Can the plastic loss end the rebound at high speed, as damping can?
    pub fn plastic_can_exhaust(&self) -> bool {
        matches!(self.plastic, Plastic::Bons(_))
    }

    /// (V_y)², infinite without a plastic loss; cheap enough for every impact.
    #[inline(always)]
    pub(crate) fn yield_squared(&self, size: &Size) -> f64 {
        match &self.plastic {
            Plastic::None => f64::INFINITY,
            Plastic::Kadomtsev(p) => p.yield_squared(size),
            Plastic::ThorntonNing(p) => p.yield_squared(size),
            Plastic::Tabor(p) => p.yield_velocity * p.yield_velocity,
            Plastic::Bons(p) => p.yield_squared(size),
        }
    }
}
