//! When a falling distance reaches zero, also for a sphere that touches the wall already.

use super::bernstein::Bernstein;

/// Whether a path surely misses a flat wall: every control point leads away, or it starts clear of the wall and its lowest
/// control point is. `gap` is the distance at the start, `lowest` the least change of it; up to `slack` counts as touching.
#[inline(always)]
pub fn misses(gap: f64, lowest: f64, slack: f64) -> bool {
    (lowest > 0.0) | ((gap > slack) & (gap + lowest > slack))
}

/// The first θ in [0, 1] at which the distance `start` + `change`(θ) comes down to zero.
///
/// A sphere that touches (`start` ≤ `slack`) is in contact at once if it approaches; if it leaves, the next contact is
/// where it comes back to the distance it left from, found after dividing the root at θ = 0 out, so that neither
/// rounding nor a very low bounce makes it sink or hover.
#[inline(always)]
pub fn first_contact<const N: usize>(
    start: f64,
    change: &Bernstein<N>,
    slack: f64,
    mut accept: impl FnMut(f64) -> bool,
) -> Option<f64> {
    let touches = start <= slack;
    let gap = if touches { change.deflated() } else { change.scaled(1.0, start) };
    if touches && gap.leads_down() && accept(0.0) {
        return Some(0.0);
    }
    gap.first_descent(accept)
}

/// [`first_contact`] of a surface that ends somewhere. A sphere deep within its clearance is either beside it, and meets it
/// when it comes from outside, or, where `accept` takes its place, in it: then it is in contact at once if it goes deeper.
pub fn overlapping_contact<const N: usize>(
    start: f64,
    change: &Bernstein<N>,
    slack: f64,
    mut accept: impl FnMut(f64) -> bool,
) -> Option<f64> {
    if start >= -slack {
        return first_contact(start, change, slack, accept);
    }
    if change.leads_down() && accept(0.0) {
        return Some(0.0);
    }
    change.scaled(1.0, start).first_descent(accept)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_low_bounce_lasts_as_long_as_it_should() {
        // d(θ) = vθ − gθ²/2 with v = 1e-12: back at 2v/g, though the start is a rounding error below the wall
        let (v, g) = (1e-12, 1.0);
        let monomial = |i: f64| v * i / 4.0 - 0.5 * g * i * (i - 1.0) / 12.0;
        let change = Bernstein([0.0, 1.0, 2.0, 3.0, 4.0].map(monomial));
        let t = first_contact(-1e-18, &change, 1e-15, |_| true).unwrap();
        assert!((t / 2e-12 - 1.0).abs() < 1e-9, "{t:e}");
    }

    #[test]
    fn touching_and_approaching_is_contact_now_touching_and_leaving_is_not() {
        let down = Bernstein([0.0, -1.0, -2.0, -3.0, -4.0]);
        assert_eq!(first_contact(1e-18, &down, 1e-15, |_| true), Some(0.0));
        let up = Bernstein([0.0, 1.0, 2.0, 3.0, 4.0]);
        assert_eq!(first_contact(-1e-18, &up, 1e-15, |_| true), None);
        // at rest and pressed: in contact now; at rest and pulled away: not
        let pressed = Bernstein([0.0, 0.0, -1.0, -2.0, -3.0]);
        assert_eq!(first_contact(0.0, &pressed, 1e-15, |_| true), Some(0.0));
        let pulled = Bernstein([0.0, 0.0, 1.0, 2.0, 3.0]);
        assert_eq!(first_contact(0.0, &pulled, 1e-15, |_| true), None);
    }
}
