#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# All shell scripts parse, and shellcheck, where it is installed, finds nothing.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

scripts=(run check .ci/run cmake/packages cmake/packaging/*.sh docs/*/*.sh tests/*/*.sh tests/*/*/*.sh)
for script in "${scripts[@]}"; do
    bash -n "$script"
done
if command -v shellcheck >/dev/null; then
    # SC2034: the lists of cmake/packages are used by those who source it.
    shellcheck --external-sources --source-path=SCRIPTDIR --exclude=SC2034 --shell=bash "${scripts[@]}"
fi
