//! Any bytes as a flow table, in each of its forms: it is read or refused, never a panic. `cargo fuzz run table`
#![no_main]

use carom_track::flow::Table;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (u8, &[u8])| {
    let (kind, bytes) = input;
    let name = ["f.csv", "f.vtk", "f.vti", "f.vtr"][usize::from(kind % 4)];
    let Ok(table) = Table::from_file(name, bytes) else { return };
    let [low, high] = table.bounds();
    let middle = [0, 1, 2].map(|c| 0.5 * low[c] + 0.5 * high[c]);
    let velocity = table.velocity(middle);
    // what is read is finite; only sums of the largest numbers are not
    let large = |x: &f64| x.abs() > 1e100 || !x.is_finite();
    assert!(velocity.iter().all(|c| c.is_finite()) || low.iter().chain(&high).any(large) || velocity.iter().any(large));
});
