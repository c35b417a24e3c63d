#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs a command as a part of ./check --long only: if_long.sh WHAT_IT_TAKES COMMAND...
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [[ ${SPLINEFEED_LONG:-0} != 1 ]]; then skip "takes $1: ./check --long"; fi
shift
exec "$@"
