#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# passed.sh: the labels of the test programs and fuzzers that have passed with the same bytes beside the same files.
# passed.sh --keep: all of them have passed now.
# Files are those of the repository that are no C++; pages of docs/ count for programs that read some, the tool for those that start it.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

marks=build/asan/passed
bytes() { git ls-files -z --cached --others --exclude-standard -- "$@" ':!*.cpp' ':!*.hpp' | xargs -0 sha256sum 2>/dev/null; }
files=$(bytes ':!docs' | sha256sum)
docs=$(bytes docs | sha256sum)
tool=$(sha256sum <"${SPLINEFEED_TOOL:-build/asan/bin/splinefeed}")
for program in build/asan/bin/*_{tests,fuzz}; do
    name=$(basename "$program")
    area=${name%_tests}
    key=$({
        echo "$files"
        cat "$program"
        if grep -rqs 'docs/' "tests/$area"; then echo "$docs"; fi
        if grep -rqs 'tool_path' "tests/$area"; then echo "$tool"; fi
    } | sha256sum)
    mark=$marks/$name-${key%% *}
    if [[ ${1-} == --keep ]]; then
        mkdir -p $marks
        rm -f "$marks/$name"-*
        touch "$mark"
    elif [[ -e $mark ]]; then
        echo "$name"
    fi
done
