//! Removal: the friction velocities at which a flow rolls, slides or lifts a captured sphere off again.
//!
//! The sphere sits on the wall in the linear profile u(y) = u_τ² y/ν next to it, held by the pair's adhesion:
//!
//! | what | equation | source |
//! |---|---|---|
//! | pull-off force | F_po = (3/2)πw r C_R | Johnson, Kendall & Roberts 1971, <https://doi.org/10.1098/rspa.1971.0141> |
//! | contact radius, unloaded | a₀ = (4 r F_po/K)^{1/3} | the same |
//! | adhesion's greatest moment | M = max P a(P) = (15/16)(5/4)^{2/3} F_po (r F_po/K)^{1/3} = 0.685 F_po a₀ | Ziskind, Fichman & Gutfinger 1997, <https://doi.org/10.1016/S0021-8502(96)00460-0> |
//! | drag | F_D = 1.7009 · 3πμd u(d/2) = 8.015 ρ d² u_τ² | O'Neill 1968, <https://doi.org/10.1016/0009-2509(68)89039-6> |
//! | torque on the sphere | T = 0.944 · 4πμ(d/2)³ u_τ²/ν = 1.483 ρ d³ u_τ² | the same |
//! | lift, d⁺ < 1.40 | F_L = 9.22 ρ (u_τ²/ν)² (d/2)⁴ = 0.576 ρν² d⁺⁴ | Leighton & Acrivos 1985, <https://doi.org/10.1007/BF00949042> |
//! | lift beyond | F_L = 1.615 μd² (u_τ²/ν²)^{1/2} u(d/2) = 0.8075 ρν² d⁺³ | Saffman 1965, <https://doi.org/10.1017/S0022112065000824> |
//!
//! with d⁺ = u_τ d/ν. It **rolls** where F_D d/2 + T = M (the moment of lift, a ≪ d, is left out), **slides** where
//! F_D = f (F_po − F_L), and is **lifted** where F_L = F_po; these are the criteria of Soltani & Ahmadi (1994, J. Adhes. Sci. Technol. 8,
//! 763–785), whose moment F_po a₀ is that of a contact which does not shrink as it is pulled: 1.46 times larger, so their rolling
//! velocity is 1.21 times the one here. Smooth spheres roll first.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | u_τ | friction velocity, √(wall shear stress/ρ) | m/s |
//! | ρ, μ, ν = μ/ρ | the fluid's density, viscosities | kg/m³, Pa s, m²/s |
//! | d, r | sphere diameter, effective radius | m |
//! | w, K, C_R, f | work of adhesion, stiffness, roughness factor, friction coefficient | J/m², Pa, –, – |
//!
//! Range: JKR contacts (μ_T above 5; a DMT contact pulls with 2πw r); creeping flow about the sphere, d⁺ below about 1.4, and in any
//! case inside the viscous sublayer, d⁺ below 5: beyond, the drag at finite Reynolds number is larger and the linear profile too fast,
//! and the figures are an extrapolation ([`Criterion::in_sublayer`]). The two lifts cross at d⁺ = 1.40; taking the smaller keeps each to
//! its side. Steady flow: bursts of turbulence exceed the mean shear. Gravity is left out.
//!
//! ```
//! use carom::{material::Library, removal::Fluid, spec::parse_law};
//! let law = parse_law("sphere = \"copper\"\nsurface = \"silicon\"\nnormal = \"ea\"\nfriction = 0.2\nroughness_factor = 0.1\n")?;
//! let wall = law.compile(Library::builtin())?;
//! let air = Fluid { density: 1.19, viscosity: 1.83e-5 };
//! let removal = wall.removal(50e-6, &air).expect("in range").expect("it adheres");
//! let sliding = removal.sliding.expect("the law has friction");
//! assert!(removal.rolling.friction_velocity < sliding.friction_velocity);
//! # Ok::<(), carom::LawError>(())
//! ```

use crate::impact::ImpactError;
#[cfg(not(feature = "std"))]
use crate::math::Plainly as _;
use crate::math::cbrt;
use crate::wall::WallLaw;
use core::f64::consts::PI;

/// Drag near the wall over Stokes' (O'Neill 1968).
pub const DRAG_AT_WALL: f64 = 1.7009;
/// Torque at the wall over 4πμR³ times the shear rate (O'Neill 1968).
pub const TORQUE_AT_WALL: f64 = 0.944;

/// The fluid over the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluid {
    /// Density, kg/m³.
    pub density: f64,
    /// Dynamic viscosity, Pa s.
    pub viscosity: f64,
}

impl Fluid {
    /// The lift (N) on a sphere of a diameter (m) that touches the wall at rest, at a friction velocity (m/s).
    pub fn lift_at_wall(&self, diameter: f64, friction_velocity: f64) -> f64 {
        let nu = self.viscosity / self.density;
        self.density * nu * nu * lift(friction_velocity * diameter / nu)
    }
}

/// F_L/(ρν²) at d⁺: the smaller of the two lifts.
fn lift(wall_units: f64) -> f64 {
    (wall_units * wall_units * wall_units) * (LIFT_TOUCHING * wall_units).min(LIFT_SAFFMAN)
}

/// A sphere held on a wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attached {
    /// Diameter, m.
    pub diameter: f64,
    /// Effective radius r, m.
    pub effective_radius: f64,
    /// Work of adhesion times roughness factor, w C_R, J/m².
    pub work_of_adhesion: f64,
    /// Hertzian stiffness K, Pa.
    pub stiffness: f64,
    /// Coulomb friction coefficient f, if there is one.
    pub friction: Option<f64>,
}

/// When a mode of removal sets in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Criterion {
    /// Critical friction velocity u_τ, m/s.
    pub friction_velocity: f64,
    /// d⁺ = u_τ d/ν there.
    pub wall_units: f64,
}

impl Criterion {
    /// Is the sphere inside the viscous sublayer, d⁺ < 5, as the forces assume?
    pub fn in_sublayer(&self) -> bool {
        self.wall_units < 5.0
    }
}

/// What holds a sphere, and the friction velocities that remove it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Removal {
    /// Pull-off force, N.
    pub pull_off_force: f64,
    /// Contact radius of the unloaded sphere, m.
    pub contact_radius: f64,
    /// Greatest moment that adhesion bears, N m.
    pub adhesion_moment: f64,
    /// Rolling.
    pub rolling: Criterion,
    /// Sliding; `None` without a friction coefficient.
    pub sliding: Option<Criterion>,
    /// Lifting.
    pub lifting: Criterion,
}

/// A way in which a sphere leaves its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// It rolls about the rim of its contact.
    Rolling,
    /// It slides on its contact.
    Sliding,
    /// It is lifted.
    Lifting,
}

impl Mode {
    /// All of them, in the order of the results.
    pub const ALL: [Self; 3] = [Self::Rolling, Self::Sliding, Self::Lifting];

    /// The word in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rolling => "rolling",
            Self::Sliding => "sliding",
            Self::Lifting => "lifting",
        }
    }
}

impl Removal {
    /// When a mode sets in; `None` for sliding without a friction coefficient.
    pub fn of(&self, mode: Mode) -> Option<Criterion> {
        match mode {
            Mode::Rolling => Some(self.rolling),
            Mode::Sliding => self.sliding,
            Mode::Lifting => Some(self.lifting),
        }
    }

    /// The mode that removes the sphere at a friction velocity (m/s): of those that are allowed, the one that sets in first, if the
    /// flow is faster than that.
    pub fn mode(&self, allowed: impl IntoIterator<Item = Mode>, friction_velocity: f64) -> Option<Mode> {
        let onsets = allowed.into_iter().filter_map(|m| self.of(m).map(|c| (m, c.friction_velocity)));
        let first = onsets.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (friction_velocity > first.1).then_some(first.0)
    }
}

impl Attached {
    /// Pull-off force, N.
    pub fn pull_off_force(&self) -> f64 {
        1.5 * PI * self.work_of_adhesion * self.effective_radius
    }

    /// Contact radius without a load, m.
    pub fn contact_radius(&self) -> f64 {
        cbrt(4.0 * self.effective_radius * self.pull_off_force() / self.stiffness)
    }

    /// The greatest moment that adhesion bears, N m. Under a pull P = pF_po the contact radius is (r F_po/K)^{1/3} (1 + √(1 − p))^{2/3},
    /// and P a is greatest at p = 15/16.
    pub fn adhesion_moment(&self) -> f64 {
        let force = self.pull_off_force();
        15.0 / 16.0 * cbrt(1.25 * 1.25) * force * cbrt(self.effective_radius * force / self.stiffness)
    }

    /// The friction velocities that remove it.
    pub fn removal(&self, fluid: &Fluid) -> Removal {
        let d = self.diameter;
        let nu = fluid.viscosity / fluid.density;
        // forces in units of ρν², lengths in d: the friction velocity is d⁺
        let unit = fluid.density * nu * nu;
        let (force, moment) = (self.pull_off_force() / unit, self.adhesion_moment() / (unit * d));
        let criterion = |wall_units: f64| Criterion { friction_velocity: wall_units * nu / d, wall_units };
        Removal {
            pull_off_force: self.pull_off_force(),
            contact_radius: self.contact_radius(),
            adhesion_moment: self.adhesion_moment(),
            rolling: criterion((moment / (0.5 * DRAG + TORQUE)).sqrt()),
            sliding: self.friction.map(|f| criterion(sliding(f, force))),
            lifting: criterion((force / LIFT_TOUCHING).sqrt().sqrt().max(cbrt(force / LIFT_SAFFMAN))),
        }
    }
}

/// F_D/(ρν² d⁺²): 1.7009 · 3π/2.
const DRAG: f64 = DRAG_AT_WALL * 1.5 * PI;
/// T/(ρν² d d⁺²): 0.944 · π/2.
const TORQUE: f64 = TORQUE_AT_WALL * 0.5 * PI;
/// Leighton & Acrivos: F_L/(ρν² d⁺⁴) = 9.22/16.
const LIFT_TOUCHING: f64 = 9.22 / 16.0;
/// Saffman: F_L/(ρν² d⁺³) = 1.615/2.
const LIFT_SAFFMAN: f64 = 1.615 / 2.0;

/// d⁺ where drag + f · lift = f · pull-off, all in ρν²: the left side rises, so by bisection.
fn sliding(friction: f64, force: f64) -> f64 {
    let excess = |x: f64| DRAG * (x * x) + friction * (lift(x) - force);
    let (mut low, mut high) = (0.0, (friction * force / DRAG).sqrt());
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

impl WallLaw {
    /// What holds a captured sphere of `diameter` (m) to this wall and the friction velocities that remove it: see
    /// [`crate::removal`]. `Ok(None)` for a law whose pair gives no adhesion or no stiffness.
    ///
    /// # Errors
    /// A diameter out of range.
    pub fn removal(&self, diameter: f64, fluid: &Fluid) -> Result<Option<Removal>, ImpactError> {
        let size = self.size(diameter, None)?;
        let Some(pair) = self.pair() else { return Ok(None) };
        let (Ok(w), Ok(stiffness)) = (pair.work_of_adhesion(), pair.stiffness()) else { return Ok(None) };
        let attached = Attached {
            diameter,
            effective_radius: size.radius * size.kappa,
            work_of_adhesion: w * self.roughness_factor(),
            stiffness,
            friction: self.tangential().friction(),
        };
        Ok((attached.work_of_adhesion > 0.0).then(|| attached.removal(fluid)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AIR: Fluid = Fluid { density: 1.19, viscosity: 1.83e-5 };

    /// 20 µm, w = 0.1 J/m², C_R = 0.5, E* = 50 GPa, f = 0.3, flat.
    fn attached() -> Attached {
        Attached {
            diameter: 20e-6,
            effective_radius: 10e-6,
            work_of_adhesion: 0.05,
            stiffness: 200e9 / 3.0,
            friction: Some(0.3),
        }
    }

    fn close(got: f64, expected: f64, relative: f64) {
        assert!((got / expected - 1.0).abs() < relative, "{got}, expected {expected}");
    }

    /// By hand: F_po = 1.5π · 0.05 · 1e-5; a₀³ = 4 · 1e-5 · 2.3562e-6/6.6667e10 = 1.41372e-21; M by a search over the pull; the
    /// velocities by bisection of the dimensional balances of the table, each force written out.
    #[test]
    fn hand_worked_numbers() {
        let removal = attached().removal(&AIR);
        close(removal.pull_off_force, 2.356194490192345e-6, 1e-13);
        close(removal.contact_radius, 1.1223305780454746e-7, 1e-13);
        close(removal.adhesion_moment, 1.8122713280846667e-13, 1e-9);
        close(removal.rolling.friction_velocity, 1.862035095701783, 1e-9);
        close(removal.rolling.wall_units, 2.4216631299290947, 1e-9);
        close(removal.sliding.expect("friction").friction_velocity, 11.322917811044283, 1e-12);
        close(removal.lifting.friction_velocity, 16.766609966774933, 1e-12);
        assert!(removal.rolling.in_sublayer() && !removal.lifting.in_sublayer());
    }

    #[test]
    fn the_moment_is_the_greatest_along_the_jkr_curve() {
        let a = attached();
        let (force, r, k) = (a.pull_off_force(), a.effective_radius, a.stiffness);
        // JKR: a³ = (r/K)(−P + 2F + √(4F² − 4FP)), P a pull
        let radius = |p: f64| (r / k * (2.0 * force - p + (4.0 * force * (force - p)).sqrt())).cbrt();
        close(radius(0.0), a.contact_radius(), 1e-14);
        let best = (0..=100_000).map(|i| f64::from(i) / 1e5 * force).map(|p| p * radius(p)).fold(0.0, f64::max);
        close(a.adhesion_moment(), best, 1e-9);
        close(a.adhesion_moment() / (force * a.contact_radius()), 0.685, 1e-3);
        // Zhang & Ahmadi's form of it, 2.707 w^{4/3} d^{5/3}/K^{1/3}
        let (w, d) = (a.work_of_adhesion, a.diameter);
        close(a.adhesion_moment(), 2.707 * (w.powi(4) * d.powi(5) / k).cbrt(), 1e-3);
    }

    #[test]
    fn forces_balance_where_it_is_removed() {
        for diameter in [0.2e-6, 2e-6, 20e-6, 200e-6] {
            let a = Attached { diameter, effective_radius: diameter / 2.0, ..attached() };
            let removal = a.removal(&AIR);
            let nu = AIR.viscosity / AIR.density;
            let drag = |u: f64| DRAG_AT_WALL * 3.0 * PI * AIR.viscosity * diameter * (u * u / nu * diameter / 2.0);
            let lift = |u: f64| {
                let shear = u * u / nu;
                let touching = 9.22 * AIR.density * shear * shear * (diameter / 2.0).powi(4);
                let saffman =
                    1.615 * AIR.viscosity * diameter * diameter * (shear / nu).sqrt() * (shear * diameter / 2.0);
                touching.min(saffman)
            };
            close(lift(removal.lifting.friction_velocity), removal.pull_off_force, 1e-12);
            let slides = removal.sliding.expect("friction").friction_velocity;
            close(drag(slides) + 0.3 * lift(slides), 0.3 * removal.pull_off_force, 1e-12);
            let rolls = removal.rolling.friction_velocity;
            let torque = TORQUE_AT_WALL * 4.0 * PI * AIR.viscosity * (diameter / 2.0).powi(3) * (rolls * rolls / nu);
            close(drag(rolls) * diameter / 2.0 + torque, removal.adhesion_moment, 1e-12);
            assert!(rolls < slides && slides < removal.lifting.friction_velocity);
        }
    }

    #[test]
    fn the_first_mode_that_sets_in_removes() {
        let removal = attached().removal(&AIR);
        let mode = |allowed: &[Mode], u: f64| removal.mode(allowed.iter().copied(), u);
        assert_eq!(mode(&Mode::ALL, 1.862), None);
        assert_eq!(mode(&Mode::ALL, 1.8621), Some(Mode::Rolling));
        assert_eq!(mode(&Mode::ALL, 20.0), Some(Mode::Rolling));
        assert_eq!(mode(&[Mode::Lifting], 16.7), None);
        assert_eq!(mode(&[Mode::Sliding, Mode::Lifting], 16.8), Some(Mode::Sliding));
        assert_eq!(Attached { friction: None, ..attached() }.removal(&AIR).mode([Mode::Sliding], 1e9), None);
    }

    #[test]
    fn without_friction_it_slides_at_once_and_the_lifts_join() {
        assert_eq!(Attached { friction: None, ..attached() }.removal(&AIR).sliding, None);
        let free = Attached { friction: Some(0.0), ..attached() }.removal(&AIR).sliding.expect("a coefficient");
        assert_eq!(free.friction_velocity, 0.0);
        let crossing = LIFT_SAFFMAN / LIFT_TOUCHING;
        assert!((crossing - 1.40).abs() < 5e-3);
    }
}
