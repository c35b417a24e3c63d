#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs one fuzzer on the corpus of the repository and then on what it invents: fuzz.sh PROGRAM CORPUS.
set -euo pipefail

program=$1
corpus=$2
seconds=2 # what is broken today is found in the corpus and at once; what is rare, by the minute of --long
if [[ ${SPLINEFEED_LONG:-0} == 1 ]]; then seconds=60; fi

found=$program.found
mkdir -p "$found"
corpora=("$found")
if [[ -d $corpus ]]; then corpora+=("$corpus"); fi
exec "$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$found/../" "${corpora[@]}"
