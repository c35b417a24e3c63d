#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# All C++ files look as .clang-format says. To make it so: format.sh --fix.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

need clang-format
mode=(--dry-run --Werror)
if [[ ${1-} == --fix ]]; then mode=(-i); fi
sources . | xargs clang-format "${mode[@]}"
