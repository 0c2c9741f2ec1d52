//! What a law without a plastic loss leaves out: the yield velocity of its materials, and what `eap` would give.

use super::WallLaw;
use crate::impact::ImpactError;
use crate::math::sqrt;
use crate::normal::plastic::Kadomtsev;
use crate::normal::{Ledger, NormalLaw, Term};
use crate::pair::{Body, Strength, StrengthSource};
use alloc::borrow::ToOwned;
use alloc::string::String;
use core::fmt;

/// An impact of a law without a plastic loss above the yield velocity of its materials. Its `Display` is a sentence.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct AboveYield {
    /// Normal speed of the impact, m/s.
    pub speed: f64,
    /// Yield velocity, m/s: that of `eap` for the same pair.
    pub yield_velocity: f64,
    /// The strength it follows from.
    pub strength: Strength,
    /// The material that yields first; `None` where the plastic constant was given for the pair.
    pub material: Option<String>,
    /// The restitution with Kadomtsev's plastic loss beside the law's own losses (law `eap`); 0 where the sphere is then captured.
    pub restitution: f64,
    /// The capture velocity with that loss, m/s; `None` where the sphere is then captured at every speed.
    pub capture_velocity: Option<f64>,
}

/// To four significant digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

impl fmt::Display for AboveYield {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let whose = self.material.as_deref().map_or(String::new(), |name| format!(" of {name}"));
        let source = match self.strength.source {
            StrengthSource::Given => "from the plastic constant given".to_owned(),
            StrengthSource::YieldStrength => format!("from the yield strength{whose}, a bulk, static value"),
            StrengthSource::Hardness => format!("from the hardness{whose}, a static indentation"),
        };
        write!(
            f,
            "the yield velocity is {} m/s ({source}; small, fast contacts are stronger)",
            rounded(self.yield_velocity)
        )?;
        match self.capture_velocity {
            _ if self.restitution > 0.0 => write!(f, ", and eap would give e = {}", rounded(self.restitution)),
            Some(v) if v < self.speed => f.write_str(", and eap leaves nothing either"),
            Some(v) => write!(f, ", and eap would capture up to {} m/s", rounded(v)),
            None => f.write_str(", and eap would capture at every speed"),
        }
    }
}

impl WallLaw {
    /// What [`crate::Validity::ABOVE_YIELD`] warns of, in numbers, for a normal speed (m/s), a diameter (m) and a density (kg/m³, the law's own
    /// when absent). `None` where the law has a plastic loss or a given restitution, where its materials' strength is not known, and at
    /// and below the yield velocity.
    ///
    /// # Errors
    /// A diameter or density out of range.
    ///
    /// ```
    /// let law = carom::spec::parse_law("sphere = \"quartz\"\nsurface = \"steel\"\nnormal = \"ea\"\nfriction = 0.4\n")?;
    /// let wall = law.compile(carom::material::Library::builtin())?;
    /// let warning = wall.above_yield(100.0, 200e-6, None).expect("in range").expect("far above");
    /// assert!(warning.to_string().starts_with("the yield velocity is 0.3825 m/s (from the yield strength of carbon-steel, a bulk,"));
    /// assert!((warning.yield_velocity - 0.382).abs() < 1e-3 && (warning.restitution - 0.326).abs() < 1e-3);
    /// # Ok::<(), carom::LawError>(())
    /// ```
    pub fn above_yield(
        &self,
        speed: f64,
        diameter: f64,
        density: Option<f64>,
    ) -> Result<Option<AboveYield>, ImpactError> {
        let size = self.size(diameter, density)?;
        let Some((loss, strength)) = self.missing_loss() else { return Ok(None) };
        let yield_squared = loss.yield_squared(&size);
        if speed * speed <= yield_squared {
            return Ok(None);
        }
        let ledger = self.with_plastic_loss(loss);
        let restitution = ledger.map_or(0.0, |l| l.restitution(speed, &size));
        let capture_velocity = ledger.and_then(|l| l.window(&size)).map(|w| w.capture_velocity);
        let material = strength.body.and_then(|body| {
            let pair = self.pair()?;
            let material = if body == Body::Sphere { pair.sphere() } else { pair.surface() };
            Some(material.name.clone())
        });
        Ok(Some(AboveYield {
            speed,
            yield_velocity: sqrt(yield_squared),
            strength,
            material,
            restitution,
            capture_velocity,
        }))
    }

    /// The plastic loss that a law of elastic bodies lacks, where the strength of its materials is known.
    fn missing_loss(&self) -> Option<(Kadomtsev, Strength)> {
        let pair = self.pair().filter(|_| self.normal().is_elastic())?;
        let strength = pair.strength().ok()?;
        let loss = Kadomtsev::new(pair.effective_modulus().ok()?, strength.plastic_constant, self.density());
        Some((loss, strength))
    }

    fn with_plastic_loss(&self, loss: Kadomtsev) -> Option<Ledger> {
        let plastic = core::iter::once(Term::PlasticKadomtsev(loss));
        match self.normal() {
            NormalLaw::Ledger(ledger) => Ledger::new(ledger.terms().copied().chain(plastic)).ok(),
            NormalLaw::Resolved(resolved) => Ledger::new(resolved.as_losses().into_iter().chain(plastic)).ok(),
            NormalLaw::Table(_) => None,
        }
    }
}
