//! A fit as a wall law in its text form, with what was fitted to what in comments.

use super::{Estimate, Fit};
use crate::error::LabError;
use carom::material::Library;
use carom::spec::parse_named_law;
use carom_report::significant;
use std::fmt::Write as _;

impl Fit {
    /// The text of a law file with the table `[law.NAME]`, read again and compiled before it is given.
    ///
    /// # Errors
    /// A law that does not survive that; none in practice.
    pub fn law_file(&self, name: &str, library: &Library) -> Result<String, LabError> {
        let mut text = String::new();
        let mut say = |line: &str| {
            for line in line.lines() {
                let _ = writeln!(text, "# {line}");
            }
        };
        say(&format!("Fitted by carom fit to {}, {} points.", self.data.name, self.data.points.len()));
        if !self.data.said.is_empty() {
            say(&format!("It says of itself: {}", self.data.said));
        }
        self.parameters.iter().for_each(|p| say(&p.line()));
        if let Some(chi) = self.goodness.reduced_chi_square {
            say(&format!(
                "Reduced chi-square {} with {} degrees of freedom.",
                significant(chi, 3),
                self.goodness.freedom
            ));
        }
        if let Some(scatter) = self.goodness.scatter {
            let freedom = self.goodness.freedom;
            say(&format!(
                "Standard deviation about the fit {} with {freedom} degrees of freedom.",
                significant(scatter, 3)
            ));
        }
        self.warnings.iter().for_each(|w| say(&format!("Mind: {w}.")));
        if self.law.friction.is_none() {
            say("Friction was not measured: add friction = ... for oblique impacts.");
        }
        text += &self.law.to_toml(name).map_err(LabError::Fit)?;
        let again = parse_named_law(&text, name).map_err(LabError::Fit)?;
        again.compile(library).map_err(LabError::Fit)?;
        Ok(text)
    }
}

impl Estimate {
    /// `adhesion_damping = 1.3 ± 0.1 s/m (95 %: 1.1 to 1.5)`
    fn line(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let value = significant(self.value, 4);
        match (self.standard_error, self.interval) {
            (Some(error), Some((low, high))) => format!(
                "{} = {value} ± {}{unit} (95 %: {} to {})",
                self.parameter,
                significant(error, 2),
                significant(low, 4),
                significant(high, 4)
            ),
            _ if self.at_bound => format!("{} = {value}{unit}, at its bound", self.parameter),
            _ => format!("{} = {value}{unit}, not told by the data", self.parameter),
        }
    }
}
