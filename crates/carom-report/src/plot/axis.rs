//! An axis: what it shows, in which unit, how it is divided.

/// How an axis is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scale {
    /// Equal steps.
    #[default]
    Linear,
    /// Equal ratios; values that are not positive are left out.
    Log,
}

/// An axis of a plot, or the colour bar of a heat map.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What is shown: "speed".
    pub label: String,
    /// The unit shown: "m/s"; empty for none.
    pub unit: String,
    /// How the axis is divided.
    pub scale: Scale,
    /// Ends of the axis in the data's unit, the smaller first; chosen from the data when absent.
    pub range: Option<(f64, f64)>,
    /// Shown value per data value.
    pub factor: f64,
}

impl Axis {
    /// A linear axis over all the data, which are in `unit`.
    pub fn new(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { label: label.into(), unit: unit.into(), scale: Scale::Linear, range: None, factor: 1.0 }
    }

    /// An axis whose numbers are the data times `factor`: `Axis::scaled("diameter", "µm", 1e6)` for data in metres.
    pub fn scaled(label: impl Into<String>, unit: impl Into<String>, factor: f64) -> Self {
        Self { factor, ..Self::new(label, unit) }
    }

    /// Divides the axis by equal ratios.
    #[must_use]
    pub fn log(mut self) -> Self {
        self.scale = Scale::Log;
        self
    }

    /// Sets the ends, in the data's unit; what lies outside is cut off.
    #[must_use]
    pub fn range(mut self, from: f64, to: f64) -> Self {
        self.range = Some((from.min(to), from.max(to)));
        self
    }

    /// The label with its unit: "speed (m/s)".
    #[must_use]
    pub fn heading(&self) -> String {
        match (self.label.is_empty(), self.unit.is_empty()) {
            (_, true) => self.label.clone(),
            (true, false) => self.unit.clone(),
            (false, false) => format!("{} ({})", self.label, self.unit),
        }
    }
}
