#!/usr/bin/env bash
# Builds carom for C and installs it: include/carom.h, lib/libcarom.so, lib/libcarom.a, lib/pkgconfig/carom.pc.
#
#   crates/carom-c/install.sh [--prefix DIR] [--no-build]
#
# DIR is /usr/local if not given; DESTDIR is put before it, for packagers. --no-build installs what target/release has.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
prefix=/usr/local
build=yes
while [ $# -gt 0 ]; do
    case $1 in
    --prefix) prefix=${2:?a folder is wanted after --prefix}; shift 2 ;;
    --prefix=*) prefix=${1#*=}; shift ;;
    --no-build) build=no; shift ;;
    *) echo "install.sh: unknown option '$1'; known are --prefix DIR and --no-build" >&2; exit 2 ;;
    esac
done
mkdir -p "${DESTDIR:-}$prefix"
case $prefix in /*) ;; *) prefix=$(cd "$prefix" && pwd) ;; esac
target=${CARGO_TARGET_DIR:-$root/target}
if [ $build = yes ]; then
    (cd "$root" && cargo build --release --locked -p carom-c --lib)
fi
version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"/\1/p' "$root/Cargo.toml")
to=${DESTDIR:-}$prefix
install -d "$to/include" "$to/lib/pkgconfig"
install -m 644 "$here/include/carom.h" "$to/include/carom.h"
install -m 644 "$target/release/libcarom_c.a" "$to/lib/libcarom.a"
case $(uname -s) in
Darwin)
    install -m 755 "$target/release/libcarom_c.dylib" "$to/lib/libcarom.dylib"
    install_name_tool -id "$prefix/lib/libcarom.dylib" "$to/lib/libcarom.dylib"
    private="-lSystem -lc -lm"
    ;;
*)
    install -m 755 "$target/release/libcarom_c.so" "$to/lib/libcarom.so.$version"
    ln -sf "libcarom.so.$version" "$to/lib/libcarom.so.0"
    ln -sf libcarom.so.0 "$to/lib/libcarom.so"
    private="-lgcc_s -lutil -lrt -lpthread -lm -ldl -lc"
    ;;
esac
sed -e "s|@prefix@|$prefix|" -e "s|@version@|$version|" -e "s|@private@|$private|" "$here/carom.pc.in" \
    >"$to/lib/pkgconfig/carom.pc"
echo "carom $version is in $to: pkg-config --cflags --libs carom, with PKG_CONFIG_PATH=$prefix/lib/pkgconfig if need be"
