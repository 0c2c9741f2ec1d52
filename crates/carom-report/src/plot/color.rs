//! Colours that people with any kind of colour vision tell apart.

/// A colour: red, green and blue, 0 to 255.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Color(pub u8, pub u8, pub u8);

impl Color {
    /// Blue of the palette.
    pub const BLUE: Self = Self(0, 114, 178);
    /// Vermilion of the palette.
    pub const VERMILION: Self = Self(213, 94, 0);
    /// Bluish green of the palette.
    pub const GREEN: Self = Self(0, 158, 115);
    /// Reddish purple of the palette.
    pub const PURPLE: Self = Self(204, 121, 167);
    /// Orange of the palette.
    pub const ORANGE: Self = Self(230, 159, 0);
    /// Sky blue of the palette.
    pub const SKY: Self = Self(86, 180, 233);
    /// Black of the palette.
    pub const BLACK: Self = Self(0, 0, 0);
    /// A mid grey, for what stands in the background.
    pub const GREY: Self = Self(120, 120, 120);

    /// The colours of Okabe & Ito 2008 (Color Universal Design) in the order in which series take them;
    /// their yellow is left out, too faint for a line on white.
    pub const PALETTE: [Self; 7] =
        [Self::BLUE, Self::VERMILION, Self::GREEN, Self::PURPLE, Self::ORANGE, Self::SKY, Self::BLACK];

    /// The palette's colour number `index`, round and round.
    #[must_use]
    pub fn cycle(index: usize) -> Self {
        Self::PALETTE[index % Self::PALETTE.len()]
    }

    pub(super) fn mix(self, other: Self, share: f64) -> Self {
        let mix = |a: u8, b: u8| (f64::from(a) + share * (f64::from(b) - f64::from(a))).round() as u8;
        Self(mix(self.0, other.0), mix(self.1, other.1), mix(self.2, other.2))
    }
}

/// Viridis (Nuñez et al. 2018, DOI 10.1371/journal.pone.0199239) at equal steps, low to high.
const VIRIDIS: [Color; 8] = [
    Color(68, 1, 84),
    Color(70, 50, 127),
    Color(54, 92, 141),
    Color(39, 127, 143),
    Color(31, 162, 136),
    Color(74, 194, 110),
    Color(160, 219, 57),
    Color(254, 232, 37),
];

/// How a heat map turns a value into a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ColorMap {
    /// Viridis: dark is low, bright is high.
    #[default]
    Viridis,
    /// Blue below the middle of the range, white at it, vermilion above; the automatic range is symmetric about zero.
    Diverging,
}

impl ColorMap {
    /// The colour at a share of the range from 0 to 1.
    pub(super) fn at(self, share: f64) -> Color {
        let share = share.clamp(0.0, 1.0);
        match self {
            Self::Viridis => {
                let at = share * (VIRIDIS.len() - 1) as f64;
                let low = (at as usize).min(VIRIDIS.len() - 2);
                VIRIDIS[low].mix(VIRIDIS[low + 1], at - low as f64)
            }
            Self::Diverging => {
                let end = if share < 0.5 { Color::BLUE } else { Color::VERMILION };
                Color(247, 247, 247).mix(end, (2.0 * share - 1.0).abs())
            }
        }
    }
}
