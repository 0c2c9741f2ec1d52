//! `--by`: one curve for each value of any flag.

use super::over::{Swept, with_unit};
use crate::failure::Failure;
use crate::motion::ImpactArgs;
use carom::error::did_you_mean;
use clap::{Args as _, FromArgMatches as _};

/// `diameter=10um,20um`: one curve for each value of a flag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct By {
    /// The flag, without dashes.
    pub key: String,
    /// Its values as written.
    pub values: Vec<String>,
}

impl std::str::FromStr for By {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let form = "a flag and its values are wanted, such as diameter=10um,20um or law=ea,eap";
        let (key, list) = text.split_once('=').ok_or(form)?;
        let separator = if list.contains(';') { ';' } else { ',' };
        let mut depth = 0;
        let between = |c: char| {
            depth += i32::from(c == '(') - i32::from(c == ')');
            c == separator && depth == 0
        };
        let written: Vec<&str> = list.split(between).map(str::trim).filter(|v| !v.is_empty()).collect();
        let last = written.last().ok_or(form)?;
        let key = key.trim().trim_start_matches("--").replace('_', "-");
        let shares_unit = Swept::ALL.iter().any(|q| q.flag() == key);
        let values = written.iter().map(|v| if shares_unit { with_unit(v, last) } else { (*v).to_owned() }).collect();
        Ok(Self { key, values })
    }
}

/// Sets the flag `key` as if it had been given, by reading it as the command line is read.
pub fn set(args: &mut ImpactArgs, key: &str, value: &str) -> Result<(), Failure> {
    let command = ImpactArgs::augment_args_for_update(clap::Command::new("carom").no_binary_name(true));
    let command = command.disable_help_flag(true).mut_args(|a| a.allow_hyphen_values(true));
    let flags: Vec<String> = command.get_arguments().filter_map(|a| a.get_long()).map(str::to_owned).collect();
    if !flags.iter().any(|f| f == key) || key == "materials" {
        let near = did_you_mean(key, flags.iter().map(String::as_str)).map_or(String::new(), |n| format!("{n} "));
        return Err(Failure::input(format!(
            "--by {key}: no such flag; {near}any flag of the law or the impact will do, or pair"
        )));
    }
    let matches = command.try_get_matches_from([format!("--{key}={value}")]);
    matches.and_then(|m| args.update_from_arg_matches(&m)).map_err(|e| {
        let text = e.render().to_string();
        Failure::input(format!("--by: {}", text.trim_start_matches("error: ").trim_end()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use carom::study::Given;

    #[test]
    fn curves_vary_any_flag() {
        let by: By = "law=adhesion-work,hertz-damping;ea".parse().expect("two laws");
        assert_eq!(by.values, ["adhesion-work,hertz-damping", "ea"]);
        let by: By = "diameter=10,20um".parse().expect("two diameters");
        assert_eq!(by.values, ["10um", "20um"]);
        let by: By = "diameter=lognormal(10um, 1.3),20um".parse().expect("a distribution and a diameter");
        assert_eq!(by.values, ["lognormal(10um, 1.3)", "20um"]);
        let mut args = ImpactArgs::default();
        args.motion.speed = Some(3.0);
        set(&mut args, "diameter", "10um").expect("a diameter");
        assert_eq!((args.motion.diameter.clone(), args.motion.speed), (Some(Given::One(1e-5)), Some(3.0)));
        assert!(
            matches!(set(&mut args, "diamter", "1"), Err(Failure::Input(m)) if m.contains("did you mean diameter?"))
        );
        assert!(matches!(set(&mut args, "friction", "x"), Err(Failure::Input(m)) if m.contains("no number here")));
    }
}
