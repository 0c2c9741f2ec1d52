//! Columns give what single impacts give, row by row.

mod common;

use carom_c::*;
use common::*;
use std::ptr::{null, null_mut};

#[test]
fn columns_are_single_impacts() {
    let n = 1000;
    for name in ["glass", "steel", "table"] {
        let law = law(WALLS, Some(name)).expect("a law");
        let ins = impacts(n);
        // a speed in four leads away
        let normal: Vec<f64> = ins.iter().map(|i| i.velocity[1] + 5.0).collect();
        let tangential: Vec<f64> = ins.iter().map(|i| i.velocity[0]).collect();
        let spin: Vec<f64> = ins.iter().map(|i| i.spin[2]).collect();
        let diameter: Vec<f64> = ins.iter().map(|i| i.diameter).collect();
        let mut out = vec![vec![7.0; n]; 5];
        let [a, b, c, e, ratio] = out.as_mut_slice() else { unreachable!("five") };
        let mut failed = 0;
        // SAFETY: a law and columns of the length said.
        let status = unsafe {
            carom_impact_columns(
                law,
                n,
                normal.as_ptr(),
                tangential.as_ptr(),
                spin.as_ptr(),
                diameter.as_ptr(),
                a.as_mut_ptr(),
                b.as_mut_ptr(),
                c.as_mut_ptr(),
                e.as_mut_ptr(),
                ratio.as_mut_ptr(),
                &raw mut failed,
            )
        };
        let first = normal.iter().position(|v| *v <= 0.0);
        assert_eq!((status, Some(failed)), (Status::NotApproaching, first));
        assert!(message().starts_with(&format!("impact {failed}: the sphere does not approach")), "{}", message());
        for i in 0..n {
            let one = ImpactIn {
                diameter: diameter[i],
                velocity: [tangential[i], -normal[i], 0.0],
                spin: [0.0, 0.0, -spin[i]],
                ..impact()
            };
            let mut met = blank();
            // SAFETY: a law and structs of the size they say.
            let status = unsafe { carom_impact(law, &raw const one, &raw mut met) };
            let wanted = match (status, met.fate) {
                (Status::Ok, 0) => [met.velocity[1], met.velocity[0], -met.spin[2], met.restitution, met.impulse_ratio],
                (Status::Ok, _) => [0.0, 0.0, 0.0, 0.0, f64::NAN],
                _ => [f64::NAN; 5],
            };
            let got = [a[i], b[i], c[i], e[i], ratio[i]];
            assert!(
                got.iter().zip(&wanted).all(|(x, y)| x == y || x.is_nan() && y.is_nan()),
                "{name} {i}: {got:?} {wanted:?}"
            );
        }
        // SAFETY: used no more.
        unsafe { carom_law_free(law) };
    }
}

#[test]
fn columns_may_be_absent_where_said() {
    let law = law(WALLS, Some("glass")).expect("a law");
    let one = [1.0];
    let (mut a, mut b, mut c) = ([0.0], [0.0], [0.0]);
    let (size, p) = ([9e-5], one.as_ptr());
    let mut failed = 9;
    // SAFETY: a law, columns of one number, or NULL.
    unsafe {
        let mut columns = |n, normal: *const f64, out: *mut f64, failed: *mut usize| {
            let (b, c) = ((&raw mut b).cast(), (&raw mut c).cast());
            carom_impact_columns(law, n, normal, p, p, size.as_ptr(), out, b, c, null_mut(), null_mut(), failed)
        };
        assert_eq!(columns(1, p, a.as_mut_ptr(), &raw mut failed), Status::Ok, "{}", message());
        assert_eq!(failed, 1);
        assert!(a[0] > 0.5 && a[0] < 1.0);
        assert_eq!(columns(0, null(), null_mut(), null_mut()), Status::Ok);
        assert_eq!(columns(1, null(), a.as_mut_ptr(), null_mut()), Status::BadArgument);
        assert_eq!(columns(1, p, null_mut(), null_mut()), Status::BadArgument);
        assert_eq!(columns(usize::MAX, p, a.as_mut_ptr(), null_mut()), Status::BadArgument);
        carom_law_free(law);
    }
    let nothing = null_mut();
    // SAFETY: NULL, an error.
    let status =
        unsafe { carom_impact_columns(null(), 1, p, p, p, p, nothing, nothing, nothing, nothing, nothing, null_mut()) };
    assert_eq!(status, Status::BadArgument);
}
