//! A fit on standard output.

use crate::failure::Failure;
use crate::output;
use crate::text::Lines;
use carom_lab::fit::{Estimate, Fit};
use carom_report::{Column, Table, significant};
use std::fmt::Write as _;

/// One fit.
pub fn one(fit: &Fit, title: &str, json: bool) -> Result<(), Failure> {
    if json {
        return output::print_json(&serde_json::json!({ "law": title, "data": fit.data.name, "fit": fit }));
    }
    let mut text = format!("{title}: fitted to {}, {}\n\n", fit.data.name, super::points(fit));
    text += &estimates(fit)?.to_text();
    if fit.parameters.len() > 1 {
        let _ = write!(text, "\n{}", correlations(fit)?.to_text());
    }
    let mut lines = Lines::default();
    let goodness = &fit.goodness;
    let freedom = format!("{} degrees of freedom", goodness.freedom);
    if let Some(chi) = goodness.reduced_chi_square {
        let chance = goodness.probability.map_or(String::new(), |p| format!(", chance of more {}", significant(p, 2)));
        lines.add("reduced chi-square", format!("{} with {freedom}{chance}", significant(chi, 4)));
    }
    if let Some(scatter) = goodness.scatter {
        lines.add("scatter", format!("{} about the fit, with {freedom}", significant(scatter, 4)));
    }
    if let Some(b) = &fit.bootstrap {
        let what = serde_json::to_value(b.resampling).ok().and_then(|v| v.as_str().map(str::to_owned));
        lines.add("bootstrap", format!("{} resamples of {}, seed {}", b.resamples, what.unwrap_or_default(), b.seed));
    }
    fit.warnings.iter().for_each(|w| lines.add("warning", w.as_str()));
    let _ = write!(text, "\n{lines}");
    output::print(&text)
}

fn estimates(fit: &Fit) -> Result<Table, Failure> {
    let of = |get: &dyn Fn(&Estimate) -> String| fit.parameters.iter().map(get).collect::<Vec<_>>();
    let range = |r: Option<(f64, f64)>| {
        r.map_or("-".to_owned(), |(low, high)| format!("{} to {}", significant(low, 4), significant(high, 4)))
    };
    let name = |e: &Estimate| {
        if e.unit.is_empty() { e.parameter.to_string() } else { format!("{} ({})", e.parameter, e.unit) }
    };
    let mut columns = vec![
        Column::text("parameter", of(&name)),
        Column::text("value", of(&|e| significant(e.value, 4))),
        Column::text("error", of(&|e| e.standard_error.map_or("-".to_owned(), |s| significant(s, 2)))),
        Column::text("95 % interval", of(&|e| range(e.interval))),
    ];
    if fit.bootstrap.is_some() {
        columns.push(Column::text("95 % by bootstrap", of(&|e| range(e.bootstrap))));
    }
    Ok(Table::new(columns)?)
}

fn correlations(fit: &Fit) -> Result<Table, Failure> {
    let symbols: Vec<&str> = fit.parameters.iter().map(|p| p.parameter.info().symbol).collect();
    let mut columns = vec![Column::text("correlation", symbols.iter().copied())];
    for (n, symbol) in symbols.iter().enumerate().take(symbols.len() - 1) {
        let known = |m: usize| fit.parameters[m].standard_error.and(fit.parameters[n].standard_error).is_some();
        let cell = |m: usize| match () {
            () if m < n => String::new(),
            () if known(m) => format!("{:.3}", fit.correlation[m][n]),
            () => "-".to_owned(),
        };
        columns.push(Column::text(*symbol, (0..symbols.len()).map(cell).collect::<Vec<_>>()));
    }
    Ok(Table::new(columns)?)
}
