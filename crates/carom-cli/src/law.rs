//! The flags that make a wall law: one for each key of the registry, over a law from a file if one is named.

mod flags;

pub use flags::{Words, name as flag, number};

use crate::failure::Failure;
use crate::motion::one_wanted;
use crate::output;
use crate::text::scaled;
use crate::values;
use carom::material::{Library, Material};
use carom::spec::{Key, LawSpec, NormalKind, NormalSpec, parse_named_law};
use carom::study::Distribution;
use carom::{LawError, WallLaw};
use clap::{Arg, ArgMatches, Command};
use flags::{Flags, Given};
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
#[derive(Clone, Debug, Default)]
pub struct LawArgs {
    /// Material files.
    pub materials: MaterialsArgs,
    /// A law of a file, under the flags.
    wall_law: Option<(PathBuf, String)>,
    given: Flags,
}

const WALL_LAW: &str = "wall-law";

impl clap::Args for LawArgs {
    fn augment_args(command: Command) -> Command {
        let wall_law = Arg::new(WALL_LAW)
            .long(WALL_LAW)
            .value_name("FILE:NAME")
            .help("Read the law from the table [law.NAME] of a TOML file; flags given besides override its keys")
            .help_heading(Key::Normal.info().group)
            .value_parser(values::law_place);
        MaterialsArgs::augment_args(flags::augment(command).arg(wall_law))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl clap::FromArgMatches for LawArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut args = Self { materials: MaterialsArgs::from_arg_matches(matches)?, ..Self::default() };
        args.update_from_arg_matches(matches)?;
        Ok(args)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        if let Some(place) = matches.get_one::<(PathBuf, String)>(WALL_LAW) {
            self.wall_law = Some(place.clone());
        }
        flags::update(&mut self.given, matches);
        Ok(())
    }
}

/// The laws that flags make, some of which may be distributions.
pub struct Population<'a> {
    args: &'a LawArgs,
    library: Library,
    spec: LawSpec,
    source: Option<Source>,
    has_friction: bool,
    /// Whether impacts slip along the wall, so that the law needs friction.
    slips: bool,
}

impl Population<'_> {
    /// The law with every distribution at its median.
    pub fn middle(&self) -> Result<Law, Failure> {
        let spec = self.spec(|_| 0.5);
        let unnamed = !self.args.is_named();
        let eap = unnamed.then(|| {
            let normal = Some(NormalSpec::Named(NormalKind::Eap).into());
            LawSpec { normal, ..spec.clone() }.compile(&self.library).ok()
        });
        Ok(Law { wall: self.compile(&spec)?, spec, has_friction: self.has_friction, unnamed, eap: eap.flatten() })
    }

    /// The law where a flag's distribution, by its number from 1 on, is at the probability `draw` gives.
    pub fn law(&self, draw: impl Fn(u32) -> f64) -> Result<WallLaw, Failure> {
        self.compile(&self.spec(draw))
    }

    fn spec(&self, draw: impl Fn(u32) -> f64) -> LawSpec {
        let mut spec = self.spec.clone();
        for (key, distribution) in self.args.distributions() {
            // a key's number stays its own: to add a distribution changes no other
            spec.set_number(key, distribution.quantile(draw(key.info().draw.unwrap_or(0))));
        }
        spec
    }

    fn compile(&self, spec: &LawSpec) -> Result<WallLaw, Failure> {
        let compiled = spec.compile(&self.library).and_then(|wall| {
            if self.slips {
                wall.require_friction()?;
            }
            Ok(wall)
        });
        compiled.map_err(|e| self.args.explain(e, self.source.as_ref()))
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
    /// Was none named, so that it is `ea`?
    unnamed: bool,
    /// `eap` in its place, where none was named and the strengths are known.
    eap: Option<WallLaw>,
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
        for key in self.given.keys() {
            spec.make_room(*key);
        }
        for given in self.given.values() {
            if let Given::One(law) = given {
                spec.overlay(law);
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
        self.distributions().map(|(key, distribution)| (flags::name(key), distribution))
    }

    fn distributions(&self) -> impl Iterator<Item = (Key, &Distribution)> {
        self.given.iter().filter_map(|(key, given)| match given {
            Given::One(_) => None,
            Given::Drawn(distribution) => Some((*key, distribution)),
        })
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
        let has_friction = spec.friction.is_some() || self.given.contains_key(&Key::Friction);
        let slips = oblique || spec.scatters();
        Ok(Population { args: self, library, spec, source, has_friction, slips })
    }

    /// Name of the law in its file, if it comes from one.
    pub fn name(&self) -> Option<&str> {
        self.wall_law.as_ref().map(|(_, name)| name.as_str())
    }

    /// Sets a number of the law, as a flag does.
    pub fn set_number(&mut self, key: Key, value: f64) {
        let mut law = LawSpec::default();
        law.set_number(key, value);
        self.given.insert(key, Given::One(Box::new(law)));
    }

    /// Is this number a distribution?
    pub fn draws(&self, key: Key) -> bool {
        matches!(self.given.get(&key), Some(Given::Drawn(_)))
    }

    /// Is it given by a flag?
    pub fn gives(&self, key: Key) -> bool {
        self.given.contains_key(&key)
    }

    /// Is the normal law named, by a flag or in a file?
    fn is_named(&self) -> bool {
        self.wall_law.is_some() || self.given.contains_key(&Key::Normal)
    }

    /// Is any law given, by flags or a file?
    pub fn is_given(&self) -> bool {
        let telling = [Key::Sphere, Key::Surface, Key::Normal];
        self.wall_law.is_some() || telling.iter().any(|key| self.given.contains_key(key))
    }

    /// An error in the words of whoever made it: at its place in the file, or with flags for keys.
    fn explain(&self, error: LawError, source: Option<&Source>) -> Failure {
        match source {
            Some((name, text)) if error.span.is_some() => Failure::in_file(error, name, text),
            Some((name, _)) => Failure::input(format!("{name}: {}", error.said_in(&Words))),
            None => Failure::input(error.said_in(&Words)),
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
    /// A law that was named and compiled elsewhere.
    pub fn of(spec: LawSpec, wall: WallLaw) -> Self {
        Self { wall, has_friction: spec.friction.is_some(), spec, unnamed: false, eap: None }
    }

    /// The law in a few words: `copper on aluminium, ea`.
    pub fn description(&self) -> String {
        self.materials().into_iter().chain([self.normal_name()]).collect::<Vec<_>>().join(", ")
    }

    /// With the diameter, as a heading: `90 um copper on aluminium, ea`.
    pub fn heading(&self, diameter: f64) -> String {
        let materials = self.materials().unwrap_or_else(|| "sphere".to_owned());
        format!("{} {materials}, {}", scaled(diameter, "m"), self.normal_name())
    }

    /// What to say where no law was named: that it is `ea`, and what `told` says of `eap`.
    pub fn by_default(&self, told: impl FnOnce(&WallLaw) -> Option<String>) -> String {
        if !self.unnamed {
            return String::new();
        }
        let eap = match self.eap.as_ref().and_then(told) {
            Some(told) => format!("--law eap gives {told}"),
            None => "no plastic loss".to_owned(),
        };
        format!(" (no --law given; {eap})")
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

    /// The materials' values that are only typical: `poisson ratio of lactose`.
    pub fn typical(&self) -> Option<String> {
        let pair = self.wall.pair()?;
        let of = |m: &Material| {
            let marked = m.properties.iter().filter(|(_, p)| p.typical.is_some());
            let names: Vec<String> = marked.map(|(kind, _)| kind.key().replace('_', " ")).collect();
            (!names.is_empty()).then(|| format!("{} of {}", names.join(", "), m.name))
        };
        let (sphere, surface) = (pair.sphere(), pair.surface());
        let other = (sphere.name != surface.name).then(|| of(surface)).flatten();
        let found: Vec<String> = of(sphere).into_iter().chain(other).collect();
        (!found.is_empty()).then(|| format!("{}: usual values, without a source for this material", found.join("; ")))
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
