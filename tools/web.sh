#!/usr/bin/env bash
# The explorer: the kernel as WebAssembly and the page it is in, target/web/explorer.html, one file that works offline.
#
# rustup's Rust brings a library for WebAssembly if it was asked to (rustup target add wasm32-unknown-unknown); else Debian's compiler with
# the sources of its library is fetched into target/web and used from there. Nothing is installed. Needs apt-get, python3 and cargo.
set -euo pipefail
cd "$(dirname "$0")/.."
web=${CARGO_TARGET_DIR:-$PWD/target}/web
target=wasm32-unknown-unknown
mkdir -p "$web"

build() { cargo build --locked --quiet --profile web --target $target -p carom-web "$@"; }

if [[ -d "$(rustc --print sysroot)/lib/rustlib/$target" ]]; then
    build
else
    tools=$web/toolchain
    if [[ ! -x $tools/usr/bin/rustc ]]; then
        apt-get update -qq
        version=$(apt-cache depends libstd-rust-web-dev | sed -n 's/.*Depends: \(libstd-rust-web-[0-9.]*\)$/\1/p')
        llvm=$(apt-cache depends "$version" | sed -n 's/.*Depends: libllvm\([0-9]*\)$/\1/p')
        mkdir -p "$web/deb"
        (cd "$web/deb" && apt-get download -qq rust-web-src rustc-web "$version" libstd-rust-web-dev "libllvm$llvm" "lld-$llvm")
        for deb in "$web"/deb/*.deb; do dpkg -x "$deb" "$tools"; done
        rm -r "$web/deb"
    fi
    printf '#!/bin/sh\nexport LD_LIBRARY_PATH=%s/usr/lib/x86_64-linux-gnu\nexec %s/usr/bin/rustc "$@"\n' "$tools" "$tools" > "$web/rustc"
    chmod +x "$web/rustc"
    # the library is built with the kernel, from the sources that came with the compiler
    linker=$(echo "$tools"/usr/lib/llvm-*/bin/wasm-ld)
    RUSTC=$web/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$linker \
        build -Zbuild-std=std,panic_abort -Zbuild-std-features=optimize_for_size
fi
tools/web-page.py "${CARGO_TARGET_DIR:-target}/$target/web/carom_web.wasm" "$web/explorer.html"
