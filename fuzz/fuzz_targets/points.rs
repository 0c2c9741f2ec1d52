//! Any bytes as measured points: they are read or refused, with a place in the text. `cargo fuzz run points`
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = carom_lab::points::text(bytes) else { return };
    if let Err(error) = carom_lab::points::read(&text) {
        let _ = error.located("points.csv", &text);
    }
    let _ = carom_lab::fit::Data::from_csv("points.csv", &text, Some(1e-5));
});
