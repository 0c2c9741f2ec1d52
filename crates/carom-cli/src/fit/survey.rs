//! `carom fit --survey`: the same fit for several pairs of materials.

use super::Args;
use crate::failure::Failure;
use crate::output::{self, Files};
use carom_lab::fit::survey::{FREE, Surveyed, plot, read, survey, table};
use carom_report::{Column, Table, significant};
use std::fmt::Write as _;
use std::path::PathBuf;

pub fn run(args: &Args) -> Result<(), Failure> {
    if args.law.is_given() {
        return Err(Failure::input("--survey takes its laws from its files; leave out the flags of a law"));
    }
    let files = Files::check(args.out.as_ref(), args.plot.as_ref())?.beside(args.json)?;
    let (free, library) = (args.free(&FREE)?, args.law.materials.library()?);
    let mut subjects = Vec::new();
    for path in &args.survey {
        for file in files_of(path)? {
            match read(&file, args.diameter) {
                Ok(more) => subjects.extend(more),
                // of a folder, what has no data is passed over
                Err(carom_lab::LabError::Fit(_)) if path.is_dir() => {}
                Err(error) => return Err(error.into()),
            }
        }
    }
    if subjects.is_empty() {
        let names = args.survey.iter().map(|p| p.display().to_string()).collect::<Vec<_>>().join(", ");
        return Err(Failure::input(format!("{names}: no data; put NAME.csv beside an experiment NAME.toml")));
    }
    for subject in &subjects {
        crate::validate::tell_left_out(&subject.data.name, &subject.data.left_out);
    }
    let found = survey(&subjects, &free, &library, &args.options(0))?;
    files.write(|| Ok(table(&found)?), || plot(&found))?;
    if files.to_stdout() {
        return Ok(());
    }
    if args.json {
        return output::print_json(&found);
    }
    if files.any() && args.out.is_some() && args.plot.is_none() {
        return Ok(());
    }
    output::print(&text(&found)?)
}

/// A file itself, or the laws and experiments of a folder.
fn files_of(path: &PathBuf) -> Result<Vec<PathBuf>, Failure> {
    if !path.is_dir() {
        return Ok(vec![path.clone()]);
    }
    let failed = |e: &std::io::Error| crate::failure::of_file(&path.display().to_string(), e);
    let mut files = Vec::new();
    for entry in std::fs::read_dir(path).map_err(|e| failed(&e))? {
        let file = entry.map_err(|e| failed(&e))?.path();
        if file.extension().is_some_and(|e| e == "toml") {
            files.push(file);
        }
    }
    files.sort();
    Ok(files)
}

fn text(found: &[Surveyed]) -> Result<String, Failure> {
    let of = |get: &dyn Fn(&Surveyed) -> String| found.iter().map(get).collect::<Vec<_>>();
    let mut columns = vec![
        Column::text("name", of(&|s| s.name.clone())),
        Column::text("surface", of(&|s| s.surface.clone().unwrap_or("-".into()))),
        Column::text("E (GPa)", of(&|s| s.young_modulus.map_or("-".into(), |e| significant(e * 1e-9, 4)))),
        Column::text("points", of(&|s| s.points.to_string())),
    ];
    for (n, parameter) in found.first().map_or(&[][..], |s| &s.fit.parameters[..]).iter().enumerate() {
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" ({})", parameter.unit) };
        let cell = |s: &Surveyed| {
            let p = &s.fit.parameters[n];
            let value = significant(p.value, 4);
            let range = |(l, h)| format!("{value} [{}, {}]", significant(l, 3), significant(h, 3));
            p.interval.map_or(format!("{value} [-]"), range)
        };
        columns.push(Column::text(format!("{}{unit}", parameter.parameter.info().symbol), of(&cell)));
    }
    let mut text = Table::new(columns)?.to_text();
    text += "\nIn brackets: 95 % intervals.\n";
    for subject in found {
        for warning in &subject.fit.warnings {
            let _ = writeln!(text, "warning {}: {warning}", subject.name);
        }
    }
    Ok(text)
}
