//! Which keys a law reads: declared by each loss, each law and each model, for what they do in an impact and for the figures and
//! warnings that go with it. A key that none of a law's parts declares is refused.
//!
//! A test holds the declarations against what the laws answer (`crates/carom/tests/keys.rs`).

use super::{Key, NormalKind, TangentialKind};
use crate::error::Wording;
use crate::normal::Loss;
use crate::resolved::AdhesionMode;
use crate::roughness::RoughnessModel;
use alloc::string::String;
use alloc::vec::Vec;

/// A part of a law that reads keys of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Choice {
    /// A normal law by name.
    Normal(NormalKind),
    /// A loss in a list.
    Loss(Loss),
    /// A tangential law.
    Tangential(TangentialKind),
    /// A model of roughness.
    RoughnessModel(RoughnessModel),
    /// A key whose presence makes another count.
    Given(Key),
}

/// The contact's size, for `large-contact`.
const CONTACT: [Key; 2] = [Key::Stiffness, Key::SurfaceCurvature];

impl Loss {
    /// The keys it reads, those of its materials' constants among them.
    pub fn keys(self) -> Vec<Key> {
        self.own_keys().iter().chain(&CONTACT).copied().collect()
    }
}

impl NormalKind {
    /// The losses that a law always has, and those it has where their coefficient is given.
    pub(crate) fn losses(self) -> (&'static [Loss], &'static [Loss]) {
        const DAMPING: &[Loss] = &[Loss::AdhesionDamping, Loss::HertzDamping];
        match self {
            Self::Ea => (&[Loss::AdhesionWork], DAMPING),
            Self::Eap => (&[Loss::PlasticKadomtsev, Loss::AdhesionWork], DAMPING),
            Self::ThorntonNing => (&[Loss::PlasticThorntonNing, Loss::AdhesionJkr], &[]),
            Self::Tabor => (&[Loss::PlasticTabor], &[]),
            Self::Dahneke => (&[Loss::GivenRestitution, Loss::AdhesionWell], &[]),
            Self::Constant | Self::ByAngle | Self::Resolved => (&[], &[]),
        }
    }

    /// The keys it reads.
    pub fn keys(self) -> Vec<Key> {
        let (always, given) = self.losses();
        let of_losses = always.iter().chain(given).flat_map(|l| l.keys());
        match self {
            Self::Constant | Self::ByAngle => vec![Key::Restitution],
            Self::Resolved => {
                let work = [Loss::AdhesionWork, Loss::AdhesionDamping, Loss::HertzDamping];
                work.into_iter().flat_map(Loss::keys).chain([Key::Adhesion]).collect()
            }
            _ => of_losses.collect(),
        }
    }
}

impl TangentialKind {
    /// The keys it reads.
    pub fn keys(self) -> &'static [Key] {
        match self {
            Self::Rolling | Self::MicroSlip => &[Key::Friction],
            Self::Walton => &[Key::Friction, Key::WaltonBeta],
            Self::Constant | Self::ByAngle => &[Key::TangentialRestitution],
        }
    }
}

impl RoughnessModel {
    /// The keys it reads.
    pub fn keys(self) -> &'static [Key] {
        match self {
            Self::Rabinovich => &[Key::EquilibriumSpacing],
            Self::FullerTabor => &[Key::AsperityRadius],
        }
    }
}

impl AdhesionMode {
    /// The keys it reads: none.
    pub fn keys(self) -> &'static [Key] {
        &[]
    }
}

impl Choice {
    /// Everything that reads keys, the laws by name before single losses.
    pub fn all() -> impl Iterator<Item = Self> {
        let normal = NormalKind::ALL.iter().map(|k| Self::Normal(*k));
        let losses = Loss::ALL.iter().copied().map(Self::Loss);
        let tangential = TangentialKind::ALL.iter().map(|k| Self::Tangential(*k));
        let models = RoughnessModel::ALL.iter().map(|m| Self::RoughnessModel(*m));
        normal.chain(losses).chain(tangential).chain(models).chain([Self::Given(Key::Roughness)])
    }

    /// The key that makes the choice.
    pub fn key(self) -> Key {
        match self {
            Self::Normal(_) | Self::Loss(_) => Key::Normal,
            Self::Tangential(_) => Key::Tangential,
            Self::RoughnessModel(_) => Key::RoughnessModel,
            Self::Given(key) => key,
        }
    }

    /// Does it read `key`?
    pub fn reads(self, key: Key) -> bool {
        match self {
            Self::Normal(kind) => kind.keys().contains(&key),
            Self::Loss(loss) => loss.keys().contains(&key),
            Self::Tangential(kind) => kind.keys().contains(&key),
            Self::RoughnessModel(model) => model.keys().contains(&key),
            Self::Given(_) => key == Key::RoughnessModel,
        }
    }

    /// What reads `key`.
    pub fn readers(key: Key) -> Vec<Self> {
        Self::all().filter(|c| c.reads(key)).collect()
    }

    /// Is `key` read only beside the key `other`?
    pub(super) fn only_beside(key: Key, other: Key) -> bool {
        let readers = Self::readers(key);
        let beside = |c: &Self| match c {
            Self::Given(given) => *given == other,
            Self::RoughnessModel(_) => other == Key::Roughness,
            _ => false,
        };
        !readers.is_empty() && readers.iter().all(beside)
    }

    /// Its name, as a value of its key.
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal(kind) => kind.name(),
            Self::Loss(loss) => loss.name(),
            Self::Tangential(kind) => kind.name(),
            Self::RoughnessModel(model) => model.name(),
            Self::Given(key) => key.name(),
        }
    }

    /// As it is written by a front's users.
    pub fn setting(self, words: &dyn Wording) -> String {
        match self {
            Self::Loss(loss) => words.loss(loss.name()),
            Self::Given(key) => words.key(key.name()),
            other => words.setting(other.key().name(), other.name()),
        }
    }
}

impl Key {
    /// What reads it, in the words of a front: `normal = "ea" or "eap", or with the loss adhesion-work`.
    pub fn read_with(self, words: &dyn Wording) -> String {
        crate::error::read_with(&Choice::readers(self), words)
    }
}

/// Keys that every law reads: its parts, its materials, and the facets of a wall that scatters.
pub(crate) const ALWAYS: [Key; 5] = [Key::Sphere, Key::Surface, Key::Normal, Key::Tangential, Key::RoughnessAngle];

/// Each says what the other says.
pub(crate) const ONE_OF: [(Key, Key); 2] =
    [(Key::RoughnessFactor, Key::Roughness), (Key::WellDepth, Key::HamakerConstant)];

/// Where the first key is given, a law reads it in place of the second.
pub(crate) const IDLE_BESIDE: [(Key, Key); 3] = [
    (Key::WorkOfAdhesion, Key::InterfacialParameter),
    (Key::LimitingPressure, Key::PlasticConstant),
    (Key::LimitingPressure, Key::DynamicStrengthFactor),
];
