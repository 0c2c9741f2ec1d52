//! Any bytes as a case of Fluent's and its data: a mesh that holds together with finite fields, or a refusal. `cargo fuzz run fluent`
#![no_main]

use carom_cfd::{check, fluent::{Options, from_bytes}};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (bool, &[u8], &[u8])| {
    let (with_data, case, data) = input;
    // a case that is read, to get at the data, or any
    let whole = include_bytes!("../../crates/carom-cfd/tests/fluent/turned.cas.h5");
    let case = if with_data { whole.to_vec() } else { case.to_vec() };
    let Ok(snapshot) = from_bytes(case, with_data.then(|| data.to_vec()), &Options::default()) else { return };
    assert_eq!(check::snapshot(&snapshot), Ok(()));
});
