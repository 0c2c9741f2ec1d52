//! The registry's keys as flags: names, help, values.

use crate::values;
use carom::error::Wording;
use carom::spec::{Key, LawSpec};
use carom::study::{Distribution, read_distribution};
use clap::{Arg, ArgMatches, Command};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// A flag's value.
#[derive(Clone, Debug)]
pub enum Given {
    /// A law with this one key.
    One(Box<LawSpec>),
    /// A distribution of its numbers.
    Drawn(Distribution),
}

/// The flags given, by key.
pub type Flags = BTreeMap<Key, Given>;

/// Each key's flag, without dashes, and the word for its value.
static NAMES: LazyLock<BTreeMap<Key, (String, String)>> = LazyLock::new(|| {
    let named = |key: Key| {
        let info = key.info();
        // the one key whose name says too little on a command line
        let flag = if key == Key::Normal { "law".to_owned() } else { info.name.replace('_', "-") };
        let word = match key {
            Key::RoughnessAngle => "DEG".to_owned(),
            _ if info.symbol.is_ascii() && !info.symbol.is_empty() => info.symbol.to_uppercase(),
            _ => info.word.to_uppercase(),
        };
        (key, (flag, word))
    };
    Key::ALL.iter().copied().map(named).collect()
});

/// The key's flag, without dashes.
pub fn name(key: Key) -> &'static str {
    NAMES.get(&key).map_or("", |(flag, _)| flag)
}

/// Adds a flag for each key.
pub fn augment(command: Command) -> Command {
    command.args(Key::ALL.iter().map(|key| argument(*key)))
}

fn argument(key: Key) -> Arg {
    let info = key.info();
    let word = NAMES.get(&key).map_or("", |(_, word)| word);
    Arg::new(name(key))
        .long(name(key))
        .value_name(word)
        .help(help(key))
        .help_heading(info.group)
        .value_parser(move |text: &str| read(key, text))
}

fn help(key: Key) -> String {
    let info = key.info();
    let meaning = info.meaning.trim();
    let mut letters = meaning.chars();
    let mut help: String = letters.next().map(|c| c.to_uppercase().collect()).unwrap_or_default();
    help += letters.as_str();
    match key {
        Key::RoughnessAngle => {
            help += "; degrees, unless a unit is written; where no samples are drawn, the median facet"
        }
        Key::Sphere => help += ": see `carom materials`, or rho=8000,E=190GPa,nu=0.27,gamma=1.62,sigma=310MPa",
        Key::Normal => {
            let losses: Vec<&str> = carom::normal::Loss::ALL.iter().map(|l| l.name()).collect();
            help += &format!(
                ": {}; or losses, separated by commas: {}",
                carom::spec::NormalKind::NAMES.join(", "),
                losses.join(", ")
            );
        }
        Key::Tangential => help += &format!(": {}", carom::spec::TangentialKind::NAMES.join(", ")),
        _ => {}
    }
    if !info.unit.is_empty() && key != Key::RoughnessAngle {
        help += &format!(", {}", info.unit);
    }
    let default = if key == Key::Normal { "ea" } else { info.default };
    if default.is_empty() { help } else { format!("{help} [default: {default}]") }
}

fn read(key: Key, text: &str) -> Result<Given, String> {
    if key.info().draw.is_some() && text.contains('(') {
        let number = |part: &str| {
            let mut law = LawSpec::default();
            match law.set_text(key, part) {
                Ok(()) => Ok(law.number(key).unwrap_or(f64::NAN)),
                Err(e) => Err(e.unit_error().map_or((0, e.message_in(&Words)), |u| (u.at, u.message.clone()))),
            }
        };
        return read_distribution(text, &number, key.ends()).map(Given::Drawn).map_err(|e| e.to_string());
    }
    let mut law = LawSpec::default();
    match key {
        Key::Normal => law.normal = Some(values::normal_law(text)?.into()),
        Key::RoughnessAngle => law.roughness_angle = Some(values::degrees(text)?.into()),
        Key::Sphere | Key::Surface if text.trim().is_empty() => {
            return Err("nothing here; a material's name is wanted, such as copper".into());
        }
        _ => law.set_text(key, text).map_err(|e| e.said_in(&Words))?,
    }
    Ok(Given::One(Box::new(law)))
}

/// Reads a number of the law, SI units (an angle in rad).
pub fn number(key: Key, text: &str) -> Result<f64, String> {
    match read(key, text)? {
        Given::One(law) => law.number(key).ok_or_else(|| format!("{text} is no number")),
        Given::Drawn(_) => Err(format!("{text} is a distribution; a number is wanted")),
    }
}

/// Takes over what the command line gives.
pub fn update(flags: &mut Flags, matches: &ArgMatches) {
    for key in Key::ALL {
        if let Ok(Some(given)) = matches.try_get_one::<Given>(name(*key)) {
            flags.insert(*key, given.clone());
        }
    }
}

/// The words of a command line: flags for keys.
pub struct Words;

impl Words {
    fn flag(key: &str) -> Option<String> {
        Key::by_name(key).map(|key| format!("--{}", name(key)))
    }
}

impl Wording for Words {
    fn key(&self, key: &str) -> String {
        Self::flag(key).unwrap_or_else(|| key.to_owned())
    }

    fn value(&self, value: &str) -> String {
        if value.contains([' ', '{', '[']) { format!("'{value}'") } else { value.to_owned() }
    }

    fn setting(&self, key: &str, value: &str) -> String {
        match Self::flag(key) {
            Some(flag) => format!("{flag} {}", self.value(value)),
            None => format!("{key} = {value}"),
        }
    }

    fn loss(&self, name: &str) -> String {
        format!("--law {name}")
    }

    fn materials(&self) -> Option<String> {
        Some("`carom materials` lists all".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use carom::WallLaw;
    use carom::spec::NormalKind;

    #[test]
    fn every_key_has_a_flag_with_help() {
        let command = augment(Command::new("x"));
        assert_eq!(command.get_arguments().count(), Key::ALL.len());
        for argument in command.get_arguments() {
            assert!(argument.get_help().is_some_and(|h| h.to_string().len() > 8), "{argument:?}");
        }
    }

    #[test]
    fn errors_speak_of_flags() {
        let said = |builder: carom::spec::LawBuilder| builder.build().expect_err("refused").said_in(&Words);
        let tabor = said(WallLaw::builder().normal(NormalKind::Tabor).meyer_index(2.3));
        assert_eq!(tabor, "--law tabor needs a fitted yield velocity; give --yield-velocity '0.09 m/s'");
        let idle = said(WallLaw::builder().normal(NormalKind::Constant).restitution(0.5).walton_beta(0.4));
        assert_eq!(
            idle,
            "--walton-beta has no effect with --tangential rolling; leave it out; it is read with --tangential walton"
        );
    }
}
