//! `--by`: one curve for each value of any flag.

use super::over::{Over, Swept, with_unit};
use crate::failure::Failure;
use crate::motion::ImpactArgs;
use carom::error::did_you_mean;
use carom::spec::Key;
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
        let quantity = Swept::all().find(|q| q.flag() == key);
        let mut values = Vec::new();
        for value in &written {
            match (value.split_once(".."), quantity) {
                (Some((from, range)), Some(quantity)) => values.extend(steps(quantity, from, range)?),
                (None, Some(_)) => values.push(with_unit(value, last)),
                (_, None) => values.push((*value).to_owned()),
            }
        }
        Ok(Self { key, values })
    }
}

impl By {
    /// A curve for each point of a range: the second direction of a map.
    pub fn along(over: &Over, points: &[f64]) -> Self {
        let values = points.iter().map(|v| written(over.quantity, *v)).collect();
        Self { key: over.quantity.flag().to_owned(), values }
    }
}

/// Values of `from..to` or `from..to:count`.
fn steps(quantity: Swept, from: &str, range: &str) -> Result<Vec<String>, String> {
    const USUAL: usize = 5;
    let (to, count) = match range.split_once(':') {
        Some((to, count)) => {
            let fits = |n: &usize| (2..=100).contains(n);
            let count = count.trim().parse().ok().filter(fits);
            (to, count.ok_or("after ':' the number of values is wanted, 2 to 100, such as 1..100um:5")?)
        }
        None => (range, USUAL),
    };
    let over = Over::between(quantity, from, to)?;
    let rounded = |v: f64| carom_report::significant(v, 4).parse().unwrap_or(v);
    let points = over.points(count, over.is_linear());
    let last = points.len() - 1;
    let points = points.into_iter().enumerate().map(|(i, v)| if i == 0 || i == last { v } else { rounded(v) });
    Ok(points.map(|v| written(quantity, v)).collect())
}

/// A value as its flag takes it.
fn written(quantity: Swept, value: f64) -> String {
    match quantity {
        // a bare number there is in degrees
        Swept::Law(Key::RoughnessAngle) => format!("{value}rad"),
        _ => value.to_string(),
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
        let by: By = "diameter=1..100um:3,1mm".parse().expect("a range and a value");
        assert_eq!(by.values, ["0.000001", "0.00001", "0.0001", "1mm"]);
        let by: By = "friction=0..0.4".parse().expect("a range from zero");
        assert_eq!(by.values, ["0", "0.1", "0.2", "0.3", "0.4"]);
        assert!("friction=0..0.4:1".parse::<By>().is_err_and(|e| e.contains("2 to 100")));
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
