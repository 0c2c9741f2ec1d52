//! The report as a reader sees it.

use crate::compare::{Comparison, Recomputed};
use crate::error::LabError;
use crate::experiment::{Over, Tier};
use crate::validate::{PanelResult, Validation};
use crate::{resolved, tunnel};
use carom_report::{Column, Report, Table, significant};

const INTRODUCTION: &str = "For each figure of Kim & Dunn (2007, J. Aerosol Sci. 38, 532–549, https://doi.org/10.1016/j.jaerosci.2007.03.006) \
the plot it shows, computed by carom from the inputs that the paper prints, and held against what is publicly known of the \
measurements. Nothing is fitted here, and no point is drawn that has no source. For most of the paper's experiments no numbers are \
public: those are predictions and say so.";

/// What "held against" means.
const TIERS: [(&str, &str); 5] = [
    ("measured data", "points with a public source"),
    ("stated bounds", "numbers that a source states in words: limits and single values, not points"),
    ("another model", "what another model or program gives"),
    ("analytic", "an exact solution"),
    ("prediction only", "nothing to hold it against"),
];

const WEAK: [&str; 7] = [
    "One data set of measured points (Kharaz, Gorham & Salman 2001) is all that the comparison rests on, and it tests the tangential law of a 5 mm sphere. No measured point of a microsphere is public here: adhesion and capture are untested against data.",
    "C_R, C_A and C_H are fitted numbers. The paper prints one set (Fig. 8); for all other cases carom draws the range of C_R it names and no damping.",
    "With damping the algebraic form is a crude quadrature of its own equation of motion (see above). Coefficients fitted with one form must not be used in the other.",
    "EAP with the paper's printed inputs does not pass the data it is said to agree with. Yielding depends on the yield strength to the power 5/2, which tables give within a factor of several.",
    "Micro-slip is 0.03 off at 80° from the surface and 0.02 at 88°; its inputs (friction, moduli) are published ones and not fitted.",
    "Surface energies are those of clean surfaces in vacuum; in air they are lower and not well known.",
    "The wind tunnel's height, the release of the spheres, friction and the work of adhesion of copper on glass are not printed. With the values assumed the number of bounces is not the paper's.",
];

/// Puts the report together.
pub(crate) fn report(v: &Validation) -> Result<Report, LabError> {
    let mut report = Report::new("carom against experiments");
    report.paragraph(INTRODUCTION);
    report.paragraph(&format!(
        "carom {}. Angles are measured from the surface. A deviation is model minus value.",
        v.version
    ));
    report.section("Summary").table(&v.summary()?, "Models and what they are held against.");
    report.list(TIERS.map(|(name, means)| format!("{name}: {means}")));
    not_reproduced(&mut report, v)?;
    for figure in 2..=12u32 {
        self::figure(&mut report, v, figure)?;
    }
    report.section("Beyond the paper: oblique impact with micro-slip");
    for panel in v.panels.iter().filter(|p| p.figure.is_none()) {
        self::panel(&mut report, v, panel)?;
    }
    forms(&mut report, v)?;
    table_2(&mut report, v)?;
    identities(&mut report, v)?;
    report.section("Where it is weak").list(WEAK);
    inputs(&mut report, v);
    Ok(report)
}

fn claims<'a>(claims: impl Iterator<Item = &'a Recomputed>) -> Result<Table, LabError> {
    let claims: Vec<_> = claims.collect();
    let verdict = |c: &Recomputed| {
        let verdict = match (c.holds, c.by_choice) {
            (true, true) => "holds by choice of an input",
            (true, false) => "reproduced",
            (false, _) => "not reproduced",
        };
        match &c.aside {
            Some(why) => format!("{verdict}; not counted: {why}"),
            None => verdict.to_owned(),
        }
    };
    Ok(Table::new([
        Column::text("says", claims.iter().map(|c| c.says.as_str())),
        Column::text("printed", claims.iter().map(|c| c.printed.as_str())),
        Column::text("computed", claims.iter().map(|c| significant(c.computed, 4))),
        Column::text("verdict", claims.iter().map(|c| verdict(c))),
        Column::text("inputs", claims.iter().map(|c| format!("{}.toml, law.{}", c.experiment, c.law))),
        Column::text("source", claims.iter().map(|c| c.source.as_str())),
    ])?)
}

fn not_reproduced(report: &mut Report, v: &Validation) -> Result<(), LabError> {
    report.section("Claims of the paper that its own inputs do not give").paragraph(
        "Recomputed from the printed inputs. Sigma = 290 MPa where the paper prints k = sigma/2 = 290 MPa is explained under Fig. 9.",
    );
    report.table(&claims(v.claims.iter().filter(|c| !c.holds && c.counts()))?, "Not reproduced.");
    let of = |name: &str| v.comparisons.iter().find(|c| c.curve.starts_with(name));
    if let (Some(micro), Some(rolling)) = (of("micro-slip"), of("rolling")) {
        report.paragraph(&format!(
            "Rigid rolling, the paper's tangential model, is off by up to {:.3} in tangential restitution against Kharaz, Gorham & Salman \
             (2001); micro-slip, which the paper does not have, by up to {:.3}, with nothing fitted.",
            rolling.greatest, micro.greatest
        ));
    }
    Ok(())
}

fn figure(report: &mut Report, v: &Validation, number: u32) -> Result<(), LabError> {
    let name = number.to_string();
    match number {
        10 => return Ok(()),
        7 => {
            report.section("Figure 7: fitted damping coefficients against Young's modulus").paragraph(
                "Not drawn. The paper prints no coefficient of this figure and no formula. The only printed pair, C_A = 1.3 s/m and \
                 C_H = 0.007 s/m, belongs to stainless steel on silicon (Fig. 8, E = 166 GPa). The figure needs the measured points of \
                 Figs 3 to 6, to which the coefficients were fitted.",
            );
            return Ok(());
        }
        11 | 12 => return wind_tunnel(report, v, &name),
        _ => {}
    }
    report.section(&format!("Figure {number}"));
    for panel in v.panels.iter().filter(|p| p.figure.as_deref() == Some(&name)) {
        self::panel(report, v, panel)?;
    }
    let mine = || v.claims.iter().filter(|c| c.figure.as_deref() == Some(&name));
    if mine().next().is_some() {
        report.table(&claims(mine())?, "What the paper says of this figure, recomputed from its inputs.");
    }
    Ok(())
}

fn panel(report: &mut Report, v: &Validation, panel: &PanelResult) -> Result<(), LabError> {
    let Some(experiment) = v.experiments.iter().find(|e| e.name == panel.experiment) else { return Ok(()) };
    let several =
        experiment.panels.iter().filter(|p| p.figure.as_ref().map(|f| &f.value) == panel.figure.as_ref()).count();
    let heading = if several > 1 { format!("{}: {}", experiment.title, panel.panel) } else { experiment.title.clone() };
    report.subsection(&heading);
    let worth = match panel.tier {
        Tier::Prediction => "Prediction only, held against nothing".to_owned(),
        tier => format!("Held against: {}", tier.name()),
    };
    report.paragraph(&format!("{worth}. {}. Values: {}.", experiment.source, experiment.values_from()));
    report.figure(&panel.plot.svg()?, &inputs_of(panel));
    let first = v.panels.iter().find(|p| p.experiment == panel.experiment && p.figure == panel.figure);
    if first.is_some_and(|p| p.panel == panel.panel) {
        report.list(&experiment.notes);
    }
    for comparison in v.of(panel) {
        let mut caption = format!(
            "{}: greatest deviation {:.4}, root mean square {:.4} ({}.toml, law.{}).",
            comparison.curve, comparison.greatest, comparison.rms, comparison.experiment, comparison.law
        );
        if let [source] = sources(comparison)[..] {
            caption += &format!(" Values: {source}.");
        }
        report.table(&deviations(comparison)?, &caption);
    }
    Ok(())
}

/// Where the values come from, each source once.
fn sources(comparison: &Comparison) -> Vec<&str> {
    let mut sources: Vec<&str> = comparison.points.iter().map(|p| p.source.as_str()).collect();
    sources.dedup();
    sources
}

fn inputs_of(panel: &PanelResult) -> String {
    let curves = panel.curves.iter().map(|c| {
        let laws: Vec<String> = c.laws.iter().map(|l| format!("law.{l}")).collect();
        format!("{} ({}, diameter {} µm)", c.label, laws.join(" to "), significant(c.diameter * 1e6, 4))
    });
    format!("{}.toml: {}.", panel.experiment, curves.collect::<Vec<_>>().join("; "))
}

fn deviations(c: &Comparison) -> Result<Table, LabError> {
    let mut columns = vec![
        Column::text(
            if c.over == Over::Angle { "angle (°)" } else { "speed (m/s)" },
            c.points.iter().map(|p| significant(p.at, 4)),
        ),
        Column::text("value", c.points.iter().map(|p| significant(p.value, 4))),
    ];
    if c.points.iter().any(|p| p.sigma.is_some()) {
        columns
            .push(Column::text("±", c.points.iter().map(|p| p.sigma.map(|s| significant(s, 2)).unwrap_or_default())));
    }
    columns.push(Column::text("model", c.points.iter().map(|p| format!("{:.4}", p.model))));
    columns.push(Column::text("deviation", c.points.iter().map(|p| format!("{:+.4}", p.deviation))));
    if c.tier == Tier::Stated {
        let word = |h: Option<bool>| match h {
            Some(true) => "kept",
            Some(false) => "broken",
            None => "",
        };
        columns.push(Column::text("bound", c.points.iter().map(|p| word(p.holds))));
    }
    if sources(c).len() > 1 {
        columns.push(Column::text("source", c.points.iter().map(|p| p.source.as_str())));
    }
    Ok(Table::new(columns)?)
}

fn wind_tunnel(report: &mut Report, v: &Validation, figure: &str) -> Result<(), LabError> {
    let ways: Vec<_> = v.tunnel.iter().filter(|w| w.figure == figure).collect();
    let Some(first) = ways.first() else { return Ok(()) };
    let (heading, said) = if figure == "11" {
        (
            "Figure 11: copper spheres in a wind tunnel",
            "Held against: stated bounds. The paper: copper falls onto glass 7 cm downstream; the 90 µm sphere bounces twice before it is captured, \
             the 61 µm one is captured at once. Measured points exist as circles in the figure alone. The case file says what is assumed (height, \
             release, friction, work of adhesion); with that, both spheres bounce more often here. What the paper prints does not decide it.",
        )
    } else {
        (
            "Figure 12: a sphere thrown upward",
            "Held against: another model (the paper's own simulation). The paper: it rebounds from the upper wall and is captured on the lower; \
             with e = 1 it travels about twice as far. Height, starting point, C_R and friction are assumed.",
        )
    };
    report.section(heading).paragraph(said).figure(
        &tunnel::plot(figure, &v.tunnel).svg()?,
        &format!("Paths by carom's tracker from {} (heights drawn larger than lengths).", first.case),
    );
    report.table(
        &Table::new([
            Column::text("sphere", ways.iter().map(|w| w.label.as_str())),
            Column::count("impacts", ways.iter().map(|w| w.impacts as u64)),
            Column::text("stated", ways.iter().map(|w| w.impacts_stated.map(|n| n.to_string()).unwrap_or_default())),
            Column::text(
                "first impact on the floor (mm)",
                ways.iter().map(|w| w.first_floor_impact.map(|x| format!("{:.1}", x * 1e3)).unwrap_or_default()),
            ),
            Column::text("end", ways.iter().map(|w| w.fate)),
            Column::text("end at (mm)", ways.iter().map(|w| format!("{:.1}", w.end * 1e3))),
        ])?,
        &format!("Input: {}.", first.case),
    );
    if let (true, [real, elastic]) = (figure == "12", &ways[..]) {
        report.paragraph(&format!(
            "With e = 1 it ends {:.2} times as far here where the paper says about 2. What the paper prints does not decide it: the ratio \
             depends on height, starting point and C_R, which it does not give (2.6 times at 20 mm with C_R 1, twice at 13.05 and 20.75 mm: the \
             example two-walls).",
            elastic.end / real.end
        ));
    }
    Ok(())
}

fn forms(report: &mut Report, v: &Validation) -> Result<(), LabError> {
    let f = &v.resolved;
    report.section("Algebraic against resolved: where the closed form is good, and how far off with damping").paragraph(
        "The algebraic form (Eqs 21 to 24) stands for the equation of motion (Eqs 4, 8 to 12). Pair and damping of Fig. 8.",
    );
    report.list([
        format!("Without damping, adhesion acting while the surfaces separate: the same to {:.0e} at every speed (analytic; an identity, see below). The closed form is exact there.", f.undamped),
        format!(
            "With damping it is off by up to {:.4} in restitution from 0.1 to 25 m/s, by {:.3} near capture and by {:.2} at 100 m/s, where damping takes most of the energy.",
            f.damped, f.damped_slow, f.damped_fast
        ),
        "In the limit of weak damping the motion loses 1.333 C_H v by Hertzian damping where Eq. 23 counts 0.907 C_H v, and 0.757 C_A v times the adhesion's share where Eq. 24 counts all of it. The two errors partly cancel for this pair; coefficients fitted with one form do not belong in the other.".to_owned(),
        format!(
            "Against the equation as printed (adhesion on approach too, Eq. 4) the damped algebraic form is off by up to {:.3} from 0.1 to 25 m/s: without damping that equation gives e = 1 at every speed.",
            f.reversible
        ),
    ]);
    report.figure(&resolved::plot(f).svg()?, "Restitution by every form.");
    report.figure(
        &resolved::difference(f).svg()?,
        "Algebraic minus resolved, from just above the capture velocity (0.026 m/s) on.",
    );
    let rows: Vec<_> = f.rows.iter().step_by(12).collect();
    report.table(
        &Table::new([
            Column::float("speed", "m/s", rows.iter().map(|r| r.speed)),
            Column::float("algebraic", "", rows.iter().map(|r| r.algebraic)),
            Column::float("resolved", "", rows.iter().map(|r| r.resolved)),
            Column::float("algebraic, damped", "", rows.iter().map(|r| r.algebraic_damped)),
            Column::float("resolved, damped", "", rows.iter().map(|r| r.resolved_damped)),
            Column::float("Eq. 4, damped", "", rows.iter().map(|r| r.reversible_damped)),
        ])?,
        "70 µm stainless steel on silicon.",
    );
    report.preformatted(&format!("{}# where damped:\n{}", resolved::INPUTS, resolved::DAMPING));
    Ok(())
}

fn table_2(report: &mut Report, v: &Validation) -> Result<(), LabError> {
    let rows = &v.table_2;
    let giga = |x: Option<f64>| x.map(|x| significant(x / 1e9, 4)).unwrap_or_default();
    report.section("Table 2: stiffness and work of adhesion").table(
        &Table::new([
            Column::text("sphere", rows.iter().map(|r| r.sphere.as_str())),
            Column::text("surface", rows.iter().map(|r| r.surface.as_str())),
            Column::text("K (GPa)", rows.iter().map(|r| giga(Some(r.stiffness)))),
            Column::text("K from materials", rows.iter().map(|r| giga(r.stiffness_computed))),
            Column::text("w (J/m2)", rows.iter().map(|r| significant(r.work_of_adhesion, 3))),
            Column::text(
                "w from materials",
                rows.iter().map(|r| r.work_of_adhesion_computed.map(|w| significant(w, 3)).unwrap_or_default()),
            ),
            Column::text("note", rows.iter().map(|r| r.note.as_str())),
        ])?,
        "Table 2 of Kim & Dunn (2007) against what the library's materials give: those of the paper's Table 1, and crystalline quartz of powders.toml.",
    );
    Ok(())
}

fn identities(report: &mut Report, v: &Validation) -> Result<(), LabError> {
    let all = &v.identities;
    report
        .section("Identities")
        .paragraph("These hold by construction. They test the program and say nothing about nature.")
        .table(
            &Table::new([
                Column::text("identity", all.iter().map(|i| i.says.as_str())),
                Column::text(
                    "off by",
                    all.iter().map(|i| if i.off == 0.0 { "0".to_owned() } else { format!("{:.0e}", i.off) }),
                ),
                Column::text("allowed", all.iter().map(|i| format!("{:.0e}", i.allowed))),
            ])?,
            "Identities.",
        );
    Ok(())
}

fn inputs(report: &mut Report, v: &Validation) {
    report
        .section("Inputs")
        .paragraph("Every experiment as it was read: `carom impact --wall-law FILE:LAW` takes any of these laws.");
    for experiment in &v.experiments {
        report.subsection(&format!("{}.toml", experiment.name)).preformatted(&experiment.text);
    }
}
