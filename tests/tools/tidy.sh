#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# clang-tidy finds nothing in the code that ships: in what changed since the last tag or, where there is none, since the commit
# that tests/tools/tidy_base names, at which all of it was clean. With --long all of it, with the analyzer as well.
# A source that was clean is looked at again when it, or a file of the repository that it includes, is another one.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

need clang-tidy python3
# Every source as it is compiled alone; a compiler cache's name would be taken for the compiler's.
build=build/tidy
cmake --preset release -B "$build" -DSPLINEFEED_UNITY_BUILD=OFF -DSPLINEFEED_TESTS=OFF -DSPLINEFEED_BENCHMARKS=OFF \
    -DCMAKE_CXX_COMPILER_LAUNCHER= >/dev/null
base=$(git describe --tags --abbrev=0 2>/dev/null || cat tests/tools/tidy_base)
# changed: the sources that may be another's than at the base; a header is seen by the source of its name.
changed() {
    if [[ ${SPLINEFEED_LONG:-0} != 1 ]] && git rev-parse --quiet --verify "$base^{commit}" >/dev/null 2>&1; then
        { git diff --name-only "$base" && git ls-files --others --exclude-standard; } | sed 's/\.hpp$/.cpp/' | sort -u
    else
        sources firmware_core hal host_sim python
    fi
}
# What this build leaves out, such as the source for another version of a library, has no headers here.
built=$(sed -n "s|^ *\"file\": \"$PWD/\(.*\)\",\{0,1\}$|\1|p" "$build/compile_commands.json" | sort -u)
[[ -n $built ]] # else nothing would be looked at
mapfile -t files < <(comm -12 <(changed) <(sources firmware_core hal host_sim python) | comm -12 - <(echo "$built") | grep '\.cpp$' || true)
echo "${#files[@]} of $(wc -l <<<"$built") sources changed since $base"
if ((${#files[@]} == 0)); then exit 0; fi

# look_at KEY SOURCE: a source that is clean leaves a mark.
mkdir -p "$build/clean"
look_at() {
    if [[ -e build/tidy/clean/$1 ]]; then return 0; fi
    local checks=()
    if [[ ${SPLINEFEED_LONG:-0} == 1 ]]; then checks=(--checks='clang-analyzer-*'); fi
    clang-tidy -p build/tidy --quiet "${checks[@]}" --warnings-as-errors='*' "$2" || return 1
    echo "clean: $2"
    touch "build/tidy/clean/$1"
}
export -f look_at
tests/tools/source_keys.py "$(clang-tidy --version && cat .clang-tidy) ${SPLINEFEED_LONG:-0}" "${files[@]}" |
    xargs --max-procs="$(nproc)" --max-lines=1 bash -c 'look_at "$@"' tidy
