#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Doxygen makes the API reference without a warning: doxygen.sh BUILD_DIRECTORY. The pages are then in BUILD_DIRECTORY/api/html.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

build=$1
need doxygen
mkdir -p "$build/api"
(cat docs/reference/Doxyfile && echo "OUTPUT_DIRECTORY = $build/api") | doxygen -
echo "$(find "$build/api/html" -name '*.html' | wc -l) pages"
