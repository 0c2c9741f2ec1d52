//! What a reader of a fit should mind, with what would help.

use super::bootstrap::Bootstrap;
use super::problem::Problem;
use super::solve::Minimum;
use super::uncertainty::{Goodness, Uncertainty};
use crate::experiment::Quantity;
use carom::spec::Key;
use carom_report::significant;

/// Correlations beyond this are named.
const STRONG: f64 = 0.95;

/// Probabilities of χ² within this of 0 or 1 are named.
const UNLIKELY: f64 = 0.01;

pub(super) fn doubts(
    problem: &Problem<'_>,
    minimum: &Minimum,
    model: &[f64],
    known: &Uncertainty,
    bootstrap: Option<&Bootstrap>,
) -> Vec<String> {
    let mut said = Vec::new();
    let name = |n: usize| problem.free[n].parameter;
    for n in (0..problem.free.len()).filter(|n| minimum.held[*n]) {
        let others = if problem.free.len() > 1 { "; the others' errors take it as known" } else { "" };
        said.push(format!(
            "{} is at its bound {} and has no standard error{others}",
            name(n),
            significant(minimum.values[n], 4)
        ));
    }
    for &n in &known.idle {
        said.push(format!(
            "{} changes nothing at any of the points and stays where it began; {}",
            name(n),
            wakes(name(n))
        ));
    }
    if !known.entangled.is_empty() {
        let names: Vec<Key> = known.entangled.iter().map(|n| name(*n)).collect();
        let listed = names.iter().map(|p| p.name()).collect::<Vec<_>>().join(" and ");
        said.push(format!("only a combination of {listed} is known from these data; {}", parts(&names)));
    }
    for a in 0..problem.free.len() {
        for b in 0..a {
            let r = known.correlation[a][b];
            if r.abs() > STRONG {
                said.push(format!(
                    "the data hardly tell {} from {} (correlation {}); {}",
                    name(b),
                    name(a),
                    significant(r, 3),
                    parts(&[name(b), name(a)])
                ));
            }
        }
    }
    said.extend(scatter(&known.goodness));
    said.extend(misfit(problem, model, known.goodness.freedom));
    said.extend(fates(problem, model));
    said.extend(disagreement(problem, known, bootstrap));
    if let Some(failed) = bootstrap.map(|b| b.failed).filter(|f| *f > 0) {
        said.push(format!("{failed} resampled fits did not settle and are left out of the bootstrap intervals"));
    }
    said
}

/// Where standard errors and resampling do not say the same.
fn disagreement(problem: &Problem<'_>, known: &Uncertainty, bootstrap: Option<&Bootstrap>) -> Option<String> {
    let all = known.standard_errors.iter().enumerate();
    let unlike = all.filter_map(|(n, error)| {
        let (low, high) = bootstrap?.interval(n)?;
        let ratio = (high - low) / (2.0 * known.quantile * (*error)?);
        (!(0.5..=2.0).contains(&ratio)).then(|| problem.free[n].parameter.name())
    });
    let names = unlike.collect::<Vec<_>>().join(" and ");
    (!names.is_empty()).then(|| {
        format!(
            "standard error and resampling disagree about {names}: the law bends within the error, as it does where a point lies at the \
             capture velocity; trust the bootstrap interval"
        )
    })
}

fn scatter(goodness: &Goodness) -> Option<String> {
    if goodness.freedom == 0 {
        return Some("no more values than parameters: nothing is left to judge the fit by".into());
    }
    let (chi, chance) = (goodness.reduced_chi_square?, goodness.probability?);
    let chi_text = significant(chi, 3);
    if chance < UNLIKELY {
        return Some(format!(
            "the points scatter more than their sigma says (reduced chi-square {chi_text}, chance {}): the law does not fit, or sigma \
             is too small; with sigma scaled to the scatter the standard errors are {} times larger",
            significant(chance, 1),
            significant(chi.sqrt(), 3)
        ));
    }
    (chance > 1.0 - UNLIKELY).then(|| {
        format!("the points scatter less than their sigma says (reduced chi-square {chi_text}): sigma seems too large, and the errors too")
    })
}

/// Root mean square residuals beyond this no law that describes the data leaves.
const FAR: f64 = 0.1;

/// Beyond this they are judged by their order: neighbours that lie off to the same side.
const OFF: f64 = 0.03;

/// Where the law lies off the points by more than they scatter: by the residuals' size, against no law at all, and by neighbours (von
/// Neumann's ratio of squared differences to squares, 2 for what is chance and far below for what is not).
fn misfit(problem: &Problem<'_>, model: &[f64], freedom: usize) -> Option<String> {
    if freedom == 0 {
        return None;
    }
    let all = problem.observations.iter().zip(model);
    // spheres that stayed have their own line
    let mut told: Vec<_> =
        all.filter(|(o, _)| o.value > 0.0).map(|(o, m)| (o.point.normal_speed(), o.value, o.value - m)).collect();
    told.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = told.len() as f64;
    let squares: f64 = told.iter().map(|t| t.2 * t.2).sum();
    let rms = (squares / count).sqrt();
    let mean = told.iter().map(|t| t.1).sum::<f64>() / count;
    let spread = (told.iter().map(|t| (t.1 - mean) * (t.1 - mean)).sum::<f64>() / count).sqrt();
    let steps: f64 = told.windows(2).map(|w| (w[1].2 - w[0].2) * (w[1].2 - w[0].2)).sum();
    let why = if rms > FAR {
        ""
    } else if rms > OFF && rms >= spread {
        ", no nearer than their own mean"
    } else if rms > OFF && told.len() >= 6 && steps < 0.8 * squares {
        ", neighbours to the same side"
    } else {
        return None;
    };
    let free = |key: Key| problem.free.iter().any(|f| f.parameter == key);
    let work = if free(Key::WorkOfAdhesion) {
        ""
    } else {
        "free work_of_adhesion (roughness_factor, at most 1, only lowers adhesion), or "
    };
    Some(format!(
        "the law does not describe these points: it lies {} off them (rms){why}; {work}take a law with another loss, such as eap where \
         restitution falls with speed",
        significant(rms, 2)
    ))
}

/// Points whose fate the law has wrong.
fn fates(problem: &Problem<'_>, model: &[f64]) -> Vec<String> {
    let lines = |wrong: fn(f64, f64) -> bool| {
        let all = problem.observations.iter().zip(model);
        let of = all.filter(|(o, m)| o.quantity == Quantity::Restitution && wrong(o.value, **m));
        of.map(|(o, _)| o.point.line.to_string()).collect::<Vec<_>>()
    };
    let mut said = Vec::new();
    for (lines, what) in [
        (lines(|value, model| value > 0.0 && model <= 0.0), "rebound and the law captures them"),
        (lines(|value, model| value <= 0.0 && model > 0.05), "stayed and the law lets them rebound"),
    ] {
        if !lines.is_empty() {
            said.push(format!("{} of the spheres {what} (lines {})", lines.len(), lines.join(", ")));
        }
    }
    said
}

/// What would tell parameters apart.
fn parts(of: &[Key]) -> &'static str {
    use Key as P;
    let has = |p: P| of.contains(&p);
    if has(P::RoughnessFactor) && has(P::WorkOfAdhesion) {
        "they act as the one product C_R w^(2/3): give one of them"
    } else if has(P::AdhesionDamping) && has(P::HertzDamping) {
        "faster impacts and a second diameter help: C_A's share grows as v^(1/5) and falls with size, C_H's grows as v and does not"
    } else if has(P::AdhesionDamping) {
        "impacts close to the capture velocity fix adhesion by itself, fast ones its damping"
    } else if has(P::PlasticConstant) {
        "slow impacts, below the yield velocity, have no plastic loss and fix the other"
    } else {
        "a wider range of speeds, or a second diameter, helps; or give one of them"
    }
}

/// What would give a parameter something to act on.
fn wakes(parameter: Key) -> &'static str {
    match parameter {
        Key::PlasticConstant => "add impacts faster than the yield velocity",
        Key::Friction => "add impacts closer to the surface, where the sphere slides to the end",
        _ => "add impacts that rebound at other speeds, or leave it out",
    }
}
