#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A test of the Python module: run.sh PYTHON BUILD_DIRECTORY SCRIPT [ARGUMENT...]. The tool of that build is what it is compared with.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

python=$1 build=$(cd "$2" && pwd)
shift 2
export PYTHONPATH=$build/python PYTHONDONTWRITEBYTECODE=1 SPLINEFEED_TOOL=$build/bin/splinefeed MPLBACKEND=Agg
exec "$python" -W error "tests/python/$1" "${@:2}"
