//! What to mind about a result: short codes, each a doubt about the model's range.

/// A set of codes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Validity(u32);

/// Codes, their bits and their meaning.
pub const CODES: [(&str, Validity, &str); 11] = [
    (
        "no-rebound-window",
        Validity::NO_REBOUND_WINDOW,
        "adhesion, damping and plastic loss together leave no speed at which this sphere rebounds",
    ),
    (
        "damping-exhausted",
        Validity::DAMPING_EXHAUSTED,
        "the speed is above the window of rebound: damping alone takes all the energy, which ends the model's domain and is not adhesion",
    ),
    (
        "large-contact",
        Validity::LARGE_CONTACT,
        "the greatest contact radius exceeds a third of the sphere's radius (the paper's own limit, 25 m/s for its steel, is 0.34): no longer small, as the contact models assume",
    ),
    (
        "losses-overlap",
        Validity::LOSSES_OVERLAP,
        "damping fitted on elastic contacts is added to a plastic loss above yield: part of the energy may be counted twice",
    ),
    (
        "roughness-extrapolated",
        Validity::ROUGHNESS_EXTRAPOLATED,
        "C_R comes from a roughness above 0.5 nm, the curve's one calibration point",
    ),
    (
        "repelling-adhesion",
        Validity::REPELLING_ADHESION,
        "C_A v > 1: reversible, damped adhesion would repel on approach",
    ),
    ("pulling-hertz", Validity::PULLING_HERTZ, "C_H v > 1: the damped Hertz force would pull on separation"),
    (
        "plastic-exhausted",
        Validity::PLASTIC_EXHAUSTED,
        "the speed is above the window of rebound: Bons' plastic loss, e ~ 1/v, leaves less than the other losses take, and the sphere is captured again",
    ),
    (
        "above-yield",
        Validity::ABOVE_YIELD,
        "the law has no plastic loss, and the speed is above the yield velocity that the strength of its materials gives (bulk and static where it comes from a table): unless damping fitted to measurements stands for it, e is too high, and eap gives less",
    ),
    (
        "grazing-capture",
        Validity::GRAZING_CAPTURE,
        "captured by its normal speed, though its energy along the wall is more than ten times what adhesion can hold: it may slide or roll on, or leave",
    ),
    (
        "adhesive-contact-large",
        Validity::ADHESIVE_CONTACT_LARGE,
        "adhesion alone, without load, makes a contact wider than 0.3 of the sphere's radius: no longer small, as the contact models assume, and the capture velocity is not to be trusted",
    ),
];

/// As the list of its codes.
#[cfg(feature = "serde")]
impl serde::Serialize for Validity {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.codes())
    }
}

impl Validity {
    /// Nothing to mind.
    pub const NONE: Self = Self(0);
    /// `no-rebound-window`
    pub const NO_REBOUND_WINDOW: Self = Self(1);
    /// `damping-exhausted`
    pub const DAMPING_EXHAUSTED: Self = Self(2);
    /// `large-contact`
    pub const LARGE_CONTACT: Self = Self(4);
    /// `losses-overlap`
    pub const LOSSES_OVERLAP: Self = Self(8);
    /// `roughness-extrapolated`
    pub const ROUGHNESS_EXTRAPOLATED: Self = Self(16);
    /// `repelling-adhesion` (resolved law)
    pub const REPELLING_ADHESION: Self = Self(32);
    /// `pulling-hertz` (resolved law)
    pub const PULLING_HERTZ: Self = Self(64);
    /// `plastic-exhausted` (Bons' plastic loss)
    pub const PLASTIC_EXHAUSTED: Self = Self(128);
    /// `above-yield` (laws without a plastic loss)
    pub const ABOVE_YIELD: Self = Self(256);
    /// `grazing-capture`
    pub const GRAZING_CAPTURE: Self = Self(512);
    /// `adhesive-contact-large`
    pub const ADHESIVE_CONTACT_LARGE: Self = Self(1024);

    /// Both sets.
    #[must_use]
    #[inline(always)]
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// This set if `condition`, else nothing.
    #[must_use]
    #[inline(always)]
    pub const fn when(self, condition: bool) -> Self {
        if condition { self } else { Self::NONE }
    }

    /// Is every code of `other` set?
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Nothing to mind?
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The bits, as the C interface hands them out.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// The codes, in a fixed order.
    pub fn codes(self) -> impl Iterator<Item = &'static str> {
        CODES.iter().filter(move |(_, v, _)| self.contains(*v)).map(|(code, _, _)| *code)
    }
}
