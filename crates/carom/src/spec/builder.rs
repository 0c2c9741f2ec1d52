//! The one way into a law: typed values in, a law that answers out. The text form compiles through it.

use super::keys::{LawBuilder, LawSpec};
use super::uses::{ALWAYS, Choice, IDLE_BESIDE, ONE_OF};
use super::{CurveSpec, Key, NormalKind, NormalSpec, TangentialKind};
use crate::error::{LawError, Problem};
use crate::material::Library;
use crate::normal::Loss;
use crate::normal::empirical::Curve;
use crate::pair::{Overrides, Pair};
use crate::roughness::RoughnessModel;
use crate::tangential::Tangential;
use crate::wall::WallLaw;
use alloc::vec::Vec;

impl WallLaw {
    /// A law from typed values in SI units; quantities such as [`crate::units::Length`] are taken too.
    ///
    /// ```
    /// use carom::{Impact, WallLaw, material::{Material, PropertyKind as P}, spec::NormalKind};
    /// let steel = Material::new("steel")
    ///     .with(P::Density, 8000.0).with(P::YoungModulus, 190e9).with(P::PoissonRatio, 0.27).with(P::SurfaceEnergy, 1.62);
    /// let silicon = Material::new("silicon")
    ///     .with(P::YoungModulus, 166e9).with(P::PoissonRatio, 0.28).with(P::SurfaceEnergy, 1.42);
    /// let wall = WallLaw::builder().sphere(steel).surface(silicon).normal(NormalKind::Ea).roughness_factor(0.15).build()?;
    /// let out = wall.impact(&Impact::new(70e-6, [0.0, -1.0, 0.0], [0.0, 1.0, 0.0])).expect("it approaches");
    /// assert!((out.restitution - 0.9728).abs() < 1e-3);
    /// # Ok::<(), carom::LawError>(())
    /// ```
    pub fn builder() -> LawBuilder {
        LawBuilder::default()
    }

    /// Asks for friction, for a caller whose impacts slip along the wall: a law without it answers only those that do not
    /// ([`crate::ImpactError::FrictionNotGiven`]).
    ///
    /// # Errors
    /// The law reads a friction coefficient and has none.
    pub fn require_friction(&self) -> Result<(), LawError> {
        match self.tangential() {
            Tangential::NotGiven => Err(Problem::MissingKey { key: Key::Friction, reader: None }.into()),
            _ => Ok(()),
        }
    }
}

impl LawSpec {
    /// Checks the law and turns it into one that answers.
    ///
    /// # Errors
    /// What is missing, impossible, idle or contradictory, with its place in the text the law was read from.
    pub fn compile(&self, library: &Library) -> Result<WallLaw, LawError> {
        self.to_builder(library)?.build().map_err(|e| {
            // a key that came from elsewhere than the text has no place in it
            let key = e.blames().filter(|key| self.is_given(*key)).unwrap_or(Key::Normal);
            e.at(self.span(key))
        })
    }

    /// Does the law, as far as it is written, read the key?
    pub fn reads(&self, key: Key) -> bool {
        let tangential = self.tangential.as_ref().map(|t| t.value);
        let kind = tangential.unwrap_or(match self.tangential_restitution.as_ref().map(|r| &r.value) {
            None => TangentialKind::Rolling,
            Some(CurveSpec::Constant(_)) => TangentialKind::Constant,
            Some(_) => TangentialKind::ByAngle,
        });
        let normal = self.normal.as_ref().map(|n| &n.value);
        let model = self.roughness_model.as_ref().map(|m| m.value);
        ALWAYS.contains(&key) || choices(normal, kind, self.roughness.is_some(), model).iter().any(|c| c.reads(key))
    }

    /// Whether the wall scatters: impacts then depend on their draws, and even a head-on one meets its facet obliquely.
    pub fn scatters(&self) -> bool {
        self.number(Key::RoughnessAngle).is_some_and(|a| a > 0.0)
    }
}

impl LawBuilder {
    /// Checks the law and makes it.
    ///
    /// # Errors
    /// What is missing, impossible, idle or contradictory.
    pub fn build(self) -> Result<WallLaw, LawError> {
        let normal = self.normal.clone().ok_or(Problem::MissingKey { key: Key::Normal, reader: None })?;
        if let NormalSpec::Losses(losses) = &normal {
            super::normal::check(losses)?;
        }
        self.check_values()?;
        self.refuse_idle_keys(&normal)?;
        let pair = self.pair();
        super::compile::law(&self, &normal, pair)
    }

    /// The number of a key that a choice needs.
    pub(crate) fn needed(&self, key: Key, reader: Choice) -> Result<f64, LawError> {
        self.number(key).ok_or_else(|| Problem::MissingKey { key, reader: Some(reader) }.into())
    }

    /// Each number and each material within its range.
    fn check_values(&self) -> Result<(), LawError> {
        for key in Key::ALL {
            if let Some(value) = self.number(*key) {
                key.check(value)?;
            }
        }
        for (key, curve) in
            [(Key::Restitution, &self.restitution), (Key::TangentialRestitution, &self.tangential_restitution)]
        {
            if let Some(curve) = curve {
                super::curve::check(key, curve)?;
            }
        }
        for (key, material) in [(Key::Sphere, &self.sphere), (Key::Surface, &self.surface)] {
            if let Some(material) = material {
                material.check().map_err(|e| e.blame(key))?;
            }
        }
        Ok(())
    }

    /// The tangential law: given, or what the tangential restitution asks for, or rolling.
    pub(super) fn tangential_kind(&self) -> TangentialKind {
        self.tangential.unwrap_or(match &self.tangential_restitution {
            None => TangentialKind::Rolling,
            Some(Curve::Constant(_)) => TangentialKind::Constant,
            Some(_) => TangentialKind::ByAngle,
        })
    }

    /// The parts of the law that read keys.
    fn choices(&self, normal: &NormalSpec) -> Vec<Choice> {
        choices(Some(normal), self.tangential_kind(), self.roughness.is_some(), self.roughness_model)
    }

    /// A key that would silently do nothing, where its reader would expect it to act.
    fn refuse_idle_keys(&self, normal: &NormalSpec) -> Result<(), LawError> {
        let choices = self.choices(normal);
        for key in Key::ALL.iter().copied().filter(|k| self.is_given(*k) && !ALWAYS.contains(k)) {
            if !choices.iter().any(|c| c.reads(key)) {
                let readers = Choice::readers(key);
                let wanted = readers.first().map(|r| r.key());
                let beside = choices.iter().copied().find(|c| Some(c.key()) == wanted);
                return Err(Problem::IdleKey { key, beside, readers }.into());
            }
        }
        let both = |(one, other): &(Key, Key)| self.is_given(*one) && self.is_given(*other);
        if let Some((other, given)) = ONE_OF.into_iter().find(both) {
            return Err(Problem::OneOf { given, other }.into());
        }
        if let Some((given, key)) = IDLE_BESIDE.into_iter().find(both) {
            return Err(Problem::IdleKey { key, beside: Some(Choice::Given(given)), readers: Vec::new() }.into());
        }
        Ok(())
    }

    /// The pair, if any of it is given.
    fn pair(&self) -> Option<Pair> {
        let overrides = Overrides {
            work_of_adhesion: self.work_of_adhesion,
            stiffness: self.stiffness,
            plastic_constant: self.plastic_constant,
            interfacial_parameter: self.interfacial_parameter,
            dynamic_strength_factor: self.dynamic_strength_factor,
        };
        let nothing = self.sphere.is_none() && self.surface.is_none() && overrides == Overrides::default();
        (!nothing).then(|| Pair::of(self.sphere.as_ref(), self.surface.as_ref(), &overrides))
    }
}

/// The parts of a law that read keys.
fn choices(
    normal: Option<&NormalSpec>,
    tangential: TangentialKind,
    roughness: bool,
    model: Option<RoughnessModel>,
) -> Vec<Choice> {
    let mut choices = match normal {
        None => Vec::new(),
        Some(NormalSpec::Named(kind)) => vec![Choice::Normal(*kind)],
        Some(NormalSpec::Losses(losses)) => losses.iter().map(|l| Choice::Loss(*l)).collect(),
    };
    choices.push(Choice::Tangential(tangential));
    if roughness && choices.iter().any(|c| c.reads(Key::Roughness)) {
        choices.extend([Choice::Given(Key::Roughness), Choice::RoughnessModel(model.unwrap_or_default())]);
    }
    choices
}

impl NormalSpec {
    /// Its losses, with the dampings whose coefficients are given; none for a table or the resolved law.
    pub(super) fn losses(&self, builder: &LawBuilder) -> Vec<Loss> {
        match self {
            Self::Losses(list) => list.clone(),
            Self::Named(kind) => {
                let (always, given) = kind.losses();
                let given = given.iter().filter(|l| match l {
                    Loss::AdhesionDamping => builder.adhesion_damping.is_some(),
                    Loss::HertzDamping => builder.hertz_damping.is_some(),
                    _ => true,
                });
                always.iter().chain(given).copied().collect()
            }
        }
    }

    /// A table has no adhesion and need not have a pair.
    pub(super) fn is_table(&self) -> bool {
        matches!(self, Self::Named(NormalKind::Constant | NormalKind::ByAngle))
    }
}
