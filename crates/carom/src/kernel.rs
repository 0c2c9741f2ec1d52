//! The kernel: a wall law as plain numbers, and the one arithmetic that all fronts run.
//!
//! A [`Kernel`] is `Copy`, holds no pointer and no text and takes at most 256 bytes; curves by angle and the shape of a micro-slip law
//! stand beside it in [`Tables`]. It knows nothing of materials, files or units. [`crate::WallLaw`] stands above it and says where the
//! numbers come from.
//!
//! | question | place |
//! |---|---|
//! | One impact in space, reduced to the plane of its slip | `kernel/impact.rs` |
//! | The paper's two laws, in code of their own | `kernel/short.rs` |
//! | Many impacts in columns | `kernel/columns.rs`, behind [`crate::batch`] |
//! | Walls that scatter: facet after facet | `kernel/rough.rs` |
//! | What is no impact, and what to mind about one | `kernel/judge.rs` |

pub(crate) mod columns;
mod impact;
mod judge;
mod rough;
mod short;

use crate::curvature::Curvature;
use crate::impact::ImpactError;
use crate::math::Fma;
use crate::normal::empirical::Piece;
use crate::normal::{NormalLaw, Size};
use crate::scatter::Scatter;
use crate::tangential::Tangential;
use crate::tangential::micro_slip::Shape;
use crate::validity::Validity;
pub(crate) use judge::{Judged, Limits};

/// A compiled wall law: plain numbers, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    pub(crate) normal: NormalLaw,
    pub(crate) tangential: Tangential,
    /// Density of the law's own sphere, kg/m³; a law that needs none and was given none holds 1000.
    pub(crate) density: f64,
    pub(crate) curvature: Curvature,
    pub(crate) limits: Limits,
    /// Warnings of every impact.
    pub(crate) validity: Validity,
    /// A rough wall's facets; none on a smooth one.
    pub(crate) scatter: Option<Scatter>,
}

const _: () = assert!(size_of::<Kernel>() <= 256, "a kernel fits four cache lines");

/// What a kernel looks up: plain numbers too, borrowed for each call.
#[derive(Clone, Copy, Debug)]
pub struct Tables<'a> {
    pub(crate) pieces: &'a [Piece],
    pub(crate) shape: &'a Shape,
}

impl Tables<'_> {
    /// For a law without curves and without micro-slip.
    pub const NONE: Self = Tables { pieces: &[], shape: &Shape::NONE };
}

impl Kernel {
    /// The normal law.
    pub fn normal(&self) -> &NormalLaw {
        &self.normal
    }

    /// The tangential law.
    pub fn tangential(&self) -> &Tangential {
        &self.tangential
    }

    /// The size of an impact of this law's sphere, or of another density (kg/m³); diameter in m.
    ///
    /// # Errors
    /// A diameter, density or curvature out of range.
    #[inline(always)]
    pub fn size<F: Fma>(&self, f: F, diameter: f64, density: Option<f64>) -> Result<Size, ImpactError> {
        if !(1e-10..=1.0).contains(&diameter) {
            return Err(ImpactError::Diameter);
        }
        let radius = 0.5 * diameter;
        let mut size = Size::flat(radius);
        if let Some(density) = density {
            size.density_ratio = density / self.density;
            if !(1e-3..=1e3).contains(&size.density_ratio) {
                return Err(ImpactError::Density);
            }
        }
        if !self.curvature.is_flat() {
            size.kappa = self.curvature.kappa(f, radius);
            if !(size.kappa > 1e-3 && size.kappa < 1e3) {
                return Err(ImpactError::Curvature);
            }
        }
        Ok(size)
    }
}
