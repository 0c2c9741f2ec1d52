#!/usr/bin/env bash
# The manual as a static site, target/site/html: the pages of docs and the texts beside them, what the programs print, and the explorer if its
# page is there (target/web/explorer.html, by tools/web.sh). Links, and what pages say of files, tests, columns and keys, are checked. Opens from a file.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
target=${CARGO_TARGET_DIR:-$root/target}
site=$target/site
if ! python3 -c 'import ensurepip' 2>/dev/null; then
    apt-get update -qq && apt-get install -y -qq --no-install-recommends python3-venv >/dev/null
fi
venv=$target/site-tools
[[ -x $venv/bin/python ]] || python3 -m venv "$venv"
# as they were when the pages were last looked at; a site that others can build needs no newer ones
"$venv/bin/python" -m pip install -q -r tools/site/requirements.txt

cargo build --release --locked -p carom-cli
carom=$target/release/carom
CAROM_VERSION=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"/\1/p' Cargo.toml)
export CAROM_VERSION

python3 tools/site/sources.py "$carom"
explorer=$target/web/explorer.html
[[ -s $explorer || ! -x tools/web.sh ]] || tools/web.sh
[[ -s $explorer ]] || { echo "note: $explorer is not there, so the manual is built without the explorer"; explorer=; }
python3 tools/site/stage.py "$carom" "$site/source" ${explorer:+"$explorer"}
rm -rf "$site/html"
"$venv/bin/python" -m sphinx -q -W --keep-going -b html -d "$site/doctrees" "$site/source" "$site/html"
python3 tools/site/links.py "$site/html"
echo "the manual: $site/html/index.html, $(du -sh "$site/html" | cut -f1)"
