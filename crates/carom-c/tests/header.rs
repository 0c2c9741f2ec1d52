//! `include/carom.h` is what the source says. `CAROM_HEADER=overwrite cargo test -p carom-c --test header` writes it anew.

use std::path::Path;

/// In the order of the header.
const SOURCES: [&str; 6] = ["status.rs", "impact.rs", "law.rs", "calls.rs", "columns.rs", "names.rs"];

fn generated(root: &Path) -> String {
    let config = cbindgen::Config::from_file(root.join("cbindgen.toml")).expect("cbindgen.toml");
    let builder = SOURCES.iter().fold(cbindgen::Builder::new().with_config(config), |builder, file| {
        builder.with_src(root.join("src").join(file))
    });
    let mut text = Vec::new();
    builder.generate().expect("bindings").write(&mut text);
    String::from_utf8(text).expect("text")
}

#[test]
fn the_header_is_current() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("include/carom.h");
    let wanted = generated(root);
    if std::env::var_os("CAROM_HEADER").is_some_and(|v| v == "overwrite") {
        std::fs::write(&path, &wanted).expect("it can be written");
    }
    let there = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        there == wanted,
        "include/carom.h is not current: CAROM_HEADER=overwrite cargo test -p carom-c --test header"
    );
}
