//! Numbers as a person reads them.

/// `value` to at most `digits` significant digits without trailing zeros; an exponent only where plain digits would be long.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let Some((mantissa, exponent)) = scientific.split_once('e') else {
        return scientific;
    };
    let exponent: i32 = exponent.parse().unwrap_or_default();
    if (-4..6).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or_default();
        trim(&format!("{value:.decimals$}")).to_owned()
    } else {
        format!("{}e{exponent}", trim(mantissa))
    }
}

/// Without the zeros that end a decimal fraction.
pub fn trim(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

/// `exponent` in superscript digits, with a superscript minus.
pub fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    exponent.to_string().chars().map(|c| c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits_are_short() {
        for (value, text) in [
            (0.1 + 0.2, "0.3"),
            (0.0, "0"),
            (90.0, "90"),
            (1.0e-6, "1e-6"),
            (-0.000_123_456_789, "-0.000123457"),
            (123_456.7, "123457"),
            (1.5e9, "1.5e9"),
            (0.999_999_99, "1"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(significant(value, 6), text);
        }
    }

    #[test]
    fn superscripts_have_a_raised_minus() {
        assert_eq!(superscript(-12), "⁻¹²");
        assert_eq!(superscript(3), "³");
    }
}
