//! Formulas as definitions, name by name, in the dialect of a program.

use super::formula::{Basis, Formula, Normal, SLOWEST, Scale, Tangent, Upper};
use super::{Span, number};

/// How a program writes it.
pub(super) struct Dialect {
    /// A variable of ours, by its name.
    pub named: fn(&str) -> String,
    /// a to the power b.
    pub power: fn(&str, &str) -> String,
    /// If a then b else c.
    pub choose: fn(&str, &str, &str) -> String,
    /// A speed (m/s) with its unit.
    pub speed: fn(f64) -> String,
    /// A length (m) with its unit.
    pub length: fn(f64) -> String,
    /// Names of ours: normal speed, angle (rad), then V, u, the upper end's weight and e of a bin, and e and e_t of all.
    pub names: Names,
    /// The particle's diameter.
    pub diameter: &'static str,
}

/// Names of ours.
pub(super) struct Names {
    pub normal_speed: &'static str,
    pub angle: &'static str,
    pub scale: &'static str,
    pub variable: &'static str,
    pub share: &'static str,
    pub bin: &'static str,
    pub restitution: &'static str,
    pub tangential: &'static str,
}

/// A variable to define.
pub(super) struct Definition {
    pub name: String,
    pub expression: String,
    pub says: &'static str,
}

impl Dialect {
    /// e and e_t over all bins, and what they need; the bins in rising order.
    pub fn definitions(&self, bins: &[(Span, Formula)]) -> Vec<Definition> {
        let mut all = Vec::new();
        for (n, (_, formula)) in bins.iter().enumerate() {
            self.bin(&mut all, n + 1, &formula.normal);
        }
        let of_bins: Vec<(Span, String)> = bins
            .iter()
            .enumerate()
            .map(|(n, b)| (b.0, (self.named)(&format!("{}{}", self.names.bin, n + 1))))
            .collect();
        all.push(Definition {
            name: self.names.restitution.to_owned(),
            expression: self.by_diameter(&of_bins),
            says: "normal restitution, 0 for a capture",
        });
        let of_bins: Vec<(Span, String)> = bins.iter().map(|b| (b.0, self.tangent(&b.1.tangent))).collect();
        all.push(Definition {
            name: self.names.tangential.to_owned(),
            expression: self.by_diameter(&of_bins),
            says: "tangential restitution",
        });
        all
    }

    /// The expression of a particle's bin; equal neighbours are one.
    fn by_diameter(&self, bins: &[(Span, String)]) -> String {
        let Some((last, others)) = bins.split_last() else { return "0".to_owned() };
        let mut expression = last.1.clone();
        for (span, of_bin) in others.iter().rev() {
            if *of_bin != expression {
                let test = format!("{} < {}", self.diameter, (self.length)(span.to));
                expression = (self.choose)(&test, of_bin, &expression);
            }
        }
        expression
    }

    fn bin(&self, all: &mut Vec<Definition>, n: usize, normal: &Normal) {
        let expression = match normal {
            Normal::Stick => "0".to_owned(),
            Normal::ByAngle(c) => clamped("0", &self.polynomial(c, self.names.angle)),
            Normal::BySpeed { scale, captures, exhausted, basis, squared, upper } => {
                let says = if *captures { "capture velocity, m/s" } else { "reference speed, m/s" };
                let velocity = format!("{}{n}", self.names.scale);
                all.push(Definition { name: velocity.clone(), expression: self.scale(scale), says });
                let variable = format!("{}{n}", self.names.variable);
                let expression = self.variable(*basis, &velocity, *captures);
                all.push(Definition { name: variable.clone(), expression, says: "argument of the polynomial" });
                let mut square = self.polynomial(squared, &variable);
                if let Some(upper) = upper {
                    let name = format!("{}{n}", self.names.share);
                    let share = (self.named)(&name);
                    all.push(Definition { name, expression: self.share(upper), says: "weight of the bin's upper end" });
                    let of_upper = self.polynomial(&upper.squared, &variable);
                    square = format!("(1 - {share})*({square}) + {share}*({of_upper})");
                }
                let e = format!("sqrt({})", clamped("0", &square));
                let normal_speed = (self.named)(self.names.normal_speed);
                let low = captures.then(|| format!("{normal_speed} > {}", (self.named)(&velocity)));
                let high = exhausted.map(|v| format!("{normal_speed} < {}", (self.speed)(v)));
                let tests: Vec<String> = low.into_iter().chain(high).collect();
                if tests.is_empty() { e } else { (self.choose)(&tests.join(" && "), &e, "0") }
            }
        };
        all.push(Definition {
            name: format!("{}{n}", self.names.bin),
            expression,
            says: "normal restitution in a bin",
        });
    }

    fn scale(&self, scale: &Scale) -> String {
        let at = (self.speed)(scale.at);
        if scale.exponent == 0.0 {
            return at;
        }
        let ratio = format!("{}/{}", self.diameter, (self.length)(scale.reference));
        format!("{at}*{}", (self.power)(&ratio, &number(scale.exponent)))
    }

    fn variable(&self, basis: Basis, velocity: &str, captures: bool) -> String {
        let floor = if captures { "1".to_owned() } else { number(SLOWEST) };
        let x = format!("max({floor}, {}/{})", (self.named)(self.names.normal_speed), (self.named)(velocity));
        match basis {
            Basis::Power(1.0) => format!("{x} - 1"),
            Basis::Power(p) => format!("{} - 1", (self.power)(&x, &number(p))),
            Basis::Logarithm => format!("log({x})"),
        }
    }

    fn share(&self, upper: &Upper) -> String {
        let ratio = format!("{}/{}", self.diameter, (self.length)(upper.from));
        clamped("0", &format!("log({ratio})*{}", number(upper.per_ln)))
    }

    fn tangent(&self, tangent: &Tangent) -> String {
        match tangent {
            Tangent::Friction { friction, cap } => format!(
                "1 - min({}*(1 + {})*tan({}), {})",
                number(*friction),
                (self.named)(self.names.restitution),
                (self.named)(self.names.angle),
                number(*cap)
            ),
            Tangent::ByAngle(c) => clamped("-1", &self.polynomial(c, self.names.angle)),
        }
    }

    /// c₀ + x(c₁ + x(c₂ + …)).
    fn polynomial(&self, coefficients: &[f64], name: &str) -> String {
        let x = (self.named)(name);
        let Some((last, others)) = coefficients.split_last() else { return "0".to_owned() };
        others.iter().rev().fold(number(*last), |inner, c| {
            let inner = if inner.contains(' ') || inner.starts_with('-') { format!("({inner})") } else { inner };
            if *c == 0.0 { format!("{x}*{inner}") } else { format!("{} + {x}*{inner}", number(*c)) }
        })
    }
}

fn clamped(low: &str, value: &str) -> String {
    format!("max({low}, min(1, {value}))")
}
