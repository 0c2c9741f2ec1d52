//! Where an axis is divided, and tidy numbers for it.

use carom_table::number::{self, superscript};

/// A division of an axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    /// The shown value.
    pub value: f64,
    /// Its text; none for the small divisions between.
    pub label: Option<String>,
}

/// Divisions of a linear axis: multiples of 1, 2 or 5 times a power of ten, about `count` of them.
pub(super) fn linear(low: f64, high: f64, count: usize) -> Vec<Tick> {
    let rough = (high - low) / count.max(1) as f64;
    if !rough.is_finite() || rough <= 0.0 {
        return Vec::new();
    }
    let mut exponent = rough.log10().floor() as i32;
    // The step nearest by ratio.
    let digit = match decimal(rough, -exponent) {
        m if m < 1.5 => 1,
        m if m < 3.5 => 2,
        m if m < 7.5 => 5,
        _ => {
            exponent += 1;
            1
        }
    };
    let step = decimal(f64::from(digit), exponent);
    let slack = 1e-9;
    let (first, last) = ((low / step - slack).ceil(), (high / step + slack).floor());
    let largest = low.abs().max(high.abs());
    let mut ticks = Vec::new();
    let mut index = first;
    while index <= last && ticks.len() < 1000 {
        // Multiples of the step, not sums, so that no rounding builds up.
        let value = decimal(index * f64::from(digit), exponent);
        ticks.push(Tick { value, label: Some(linear_label(value, exponent, largest)) });
        index += 1.0;
    }
    ticks
}

/// `mantissa` times ten to a whole power, rounded once: a division for the negative powers, which have no exact `f64`.
fn decimal(mantissa: f64, exponent: i32) -> f64 {
    if exponent < 0 { mantissa / 10_f64.powi(-exponent) } else { mantissa * 10_f64.powi(exponent) }
}

fn linear_label(value: f64, step_exponent: i32, largest: f64) -> String {
    let scale = largest.log10().floor() as i32;
    let text = if value.abs() < decimal(1e-6, step_exponent) {
        "0".to_owned()
    } else if scale >= 6 || step_exponent < -5 {
        let decimals = usize::try_from(scale - step_exponent).unwrap_or_default();
        let mantissa = format!("{:.decimals$}", decimal(value, -scale));
        format!("{}×10{}", number::trim(&mantissa), superscript(scale))
    } else {
        let decimals = usize::try_from(-step_exponent).unwrap_or_default();
        format!("{value:.decimals$}")
    };
    text.replace('-', "−")
}

/// Divisions of a logarithmic axis from `low` to `high` (both positive): the powers of ten, or 1, 2, 5 times them and
/// more on a short axis, are labelled; the other whole multiples are small divisions.
pub(super) fn log(low: f64, high: f64, count: usize) -> Vec<Tick> {
    if !(low > 0.0 && high > low && high.is_finite()) {
        return Vec::new();
    }
    let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
    let decades = high.log10() - low.log10();
    let stride = (decades / count.max(1) as f64).ceil().max(1.0) as i32;
    let inside = |v: f64| v >= low * (1.0 - 1e-9) && v <= high * (1.0 + 1e-9);
    let whole = (first..=last).filter(|e| inside(decimal(1.0, *e))).count();
    // the fewest digits that label three divisions
    let choices: [&[i32]; 4] = [&[1], &[1, 2, 5], &[1, 2, 3, 5], &[1, 2, 3, 4, 5, 6, 8]];
    let choices = if whole < 3 && decades < 2.0 { &choices[1..] } else { &choices[..1] };
    let enough = |digits: &&&[i32]| {
        let exponents = || (first..=last).flat_map(|e| digits.iter().map(move |d| decimal(f64::from(*d), e)));
        exponents().filter(|v| inside(*v)).count() >= 3
    };
    let labelled = choices.iter().find(enough).or(choices.last()).copied().unwrap_or(&[1]);
    let plain = first >= -4 && last <= 5;
    let mut ticks = Vec::new();
    for exponent in first..=last {
        for digit in 1..=9 {
            let value = decimal(f64::from(digit), exponent);
            let named = labelled.contains(&digit) && exponent.rem_euclid(stride) == 0;
            // Between decades while each is labelled, then the decades themselves while they are not too many.
            let small = stride == 1 || (digit == 1 && stride <= 10);
            if !inside(value) || !(named || small) {
                continue;
            }
            ticks.push(Tick { value, label: named.then(|| log_label(digit, exponent, plain)) });
        }
    }
    if ticks.iter().filter(|t| t.label.is_some()).count() < 2 {
        return linear(low, high, count);
    }
    ticks
}

fn log_label(digit: i32, exponent: i32, plain: bool) -> String {
    if plain {
        let decimals = usize::try_from(-exponent).unwrap_or_default();
        format!("{:.decimals$}", decimal(f64::from(digit), exponent))
    } else if digit == 1 {
        format!("10{}", superscript(exponent))
    } else {
        format!("{digit}×10{}", superscript(exponent))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().filter_map(|t| t.label.as_deref()).collect()
    }

    #[test]
    fn linear_numbers_are_tidy() {
        assert_eq!(labels(&linear(0.0, 1.0, 5)), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(&linear(-0.3, 0.3, 6)), ["−0.3", "−0.2", "−0.1", "0", "0.1", "0.2", "0.3"]);
        assert_eq!(labels(&linear(0.0, 3.0e-7, 3)), ["0", "1×10⁻⁷", "2×10⁻⁷", "3×10⁻⁷"]);
        assert_eq!(labels(&linear(0.0, 2.0e9, 4)), ["0", "0.5×10⁹", "1×10⁹", "1.5×10⁹", "2×10⁹"]);
        assert_eq!(linear(0.0, 0.6, 6)[3].value, 0.3);
    }

    #[test]
    fn log_numbers_are_decades_or_one_two_five() {
        assert_eq!(labels(&log(0.01, 30.0, 8)), ["0.01", "0.1", "1", "10"]);
        assert_eq!(labels(&log(1e-8, 1.0, 10))[..2], ["10⁻⁸", "10⁻⁷"]);
        assert_eq!(labels(&log(0.9, 30.0, 8)), ["1", "2", "5", "10", "20"]);
        assert_eq!(labels(&log(3.1, 4.2, 5)), ["3.2", "3.4", "3.6", "3.8", "4.0", "4.2"]);
        assert_eq!(labels(&log(1e-30, 1e30, 8)).len(), 7);
        assert!(log(1e-300, 1e300, 8).len() < 20);
        assert!(log(-1.0, 1.0, 5).is_empty());
    }
}
