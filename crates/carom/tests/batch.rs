//! Batch and scalar give the same bits, on every instruction set at hand, for every law.

mod common;

use carom::batch::{BatchError, Incidence, InstructionSet, Rebound};
use carom::{Energy, ImpactError};
use common::all_laws;

/// Rows over many decades, in a fixed order (a multiplicative congruence), with captures, spins either way and standing spheres.
fn rows(n: usize) -> [Vec<f64>; 4] {
    let at = |i: usize, k: usize| ((i * 7_919 + k * 104_729) % 65_521) as f64 / 65_521.0;
    [
        (0..n).map(|i| 10f64.powf(-3.0 + 5.0 * at(i, 1))).collect(),
        (0..n).map(|i| if i % 17 == 0 { 0.0 } else { 20.0 * (at(i, 2) - 0.3) }).collect(),
        (0..n).map(|i| if i % 5 == 0 { 0.0 } else { 4e5 * (at(i, 3) - 0.5) }).collect(),
        (0..n).map(|i| 10f64.powf(-6.3 + 3.0 * at(i, 4))).collect(),
    ]
}

#[test]
fn every_row_has_the_bits_of_a_single_impact() {
    let [normal, tangential, spin, diameter] = rows(203);
    let incidence = Incidence { normal: &normal, tangential: &tangential, spin: &spin, diameter: &diameter };
    for (text, law) in all_laws() {
        let mut columns = vec![vec![1e99; 203]; 5];
        let mut energy = vec![Energy::default(); 203];
        let [n, t, w, e, mu] = &mut columns[..] else { panic!("five columns") };
        let mut rebound = Rebound {
            restitution: Some(e),
            impulse_ratio: Some(mu),
            energy: Some(&mut energy),
            ..Rebound::new(n, t, w)
        };
        let done = law.impact_batch(&incidence, &mut rebound);
        for i in 0..203 {
            match law.impact_row(&incidence, i) {
                Ok(row) => {
                    for (k, value) in row.iter().enumerate() {
                        let got = columns[k][i];
                        assert!(
                            got.to_bits() == value.to_bits()
                                || (got.is_nan() && value.is_nan())
                                || (got == 0.0 && *value == 0.0),
                            "{text}: row {i}, column {k}: {got} {value}"
                        );
                    }
                    let sum: f64 = energy[i].named().iter().map(|f| f.1).sum();
                    assert!((sum - 1.0).abs() < 1e-11);
                }
                Err(error) => {
                    assert!(columns.iter().all(|c| c[i].is_nan()), "{text}: row {i}");
                    assert!(matches!(done, Err(BatchError::Row { .. })), "{text}: {error}");
                }
            }
        }
    }
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let [normal, tangential, spin, diameter] = rows(131);
    let incidence = Incidence { normal: &normal, tangential: &tangential, spin: &spin, diameter: &diameter };
    for (text, law) in all_laws() {
        let mut seen: Option<Vec<u64>> = None;
        for set in InstructionSet::available() {
            let (mut n, mut t, mut w) = (vec![0.0; 131], vec![0.0; 131], vec![0.0; 131]);
            let _ = law.impact_batch_on(set, &incidence, &mut Rebound::new(&mut n, &mut t, &mut w));
            let bits: Vec<u64> =
                n.iter().chain(&t).chain(&w).map(|v| if v.is_nan() { 0 } else { v.to_bits() }).collect();
            if let Some(other) = &seen {
                assert!(*other == bits, "{text}: {set:?} differs");
            }
            seen = Some(bits);
        }
    }
}

#[test]
fn bad_rows_are_named_and_the_others_done() {
    let law = common::law("normal = \"constant\"\nrestitution = 0.5\nfriction = 0\n");
    let incidence =
        Incidence { normal: &[1.0, f64::NAN, -1.0, 2.0], tangential: &[0.0; 4], spin: &[0.0; 4], diameter: &[1e-5; 4] };
    let (mut n, mut t, mut w) = ([0.0; 4], [0.0; 4], [0.0; 4]);
    let done = law.impact_batch(&incidence, &mut Rebound::new(&mut n, &mut t, &mut w));
    assert_eq!(done, Err(BatchError::Row { index: 1, error: ImpactError::NotFinite }));
    assert!(n[0] == 0.5 && n[1].is_nan() && n[2].is_nan() && n[3] == 1.0);
    let short = law.impact_batch(&incidence, &mut Rebound::new(&mut n[..3], &mut t, &mut w));
    assert_eq!(short, Err(BatchError::Lengths));
}
