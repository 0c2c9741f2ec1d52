//! The shared library's own name: programs look for `libcarom.so.0`, which `install.sh` puts beside `libcarom.so`.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let unix = std::env::var("CARGO_CFG_TARGET_FAMILY").is_ok_and(|f| f.split(',').any(|f| f == "unix"));
    let apple = std::env::var("CARGO_CFG_TARGET_VENDOR").is_ok_and(|v| v == "apple");
    if unix && !apple {
        // the number is the binary interface's: it changes when programs must be compiled anew
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,libcarom.so.0");
    }
}
