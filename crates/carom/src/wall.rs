//! A wall law: materials and text above, a kernel of plain numbers below. An impact in, an outcome out.

use crate::curvature::Curvature;
use crate::impact::{Impact, ImpactError, Outcome};
use crate::kernel::{Judged, Kernel, Limits, Tables};
use crate::math::{BEST, Fma};
use crate::normal::empirical::{Curve, Piece};
use crate::normal::{NormalLaw, Size};
use crate::pair::Pair;
use crate::scatter::Scatter;
use crate::tangential::Tangential;
use crate::tangential::micro_slip::Shape;
use crate::validity::Validity;
use alloc::boxed::Box;
use alloc::vec::Vec;

mod above_yield;
mod figures;

pub use above_yield::AboveYield;

/// A wall law, compiled from a [`crate::spec::LawSpec`]. Pure: no state, no allocation per impact, no panics; usable from
/// many threads.
#[derive(Clone, Debug)]
pub struct WallLaw {
    kernel: Kernel,
    pieces: Box<[Piece]>,
    shape: Option<Box<Shape>>,
    about: About,
}

/// What a law says of itself beside its numbers.
#[derive(Clone, Debug)]
pub(crate) struct About {
    pub pair: Option<Pair>,
    /// σ_r, if given, m.
    pub roughness: Option<f64>,
    /// β, where Fuller & Tabor's C_R is in force, m.
    pub asperity_radius: Option<f64>,
    /// C_R in force.
    pub roughness_factor: f64,
    /// z₀, m.
    pub spacing: f64,
}

/// The parts of a law, each compiled.
pub(crate) struct Parts {
    pub normal: Normal,
    pub tangential: Along,
    pub curvature: Curvature,
    pub scatter: Option<Scatter>,
    /// Warnings of every impact.
    pub validity: Validity,
    pub about: About,
}

/// The normal law as a part: a curve still has its pieces.
pub(crate) enum Normal {
    Compiled(NormalLaw),
    Curve(Curve),
}

/// The tangential law as a part: with its pieces or its shape.
pub(crate) enum Along {
    Friction {
        friction: f64,
        beta: f64,
    },
    MicroSlip {
        friction: f64,
        stiffness_ratio: f64,
    },
    Curve(Curve),
    /// Enough for impacts without slip.
    NotGiven,
}

impl WallLaw {
    pub(crate) fn new(parts: Parts) -> Self {
        let mut pieces = Vec::new();
        let normal = match parts.normal {
            Normal::Compiled(law) => law,
            Normal::Curve(curve) => NormalLaw::Table(curve.look_up_in(&mut pieces)),
        };
        let (tangential, shape) = match parts.tangential {
            Along::Friction { friction, beta } => (Tangential::Friction { friction, beta }, None),
            Along::MicroSlip { friction, stiffness_ratio } => (
                Tangential::MicroSlip(crate::tangential::micro_slip::PartialSlip::new(friction, stiffness_ratio)),
                Some(Box::new(Shape::new(stiffness_ratio))),
            ),
            Along::Curve(curve) => (Tangential::Restitution(curve.look_up_in(&mut pieces)), None),
            Along::NotGiven => (Tangential::NotGiven, None),
        };
        let pair = parts.about.pair.as_ref();
        let density = pair.and_then(|p| p.density().ok()).unwrap_or(1000.0);
        let roughness_factor = parts.about.roughness_factor;
        let limits = Limits::new(&Judged { normal: &normal, pair, roughness_factor, density });
        let (curvature, validity) = (parts.curvature, parts.validity);
        Self {
            kernel: Kernel { normal, tangential, density, curvature, limits, validity, scatter: parts.scatter },
            pieces: pieces.into(),
            shape,
            about: parts.about,
        }
    }

    /// The same law on a surface of another curvature, in place of the law's own `surface_curvature`.
    ///
    /// ```
    /// use carom::{Impact, curvature::Curvature, material::Library, spec::parse_law};
    /// let law = parse_law("sphere = \"copper\"\nsurface = \"glass\"\nnormal = \"ea\"\n")?.compile(Library::builtin())?;
    /// let head_on = Impact::new(100e-6, [0.0, -0.3, 0.0], [0.0, 1.0, 0.0]);
    /// let e = |curvature| law.clone().curved(curvature).impact(&head_on).expect("it fits").restitution;
    /// assert!((e(Curvature::FLAT) - 0.7410).abs() < 1e-4);
    /// assert!((e(Curvature::cylinder(-0.2e-3)) - 0.7164).abs() < 1e-4); // in a bore of 0.4 mm
    /// assert!((e(Curvature::sphere(-0.2e-3)) - 0.6887).abs() < 1e-4);
    /// # Ok::<(), carom::LawError>(())
    /// ```
    #[must_use]
    pub fn curved(mut self, curvature: Curvature) -> Self {
        self.kernel.curvature = curvature;
        self
    }

    /// The law as plain numbers, for callers that run the arithmetic themselves.
    #[inline(always)]
    pub fn kernel(&self) -> &Kernel {
        &self.kernel
    }

    /// What the kernel looks up.
    #[inline(always)]
    pub fn tables(&self) -> Tables<'_> {
        Tables { pieces: &self.pieces, shape: self.shape.as_deref().unwrap_or(&Shape::NONE) }
    }

    /// The materials' contact constants, if the law has materials.
    pub fn pair(&self) -> Option<&Pair> {
        self.about.pair.as_ref()
    }

    /// The normal law.
    pub fn normal(&self) -> &NormalLaw {
        self.kernel.normal()
    }

    /// The tangential law.
    pub fn tangential(&self) -> &Tangential {
        self.kernel.tangential()
    }

    /// The tangential restitution e_t that the law gives outright at speeds across and along the wall (m/s), as Fluent and OpenFOAM do;
    /// `None` for laws of friction.
    pub fn given_tangential_restitution(&self, v_n: f64, v_t: f64) -> Option<f64> {
        match self.tangential() {
            Tangential::Restitution(curve) => {
                Some(curve.at(crate::math::BEST, self.tables().pieces, v_n, v_t, -1.0, 1.0))
            }
            _ => None,
        }
    }

    /// A rough wall's facets: such a law uses the [`Impact::draws`]. `None` for a smooth wall.
    pub fn scatter(&self) -> Option<&Scatter> {
        self.kernel.scatter.as_ref()
    }

    /// Density of the law's own sphere, kg/m³, used when an impact names none.
    pub fn density(&self) -> f64 {
        self.kernel.density
    }

    /// C_R in force.
    pub fn roughness_factor(&self) -> f64 {
        self.about.roughness_factor
    }

    pub(crate) fn size(&self, diameter: f64, density: Option<f64>) -> Result<Size, ImpactError> {
        self.kernel.size(BEST, diameter, density)
    }

    /// One impact.
    ///
    /// # Errors
    /// A sphere that does not approach, a diameter or density out of range, numbers that are not finite, slip along the wall where the
    /// law was given no friction: the caller's sphere is then as it was.
    ///
    /// ```
    /// use carom::{Impact, Fate, material::Library, spec::LawSpec};
    /// let law: LawSpec = carom::spec::parse_law(r#"
    ///     sphere = "stainless-steel"
    ///     surface = "silicon"
    ///     normal = "ea"
    ///     friction = 0.2
    ///     roughness_factor = 0.15
    /// "#)?;
    /// let wall = law.compile(Library::builtin())?;
    /// let out = wall.impact(&Impact::new(70e-6, [1.0, -1.0, 0.0], [0.0, 1.0, 0.0])).expect("it approaches");
    /// assert_eq!(out.fate, Fate::Rebound);
    /// assert!((out.velocity[1] - 0.9728).abs() < 1e-3);
    /// # Ok::<(), carom::LawError>(())
    /// ```
    #[inline]
    pub fn impact(&self, impact: &Impact) -> Result<Outcome, ImpactError> {
        self.kernel.scalar_impact(&self.tables(), impact)
    }

    /// As [`WallLaw::impact`], compiled into the caller for the caller's own instruction set: the same bits, and the answer need not pass
    /// through memory. With [`crate::math::Fused`] it is fast only where the caller is compiled with fused multiply-add
    /// (`#[target_feature(enable = "fma")]`).
    ///
    /// # Errors
    /// As [`WallLaw::impact`].
    #[doc(hidden)]
    #[inline(always)]
    pub fn impact_on<F: Fma>(&self, f: F, impact: &Impact) -> Result<Outcome, ImpactError> {
        self.kernel.impact(f, &self.tables(), impact)
    }
}
