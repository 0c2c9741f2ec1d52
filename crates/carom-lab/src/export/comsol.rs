//! COMSOL Multiphysics, Particle Tracing for Fluid Flow: variables for a Wall with General reflection.
//!
//! General reflection takes the reflected velocity in components; its Primary particle condition can be an expression, and where that is 0
//! the Otherwise choice acts, here Stick (Particle Tracing Module User's Guide 6.2, "Wall"). `if(a,b,c)` chooses, `a^b` is a power, numbers carry
//! units in brackets. The variables are those of the interface `fpt`: `fpt.vx` and its like, the diameter `fpt.dp`, the wall's normal
//! `nx`, which may point either way. The text was checked against the guide and by evaluating it, not in the program.

use super::expressions::{Definition, Dialect, Names};
use super::{Request, formula, number};
use crate::error::LabError;
use std::fmt::Write as _;

const DIALECT: Dialect = Dialect {
    named: str::to_owned,
    power: |a, b| format!("({a})^({b})"),
    choose: |a, b, c| format!("if({a}, {b}, {c})"),
    speed: |v| format!("{}[m/s]", number(v)),
    length: |v| format!("{}[m]", number(v)),
    names: Names {
        normal_speed: "carom_vn",
        angle: "carom_angle",
        scale: "carom_velocity",
        variable: "carom_argument",
        share: "carom_share",
        bin: "carom_restitution",
        restitution: "carom_en",
        tangential: "carom_et",
    },
    diameter: "fpt.dp",
};

/// What the incoming velocity is made of, and what the outgoing one is.
const BEFORE: [(&str, &str, &str); 4] = [
    ("carom_vs", "fpt.vx*nx + fpt.vy*ny + fpt.vz*nz", "velocity along the normal, m/s"),
    ("carom_v", "sqrt(fpt.vx^2 + fpt.vy^2 + fpt.vz^2)", "speed, m/s"),
    ("carom_vn", "abs(carom_vs)", "normal speed, m/s"),
    ("carom_angle", "asin(min(1, carom_vn/carom_v))", "angle from the wall, rad"),
];
const AFTER: [(&str, &str, &str); 4] = [
    ("carom_bounces", "carom_en > 0", "Primary particle condition, Expression; Otherwise: Stick"),
    ("carom_vpx", "carom_et*(fpt.vx - carom_vs*nx) - carom_en*carom_vs*nx", "Reflected particle velocity, x"),
    ("carom_vpy", "carom_et*(fpt.vy - carom_vs*ny) - carom_en*carom_vs*ny", "Reflected particle velocity, y"),
    ("carom_vpz", "carom_et*(fpt.vz - carom_vs*nz) - carom_en*carom_vs*nz", "Reflected particle velocity, z"),
];

pub(super) fn write(request: &Request, degree: usize) -> Result<String, LabError> {
    let mut text = request.heading(
        "%",
        &[
            "COMSOL Multiphysics, Particle Tracing for Fluid Flow: variables, then a Wall with General reflection",
            "one variable a line: name, expression without blanks, description",
        ],
    );
    let mut bins = Vec::new();
    for cell in request.cells() {
        let (formula, stuck, deviation) = formula::fit(request.law, &cell, degree)?;
        let _ = writeln!(text, "\n% diameter {}", cell.diameters.told_in(1e6, "um"));
        for line in deviation.lines(stuck) {
            let _ = writeln!(text, "% {line}");
        }
        bins.push((cell.diameters, formula));
    }
    text.push('\n');
    let given = |(name, expression, says): (&str, &str, &'static str)| Definition {
        name: name.to_owned(),
        expression: expression.to_owned(),
        says,
    };
    let definitions =
        BEFORE.into_iter().map(given).chain(DIALECT.definitions(&bins)).chain(AFTER.into_iter().map(given));
    for Definition { name, expression, says } in definitions {
        let _ = writeln!(text, "{name} {} \"{says}\"", expression.replace(' ', ""));
    }
    Ok(text)
}
