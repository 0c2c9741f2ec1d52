//! From a law as written to a law that answers: every need is checked here, once.

use super::check::{checked, form_fits, need, not_negative, positive};
use super::curve::Which;
use super::{At, LawSpec, NormalKind, NormalSpec};
use crate::error::SpecError;
use crate::material::{Library, Material, MaterialRef};
use crate::normal::adhesion::Work;
use crate::normal::empirical::Curve;
use crate::normal::ledger::TwoOfAKind;
use crate::normal::{Inputs, Ledger, Loss, NormalLaw};
use crate::pair::{Overrides, Pair};
use crate::resolved::{Damping, Resolved};
use crate::roughness;
use crate::validity::Validity;
use crate::wall::{About, Normal, Parts, WallLaw};

/// The numbers of a law, each within its range.
struct Numbers {
    adhesion_damping: Option<f64>,
    hertz_damping: Option<f64>,
    roughness_factor: f64,
    spacing: f64,
    surface_curvature: f64,
    overrides: Overrides,
}

impl LawSpec {
    /// Checks the law and turns it into one that answers.
    ///
    /// # Errors
    /// What is missing, impossible or contradictory, with its place in the text the law was read from.
    pub fn compile(&self, library: &Library) -> Result<WallLaw, SpecError> {
        let normal_spec = self
            .normal
            .as_ref()
            .ok_or_else(|| need("a normal law", &format!("normal = \"{}\"", NormalKind::NAMES.join("\" or \""))))?;
        let mut numbers = self.numbers()?;
        let pair = self.pair(library, &numbers)?;
        // a table has no adhesion that a roughness could lessen, and need not have a pair
        let table = matches!(normal_spec.value, NormalSpec::Named(NormalKind::Constant | NormalKind::ByAngle));
        let roughness = self.roughness(numbers.spacing, pair.as_ref().filter(|_| !table))?;
        numbers.roughness_factor = roughness.factor;
        let place = normal_spec.span.clone();
        self.refuse_idle_keys(&normal_spec.value)?;
        let normal = self.normal_law(&normal_spec.value, pair.as_ref(), &numbers).map_err(|e| e.at(place))?;
        let tangential = self.tangential_law(pair.as_ref())?;
        let uses_roughness = matches!(&normal, Normal::Compiled(law) if law.uses_roughness());
        Ok(WallLaw::new(Parts {
            normal,
            tangential,
            surface_curvature: numbers.surface_curvature,
            scatter: self.scatter()?,
            validity: Validity::ROUGHNESS_EXTRAPOLATED.when(roughness.extrapolated && uses_roughness),
            about: About {
                pair,
                roughness: roughness.height,
                roughness_factor: roughness.factor,
                spacing: numbers.spacing,
            },
        }))
    }

    fn numbers(&self) -> Result<Numbers, SpecError> {
        let damping = "zero or more is wanted, in s/m";
        let spacing = checked(
            &self.equilibrium_spacing,
            "equilibrium_spacing",
            |l| l.0,
            positive,
            "a positive length is wanted",
        )?
        .unwrap_or(roughness::CALIBRATED_SPACING);
        let radius = checked(
            &self.surface_curvature,
            "surface_curvature",
            |r| r.0,
            |v| v != 0.0 && !v.is_nan(),
            "a radius of curvature, \"inf\" for a flat surface, negative for a concave one",
        )?;
        Ok(Numbers {
            adhesion_damping: checked(&self.adhesion_damping, "adhesion_damping", |d| d.0, not_negative, damping)?,
            hertz_damping: checked(&self.hertz_damping, "hertz_damping", |d| d.0, not_negative, damping)?,
            roughness_factor: 1.0,
            spacing,
            surface_curvature: radius.map_or(0.0, |r| 1.0 / r),
            overrides: Overrides {
                work_of_adhesion: checked(
                    &self.work_of_adhesion,
                    "work_of_adhesion",
                    |w| w.0,
                    not_negative,
                    "zero or more is wanted, in J/m2",
                )?,
                stiffness: checked(&self.stiffness, "stiffness", |k| k.0, positive, "a positive pressure is wanted")?,
                plastic_constant: checked(
                    &self.plastic_constant,
                    "plastic_constant",
                    |k| k.0,
                    positive,
                    "a positive pressure is wanted",
                )?,
                dynamic_strength_factor: None,
                interfacial_parameter: checked(
                    &self.interfacial_parameter,
                    "interfacial_parameter",
                    |p| p.0,
                    positive,
                    "a positive number, about 1",
                )?,
            },
        })
    }

    fn pair(&self, library: &Library, numbers: &Numbers) -> Result<Option<Pair>, SpecError> {
        let resolve = |given: &At<MaterialRef>| given.value.resolve(library).map_err(|e| e.at(given.span.clone()));
        let sphere = self.sphere.as_ref().map(resolve).transpose()?;
        let surface = self.surface.as_ref().map(resolve).transpose()?;
        if sphere.is_none() && surface.is_none() && numbers.overrides == Overrides::default() {
            return Ok(None);
        }
        let unnamed = |what: &str| Material { name: format!("the {what} (not given)"), ..Material::default() };
        Ok(Some(Pair::new(
            &sphere.unwrap_or_else(|| unnamed("sphere")),
            &surface.unwrap_or_else(|| unnamed("surface")),
            &numbers.overrides,
        )))
    }

    /// Keys that would silently do nothing, where a reader would expect them to.
    fn refuse_idle_keys(&self, normal: &NormalSpec) -> Result<(), SpecError> {
        let table = matches!(normal, NormalSpec::Named(NormalKind::Constant | NormalKind::ByAngle));
        if let (Some(at), false) = (&self.restitution, table) {
            return Err(SpecError::new("restitution has no effect on this normal law")
                .help("write normal = \"constant\" or \"by-angle\", or leave it out")
                .at(at.span.clone()));
        }
        let takes = |loss: Loss| match normal {
            NormalSpec::Losses(list) => list.contains(&loss),
            NormalSpec::Named(NormalKind::ThorntonNing | NormalKind::Tabor) => false,
            NormalSpec::Named(_) => true,
        };
        for (key, span, loss) in [
            ("adhesion_damping", self.adhesion_damping.as_ref().map(|a| &a.span), Loss::AdhesionDamping),
            ("hertz_damping", self.hertz_damping.as_ref().map(|a| &a.span), Loss::HertzDamping),
        ] {
            if let (Some(span), false) = (span, takes(loss)) {
                return Err(SpecError::new(format!("{key} has no effect: the law has no {}", loss.name()))
                    .help(format!("list the losses with \"{}\" among them, or leave the key out", loss.name()))
                    .at(span.clone()));
            }
        }
        if let (Some(at), false) = (&self.adhesion, matches!(normal, NormalSpec::Named(NormalKind::Resolved))) {
            return Err(SpecError::new("adhesion is a choice of the resolved law alone")
                .help("write normal = \"resolved\", or leave it out")
                .at(at.span.clone()));
        }
        Ok(())
    }

    fn normal_law(&self, spec: &NormalSpec, pair: Option<&Pair>, numbers: &Numbers) -> Result<Normal, SpecError> {
        let damping = [Loss::AdhesionDamping, Loss::HertzDamping];
        let given = |losses: &[Loss]| {
            let coefficients = [numbers.adhesion_damping, numbers.hertz_damping];
            let extra = damping.iter().zip(coefficients).filter(|(_, c)| c.is_some()).map(|(l, _)| *l);
            losses.iter().copied().chain(extra).collect::<Vec<_>>()
        };
        let losses = match spec {
            NormalSpec::Losses(list) => list.clone(),
            NormalSpec::Named(NormalKind::Ea) => given(&[Loss::AdhesionWork]),
            NormalSpec::Named(NormalKind::Eap) => given(&[Loss::PlasticKadomtsev, Loss::AdhesionWork]),
            NormalSpec::Named(NormalKind::ThorntonNing) => vec![Loss::PlasticThorntonNing, Loss::AdhesionJkr],
            NormalSpec::Named(NormalKind::Tabor) => vec![Loss::PlasticTabor],
            NormalSpec::Named(kind @ (NormalKind::Constant | NormalKind::ByAngle)) => {
                return self.table(*kind).map(Normal::Curve);
            }
            NormalSpec::Named(NormalKind::Resolved) => {
                let pair = pair.ok_or_else(|| {
                    need("a sphere and a surface", "sphere and surface, by name or with their properties")
                })?;
                let damping = Damping {
                    adhesion: numbers.adhesion_damping.unwrap_or(0.0),
                    hertz: numbers.hertz_damping.unwrap_or(0.0),
                };
                let mode = self.adhesion.as_ref().map(|a| a.value).unwrap_or_default();
                let work = Work::of(&Inputs::new(Some(pair), numbers.roughness_factor, &|_| None))?;
                return Ok(Normal::Compiled(NormalLaw::Resolved(Resolved::new(work, damping, mode))));
            }
        };
        super::normal::check(&losses)?;
        self.ledger(&losses, pair, numbers).map(|ledger| Normal::Compiled(NormalLaw::Ledger(ledger)))
    }

    fn table(&self, kind: NormalKind) -> Result<Curve, SpecError> {
        let example =
            if kind == NormalKind::Constant { "restitution = 0.7" } else { "restitution = { polynomial = [...] }" };
        let at = self.restitution.as_ref().ok_or_else(|| need("a restitution", example))?;
        form_fits(kind == NormalKind::Constant, at, "normal")?;
        at.value.resolve(Which::Normal).map_err(|e| e.at(at.span.clone()))
    }

    fn ledger(&self, losses: &[Loss], pair: Option<&Pair>, numbers: &Numbers) -> Result<Ledger, SpecError> {
        if losses.contains(&Loss::AdhesionJkr) {
            self.refuse_roughness_beside_jkr(losses)?;
        }
        let given = self.loss_keys()?;
        let number = |key: &str| match key {
            "adhesion_damping" => numbers.adhesion_damping,
            "hertz_damping" => numbers.hertz_damping,
            _ => given.iter().find(|(name, _)| *name == key).and_then(|(_, value)| *value),
        };
        let inputs = Inputs::new(pair, numbers.roughness_factor, &number);
        let terms = losses.iter().map(|loss| loss.compile(&inputs)).collect::<Result<Vec<_>, _>>()?;
        Ledger::new(terms).map_err(|TwoOfAKind(first, second)| super::normal::two_of_a_kind(first, second))
    }

    /// Numbers that single losses read.
    fn loss_keys(&self) -> Result<[(&'static str, Option<f64>); 3], SpecError> {
        let pressure = "a positive pressure is wanted";
        let index = "Meyer's index lies between 0.5 and 3 (2 without, 2.5 with full work hardening)";
        let speed = "a positive speed is wanted";
        Ok([
            ("limiting_pressure", checked(&self.limiting_pressure, "limiting_pressure", |p| p.0, positive, pressure)?),
            ("yield_velocity", checked(&self.yield_velocity, "yield_velocity", |v| v.0, positive, speed)?),
            ("meyer_index", checked(&self.meyer_index, "meyer_index", |n| n.0, |n| n > 0.5 && n < 3.0, index)?),
        ])
    }

    fn refuse_roughness_beside_jkr(&self, losses: &[Loss]) -> Result<(), SpecError> {
        let span = self.roughness_factor.as_ref().map(|a| &a.span).or(self.roughness.as_ref().map(|a| &a.span));
        match span {
            Some(span) if !losses.contains(&Loss::AdhesionDamping) => {
                Err(SpecError::new("a roughness factor beside adhesion-jkr, which has none in it")
                    .help("leave roughness_factor and roughness out, or use adhesion-work")
                    .at(span.clone()))
            }
            _ => Ok(()),
        }
    }
}
