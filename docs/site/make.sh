#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes a site of the Markdown pages, with a search: docs/site/make.sh [FOLDER], build/site without one. It needs no server: open FOLDER/index.html.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
site=$(realpath --canonicalize-missing "${1:-$root/build/site}")
if ! command -v sphinx-build >/dev/null; then
    echo "sphinx-build is not installed. Debian's packages of the site: python3-sphinx python3-myst-parser python3-sphinx-rtd-theme" >&2
    exit 1
fi
sphinx-build -q -E -W --keep-going -j auto -c "$root/docs/site" -d "$site.doctrees" "$root" "$site"
echo "$site/index.html: $(find "$site" -name '*.html' | wc -l) pages"
