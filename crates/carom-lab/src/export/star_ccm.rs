//! Simcenter STAR-CCM+: user field functions for the restitutions of a Lagrangian phase at a wall in mode Rebound.
//!
//! A field function is a C-like expression; `$Name` is a scalar, `$$Name` a vector, `a ? b : c` chooses (STAR-CCM+ User Guide, "Expression
//! Syntax", "Operators and Functions"). `ParticleIncidenceAngle` is the angle of the path from the wall in radians: the guide's erosion tutorial
//! gives Forder's polynomials to the restitution coefficients in it. Sticking is a matter of mode: Composite takes a probability for
//! Stick, here 1 or 0. The text was checked against the guide and by evaluating it, not in the program.

use super::expressions::{Definition, Dialect, Names};
use super::{Request, formula, number};
use crate::error::LabError;
use std::fmt::Write as _;

const DIALECT: Dialect = Dialect {
    named: |name| format!("${name}"),
    power: |a, b| format!("pow({a}, {b})"),
    choose: |a, b, c| format!("({a}) ? {b} : ({c})"),
    speed: number,
    length: number,
    names: Names {
        normal_speed: "CaromNormalSpeed",
        angle: "ParticleIncidenceAngle",
        scale: "CaromVelocity",
        variable: "CaromArgument",
        share: "CaromShare",
        bin: "CaromRestitution",
        restitution: "CaromNormalRestitution",
        tangential: "CaromTangentialRestitution",
    },
    diameter: "$ParticleDiameter",
};

pub(super) fn write(request: &Request, degree: usize) -> Result<String, LabError> {
    let mut text = request.heading(
        "#",
        &[
            "Simcenter STAR-CCM+: scalar user field functions, SI units, in this order",
            "mode Composite: Rebound with the last two restitutions, Stick with probability CaromStick",
        ],
    );
    let mut bins = Vec::new();
    for cell in request.cells() {
        let (formula, stuck, deviation) = formula::fit(request.law, &cell, degree)?;
        let _ = writeln!(text, "\n# diameter {}", cell.diameters.told_in(1e6, "um"));
        for line in deviation.lines(stuck) {
            let _ = writeln!(text, "# {line}");
        }
        bins.push((cell.diameters, formula));
    }
    let first = Definition {
        name: "CaromNormalSpeed".to_owned(),
        expression: "mag($$ParticleVelocity)*sin($ParticleIncidenceAngle)".to_owned(),
        says: "normal speed, m/s",
    };
    let last = Definition {
        name: "CaromStick".to_owned(),
        expression: "($CaromNormalRestitution > 0) ? 0 : 1".to_owned(),
        says: "probability of Stick",
    };
    for definition in [first].into_iter().chain(DIALECT.definitions(&bins)).chain([last]) {
        let Definition { name, expression, says } = definition;
        let _ = write!(text, "\n# {says}\n{name}\n    {expression}\n");
    }
    Ok(text)
}
