//! Evaluates the expressions of STAR-CCM+ and COMSOL as far as exports use them: numbers with units in brackets, names, the four
//! operations, `^`, comparisons, `&&`, `a ? b : c` and functions.

use std::collections::HashMap;

/// Values by name, `$` and `$$` included.
pub type Variables = HashMap<String, f64>;

pub fn evaluate(text: &str, variables: &Variables) -> f64 {
    let mut reader = Reader { text, variables };
    let value = reader.choice();
    assert!(reader.rest().is_empty(), "'{}' is left of an expression", reader.text);
    value
}

struct Reader<'a> {
    text: &'a str,
    variables: &'a Variables,
}

impl<'a> Reader<'a> {
    fn rest(&mut self) -> &'a str {
        self.text = self.text.trim_start();
        self.text
    }

    fn takes(&mut self, what: &str) -> bool {
        let rest = self.rest();
        let found = rest.strip_prefix(what);
        self.text = found.unwrap_or(rest);
        found.is_some()
    }

    fn wants(&mut self, what: &str) {
        assert!(self.takes(what), "'{what}' is wanted before '{}'", self.text);
    }

    fn choice(&mut self) -> f64 {
        let test = self.both();
        if !self.takes("?") {
            return test;
        }
        let yes = self.choice();
        self.wants(":");
        let no = self.choice();
        if test != 0.0 { yes } else { no }
    }

    fn both(&mut self) -> f64 {
        let mut value = self.comparison();
        while self.takes("&&") {
            let other = self.comparison();
            value = f64::from(value != 0.0 && other != 0.0);
        }
        value
    }

    fn comparison(&mut self) -> f64 {
        let value = self.sum();
        if self.takes("<") {
            f64::from(value < self.sum())
        } else if self.takes(">") {
            f64::from(value > self.sum())
        } else {
            value
        }
    }

    fn sum(&mut self) -> f64 {
        let mut value = self.product();
        loop {
            if self.takes("+") {
                value += self.product();
            } else if self.takes("-") {
                value -= self.product();
            } else {
                return value;
            }
        }
    }

    fn product(&mut self) -> f64 {
        let mut value = self.signed();
        loop {
            if self.takes("*") {
                value *= self.signed();
            } else if self.takes("/") {
                value /= self.signed();
            } else {
                return value;
            }
        }
    }

    fn signed(&mut self) -> f64 {
        if self.takes("-") { -self.signed() } else { self.power() }
    }

    fn power(&mut self) -> f64 {
        let value = self.atom();
        if self.takes("^") { value.powf(self.signed()) } else { value }
    }

    fn atom(&mut self) -> f64 {
        if self.takes("(") {
            let value = self.choice();
            self.wants(")");
            return value;
        }
        let rest = self.rest();
        if rest.starts_with(|c: char| c.is_ascii_digit()) {
            return self.number(rest);
        }
        let end = rest.find(|c: char| !(c.is_alphanumeric() || "$._".contains(c))).unwrap_or(rest.len());
        let (name, after) = rest.split_at(end);
        self.text = after;
        if self.takes("(") {
            return self.function(name);
        }
        *self.variables.get(name).unwrap_or_else(|| panic!("'{name}' is not defined"))
    }

    fn number(&mut self, rest: &'a str) -> f64 {
        let length = (1..=rest.len()).rev().find(|n| rest.get(..*n).is_some_and(|t| t.parse::<f64>().is_ok()));
        let (digits, after) = rest.split_at(length.expect("a digit is a number"));
        self.text = after;
        if self.takes("[") {
            let unit = self.text.split(']').next().unwrap_or_default();
            assert!(["m", "m/s"].contains(&unit), "unit '{unit}'");
            self.text = &self.text[unit.len() + 1..];
        }
        digits.parse().expect("a number")
    }

    fn function(&mut self, name: &str) -> f64 {
        let mut given = vec![self.choice()];
        while self.takes(",") {
            given.push(self.choice());
        }
        self.wants(")");
        match (name, &given[..]) {
            ("sqrt", [x]) => x.sqrt(),
            ("abs" | "mag", [x]) => x.abs(),
            ("sin", [x]) => x.sin(),
            ("tan", [x]) => x.tan(),
            ("asin", [x]) => x.asin(),
            ("log", [x]) => x.ln(),
            ("pow", [x, y]) => x.powf(*y),
            ("min", [x, y]) => x.min(*y),
            ("max", [x, y]) => x.max(*y),
            ("if", [test, yes, no]) => {
                if *test != 0.0 {
                    *yes
                } else {
                    *no
                }
            }
            _ => panic!("{name} of {} arguments", given.len()),
        }
    }
}

#[test]
fn arithmetic_is_the_usual_one() {
    let variables = Variables::from([("$A".to_owned(), 3.0), ("fpt.vx".to_owned(), -2.0)]);
    for (text, value) in [
        ("1 + 2*3 - 4/8", 6.5),
        ("-2^2", -4.0),
        ("(2[m]/1e-1[m])^(-1) + 1", 1.05),
        ("($A > 2 && 1 < 2) ? pow($A, 2) : (0)", 9.0),
        ("($A > 4) ? 1 : (($A < 2) ? 2 : (5))", 5.0),
        ("if(fpt.vx<0,abs(fpt.vx),0)", 2.0),
        ("max(0, min(1, $A*(-1 + 2)))", 1.0),
    ] {
        assert_eq!(evaluate(text, &variables), value, "{text}");
    }
}
