#!/usr/bin/env bash
# The explorer, built and tested: every law has the native bits as WebAssembly, and the page in a real browser says what the command says.
# What is missing (Node, Chromium, a C compiler) is installed by apt, as root. Pictures of the page: target/web/pictures.
set -euo pipefail
cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
web=$target/web
missing=()
command -v node >/dev/null || missing+=(nodejs)
command -v chromium >/dev/null || missing+=(chromium)
command -v cc >/dev/null || missing+=(gcc libc6-dev)
if [ ${#missing[@]} -gt 0 ]; then apt-get update -qq && apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null; fi

# with carom in it, for the Python that the page offers to copy
python=${CAROM_PYTHON:-$target/python/bin/python}
"$python" -c "import carom" 2>/dev/null || tools/python.sh

tools/web.sh
cargo run --quiet --release --locked -p carom-web --example bits >"$web/bits.txt"
node web/test/bits.mjs "$target/wasm32-unknown-unknown/web/carom_web.wasm" "$web/bits.txt"
cargo build --quiet --release --locked -p carom-cli -p carom-c
node web/test/page.mjs "$web/explorer.html" "$target/release/carom" "$target/release/libcarom_c.a" crates/carom-c/include/carom.h "$python" "$web/pictures"
