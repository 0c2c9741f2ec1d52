//! The flags that make a wall law: every key of the text form in kebab-case, over a law from a file if one is named.

mod wording;

use crate::failure::Failure;
use crate::motion::one_wanted;
use crate::output;
use crate::text::scaled;
use crate::uncertain::{Distribution, Given};
use crate::values;
use carom::material::{Library, MaterialRef};
use carom::resolved::AdhesionMode;
use carom::roughness::RoughnessModel;
use carom::spec::{At, CurveSpec, LawSpec, NormalKind, NormalSpec, TangentialKind, parse_named_law};
use carom::units::{Angle, InverseSpeed, Length, Number, Pressure, Speed, SurfaceEnergy};
use carom::{SpecError, WallLaw};
use std::path::{Path, PathBuf};

/// Material files.
#[derive(clap::Args, Clone, Debug, Default)]
pub struct MaterialsArgs {
    /// File with [material.NAME] tables to add to the library (repeatable)
    #[arg(long, value_name = "FILE", help_heading = "Materials")]
    pub materials: Vec<PathBuf>,
}

impl MaterialsArgs {
    /// The library with the user's materials added.
    pub fn library(&self) -> Result<Library, Failure> {
        let mut library = Library::builtin().clone();
        for path in &self.materials {
            let text = output::read(path)?;
            library.extend_from_toml(&text).map_err(|e| Failure::in_file(e, &path.display().to_string(), &text))?;
        }
        Ok(library)
    }
}

/// The flags of a wall law.
#[derive(clap::Args, Clone, Debug, Default)]
pub struct LawArgs {
    /// Sphere: a material's name (see `carom materials`) or rho=8000,E=190GPa,nu=0.27,gamma=1.62,sigma=310MPa
    #[arg(long, value_name = "MATERIAL", help_heading = "Materials", value_parser = values::material)]
    sphere: Option<MaterialRef>,
    /// Surface: likewise
    #[arg(long, value_name = "MATERIAL", help_heading = "Materials", value_parser = values::material)]
    surface: Option<MaterialRef>,
    #[command(flatten)]
    pub materials: MaterialsArgs,

    /// Read the law from the table [law.NAME] of a TOML file; flags given besides override its keys
    #[arg(long, value_name = "FILE:NAME", help_heading = "Normal law", value_parser = values::law_place)]
    wall_law: Option<(PathBuf, String)>,
    /// ea, eap, thornton-ning, tabor, constant, by-angle or resolved; or losses, separated by commas:
    /// adhesion-work, adhesion-damping, hertz-damping, adhesion-jkr, plastic-kadomtsev, plastic-thornton-ning,
    /// plastic-tabor, plastic-bons [default: ea]
    #[arg(long, value_name = "LAW", help_heading = "Normal law", value_parser = values::normal_law)]
    law: Option<NormalSpec>,
    /// Restitution of the constant law, or a curve for by-angle: grant-tabakoff, or '{ polynomial = [...] }'
    #[arg(long, value_name = "E", help_heading = "Normal law", value_parser = values::restitution)]
    restitution: Option<CurveSpec>,
    /// Damping of the adhesion force, C_A, s/m
    #[arg(long, value_name = "C_A", help_heading = "Normal law", value_parser = values::damping)]
    adhesion_damping: Option<Given>,
    /// Damping of the Hertz force, C_H, s/m
    #[arg(long, value_name = "C_H", help_heading = "Normal law", value_parser = values::damping)]
    hertz_damping: Option<Given>,
    /// Resolved law: adhesion acts separation-only or is reversible [default: separation-only]
    #[arg(long, value_name = "MODE", help_heading = "Normal law")]
    adhesion: Option<AdhesionMode>,
    /// Tabor's fitted yield velocity, m/s
    #[arg(long, value_name = "SPEED", help_heading = "Normal law")]
    yield_velocity: Option<Speed>,
    /// Meyer's index n of Tabor's law
    #[arg(long, value_name = "N", help_heading = "Normal law")]
    meyer_index: Option<Number>,
    /// Thornton-Ning's limiting contact pressure, Pa [default: from the yield strength]
    #[arg(long, value_name = "PRESSURE", help_heading = "Normal law")]
    limiting_pressure: Option<Pressure>,

    /// rolling, walton, constant or by-angle [default: rolling]
    #[arg(long, value_name = "LAW", help_heading = "Tangential law")]
    tangential: Option<TangentialKind>,
    /// Coulomb friction coefficient; needed where the impact is oblique or spins
    #[arg(long, value_name = "F", help_heading = "Tangential law", value_parser = values::friction)]
    friction: Option<Given>,
    /// Walton's beta, from 0 (rolling) to 1 (the slip is reversed)
    #[arg(long, value_name = "BETA", help_heading = "Tangential law")]
    walton_beta: Option<Number>,
    /// Tangential restitution, or a curve by angle such as grant-tabakoff
    #[arg(long, value_name = "E_T", help_heading = "Tangential law", value_parser = values::tangential_restitution)]
    tangential_restitution: Option<CurveSpec>,

    /// Factor C_R on the adhesion force, above 0 and up to 1 [default: 1]
    #[arg(long, value_name = "C_R", help_heading = "Surfaces", conflicts_with = "roughness", value_parser = values::roughness_factor)]
    roughness_factor: Option<Given>,
    /// Standard deviation of the heights, from which C_R follows
    #[arg(long, value_name = "LENGTH", help_heading = "Surfaces", value_parser = values::roughness)]
    roughness: Option<Given>,
    /// How C_R follows from the roughness: rabinovich or fuller-tabor [default: rabinovich]
    #[arg(long, value_name = "MODEL", help_heading = "Surfaces")]
    roughness_model: Option<RoughnessModel>,
    /// Radius of the asperities, for fuller-tabor
    #[arg(long, value_name = "LENGTH", help_heading = "Surfaces")]
    asperity_radius: Option<Length>,
    /// Standard deviation of the wall's roughness angle, degrees: each impact meets a facet tilted by a random angle; where no samples
    /// are drawn, the median facet
    #[arg(long, value_name = "DEG", help_heading = "Surfaces", value_parser = values::roughness_angle)]
    roughness_angle: Option<Angle>,
    /// Radius of curvature of the surface: inf is flat, negative is concave [default: inf]
    #[arg(long, value_name = "LENGTH", help_heading = "Surfaces", value_parser = values::curvature)]
    surface_curvature: Option<carom::spec::CurvatureRadius>,
    /// Interfacial parameter of the work of adhesion [default: 1]
    #[arg(long, value_name = "PHI", help_heading = "Surfaces")]
    interfacial_parameter: Option<Number>,
    /// Equilibrium spacing z0 of the surfaces
    #[arg(long, value_name = "LENGTH", help_heading = "Surfaces")]
    equilibrium_spacing: Option<Length>,

    /// Work of adhesion w, J/m2
    #[arg(long, value_name = "W", help_heading = "Instead of what the materials give", value_parser = values::work_of_adhesion)]
    work_of_adhesion: Option<Given>,
    /// Hertzian stiffness K, Pa
    #[arg(long, value_name = "K", help_heading = "Instead of what the materials give")]
    stiffness: Option<Pressure>,
    /// Plastic constant k, Pa
    #[arg(long, value_name = "K_P", help_heading = "Instead of what the materials give")]
    plastic_constant: Option<Pressure>,
}

/// A flag that may be a distribution.
struct Uncertain {
    flag: &'static str,
    get: fn(&LawArgs) -> Option<&Given>,
    set: fn(&mut LawSpec, f64),
}

macro_rules! uncertain {
    ($($flag:literal $key:ident $type:ident),* $(,)?) => {
        [$(Uncertain { flag: $flag, get: |a| a.$key.as_ref(), set: |s, v| s.$key = Some($type(v).into()) }),*]
    };
}

/// Their places number the draws, after the diameter's: to add a distribution changes no other.
const UNCERTAIN: [Uncertain; 6] = uncertain![
    "roughness-factor" roughness_factor Number,
    "roughness" roughness Length,
    "work-of-adhesion" work_of_adhesion SurfaceEnergy,
    "friction" friction Number,
    "adhesion-damping" adhesion_damping InverseSpeed,
    "hertz-damping" hertz_damping InverseSpeed,
];

/// The laws that flags make, some of which may be distributions.
pub struct Population<'a> {
    args: &'a LawArgs,
    library: Library,
    spec: LawSpec,
    source: Option<Source>,
    has_friction: bool,
}

impl Population<'_> {
    /// The law with every distribution at its median.
    pub fn middle(&self) -> Result<Law, Failure> {
        let spec = self.spec(|_| 0.5);
        Ok(Law { wall: self.compile(&spec)?, spec, has_friction: self.has_friction })
    }

    /// The law where a flag's distribution, by its number from 1 on, is at the probability `draw` gives.
    pub fn law(&self, draw: impl Fn(u32) -> f64) -> Result<WallLaw, Failure> {
        self.compile(&self.spec(draw))
    }

    fn spec(&self, draw: impl Fn(u32) -> f64) -> LawSpec {
        let mut spec = self.spec.clone();
        for (number, flag) in (1..).zip(&UNCERTAIN) {
            if let Some(distribution) = (flag.get)(self.args).and_then(Given::distribution) {
                (flag.set)(&mut spec, distribution.quantile(draw(number)));
            }
        }
        spec
    }

    fn compile(&self, spec: &LawSpec) -> Result<WallLaw, Failure> {
        spec.compile(&self.library).map_err(|e| self.args.explain(e, self.source.as_ref()))
    }
}

/// A law ready to answer, and what the command says about it.
pub struct Law {
    /// The compiled law.
    pub wall: WallLaw,
    /// As written, file and flags together.
    pub spec: LawSpec,
    /// Was a friction coefficient given?
    pub has_friction: bool,
}

/// The file a law came from: its name and text.
type Source = (String, String);

impl LawArgs {
    /// The law of the file, if any, under the flags.
    fn spec(&self) -> Result<(LawSpec, Option<Source>), Failure> {
        let (mut spec, source) = match &self.wall_law {
            Some((path, name)) => from_file(path, name)?,
            None => (LawSpec { normal: Some(NormalSpec::Named(NormalKind::Ea).into()), ..LawSpec::default() }, None),
        };
        // each of the two says what C_R is, so a flag for one puts the file's other aside
        if self.roughness_factor.is_some() {
            (spec.roughness, spec.roughness_model, spec.asperity_radius) = (None, None, None);
        }
        if self.roughness.is_some() {
            spec.roughness_factor = None;
        }
        macro_rules! put {
            ($($key:ident = $flag:ident),* $(,)?) => {$(
                if let Some(value) = &self.$flag {
                    spec.$key = Some(At::from(value.clone()));
                }
            )*};
        }
        put! {
            sphere = sphere, surface = surface, normal = law, restitution = restitution, adhesion = adhesion, yield_velocity = yield_velocity, meyer_index = meyer_index,
            limiting_pressure = limiting_pressure, tangential = tangential, walton_beta = walton_beta,
            tangential_restitution = tangential_restitution, roughness_angle = roughness_angle,
            roughness_model = roughness_model, asperity_radius = asperity_radius,
            surface_curvature = surface_curvature, interfacial_parameter = interfacial_parameter,
            equilibrium_spacing = equilibrium_spacing, stiffness = stiffness,
            plastic_constant = plastic_constant,
        }
        for flag in &UNCERTAIN {
            if let Some(value) = (flag.get)(self).and_then(Given::one) {
                (flag.set)(&mut spec, value);
            }
        }
        for (body, material) in [("sphere", &mut spec.sphere), ("surface", &mut spec.surface)] {
            if let Some(At { value: MaterialRef::Inline(inline), .. }) = material {
                inline.name = format!("given {body}");
            }
        }
        Ok((spec, source))
    }

    /// Compiles the law. Where nothing is `oblique`, friction does nothing and need not be given.
    pub fn compile(&self, oblique: bool) -> Result<Law, Failure> {
        self.compile_with(oblique, &self.materials.library()?, |_| ())
    }

    /// As [`LawArgs::compile`], with what `complete` adds to the law before.
    pub fn compile_with(
        &self,
        oblique: bool,
        library: &Library,
        complete: impl FnOnce(&mut LawSpec),
    ) -> Result<Law, Failure> {
        match self.drawn().next() {
            Some((flag, distribution)) => Err(one_wanted(flag, distribution)),
            None => self.population_with(oblique, library.clone(), complete)?.middle(),
        }
    }

    /// The flags that are distributions.
    pub fn drawn(&self) -> impl Iterator<Item = (&'static str, &Distribution)> {
        UNCERTAIN.iter().filter_map(|u| Some((u.flag, (u.get)(self)?.distribution()?)))
    }

    /// All the laws there may be.
    pub fn population(&self, oblique: bool) -> Result<Population<'_>, Failure> {
        self.population_with(oblique, self.materials.library()?, |_| ())
    }

    fn population_with(
        &self,
        oblique: bool,
        library: Library,
        complete: impl FnOnce(&mut LawSpec),
    ) -> Result<Population<'_>, Failure> {
        let (mut spec, source) = self.spec()?;
        complete(&mut spec);
        for (flag, given) in [("--sphere", &self.sphere), ("--surface", &self.surface)] {
            if let Some(material) = given {
                material.resolve(&library).map_err(|e| Failure::input(format!("{flag}: {e}")))?;
            }
        }
        let has_friction = spec.friction.is_some() || self.friction.is_some();
        if !oblique && !spec.scatters() && !has_friction {
            spec.friction = Some(Number(0.0).into());
        }
        Ok(Population { args: self, library, spec, source, has_friction })
    }

    /// Name of the law in its file, if it comes from one.
    pub fn name(&self) -> Option<&str> {
        self.wall_law.as_ref().map(|(_, name)| name.as_str())
    }

    /// Is any law given, by flags or a file?
    pub fn is_given(&self) -> bool {
        self.wall_law.is_some() || self.sphere.is_some() || self.surface.is_some() || self.law.is_some()
    }

    /// An error in the words of whoever made it: at its place in the file, or with flags for keys.
    fn explain(&self, error: SpecError, source: Option<&Source>) -> Failure {
        match source {
            Some((name, text)) if error.span.is_some() => Failure::in_file(error, name, text),
            Some((name, _)) => Failure::input(format!("{name}: {}", wording::as_flags(&error))),
            None => Failure::input(wording::as_flags(&error)),
        }
    }
}

fn from_file(path: &Path, name: &str) -> Result<(LawSpec, Option<Source>), Failure> {
    let text = output::read(path)?;
    let file = path.display().to_string();
    let spec = parse_named_law(&text, name).map_err(|e| Failure::in_file(e, &file, &text))?;
    Ok((spec, Some((file, text))))
}

impl Law {
    /// The law in a few words: `copper on aluminium, ea`.
    pub fn description(&self) -> String {
        self.materials().into_iter().chain([self.normal_name()]).collect::<Vec<_>>().join(", ")
    }

    /// With the diameter, as a heading: `90 um copper on aluminium, ea`.
    pub fn heading(&self, diameter: f64) -> String {
        let materials = self.materials().unwrap_or_else(|| "sphere".to_owned());
        format!("{} {materials}, {}", scaled(diameter, "m"), self.normal_name())
    }

    /// `copper on aluminium`, if the law has materials.
    pub fn materials(&self) -> Option<String> {
        Some(format!("{} on {}", self.sphere()?, self.surface()?))
    }

    /// The sphere's material.
    pub fn sphere(&self) -> Option<String> {
        self.wall.pair().map(|p| p.sphere().name.clone())
    }

    /// The surface's material.
    pub fn surface(&self) -> Option<String> {
        self.wall.pair().map(|p| p.surface().name.clone())
    }

    /// The normal law's name, or its losses.
    pub fn normal_name(&self) -> String {
        match self.spec.normal.as_ref().map(|n| &n.value) {
            Some(NormalSpec::Named(kind)) => kind.name().to_owned(),
            Some(NormalSpec::Losses(losses)) => losses.iter().map(|l| l.name()).collect::<Vec<_>>().join(" + "),
            None => String::new(),
        }
    }
}
