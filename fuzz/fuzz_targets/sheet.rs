//! Any bytes as a text table: places lie in its text, numbers are finite. `cargo fuzz run sheet`
#![no_main]

use carom_table::Sheet;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(sheet) = Sheet::read(bytes, &|name| matches!(name, "x" | "u" | "speed")) else { return };
    let mut rows = sheet.rows();
    while let Ok(Some(row)) = rows.next_row() {
        assert!(row.fields.iter().all(|f| sheet.text().get(f.place.clone()).is_some()));
        for column in 0..sheet.headings().len() {
            assert!(rows.number(column).is_ok_and(|v| v.is_none_or(f64::is_finite)) || rows.number(column).is_err());
        }
    }
});
