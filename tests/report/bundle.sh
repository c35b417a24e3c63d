#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The page of reports in the repository is what its source and its lock file give, byte by byte: bundle.sh BUILD_DIRECTORY.
# Leaves the packages in BUILD_DIRECTORY/report_page for the tests of the page.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

need node npm
page=$1/report_page
source=host_sim/report/page
npm_packages $source "$page"
rm -rf "$page/src"
cp -r $source/src $source/build.mjs $source/tsconfig.json "$page"
(cd "$page" && node node_modules/typescript/bin/tsc && node build.mjs "made.html")
cmp $source/dist/report.html "$page/made.html" ||
    { echo "make it anew: cd $source && npm ci && npm run build"; exit 1; }
