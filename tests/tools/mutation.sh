#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Puts every misprint of the papers back, one at a time (tests/mutation/misprints.txt): each must fail a test.
# About 10 s a misprint.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

need cmake ninja g++

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
git ls-files -z | xargs -0 cp --parents --target-directory="$scratch"
targets=(splines_tests surfaces_tests curve_tests methods_tests)
cmake -G Ninja -S "$scratch" -B "$scratch/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="-w" -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" >/dev/null

# Whether the tests pass; a build that fails ends the script.
passes() {
    cmake --build "$scratch/build" --target "${targets[@]}" >"$scratch/build.log" 2>&1 || {
        cat "$scratch/build.log"
        echo "the mutated source does not compile"
        exit 1
    }
    for target in "${targets[@]}"; do
        timeout 300 "$scratch/build/bin/$target" --abort >"$scratch/test.log" 2>&1 || return 1
    done
}

if ! passes; then
    cat "$scratch/test.log"
    echo "the tests fail before any misprint is put back"
    exit 1
fi

survivors=0
count=0
name='' file='' right=''
while IFS= read -r line || [[ -n $line ]]; do
    case $line in
        '' | '# '*) ;;
        '= '*) name=${line:2} ;;
        '@ '*) file=${line:2} ;;
        '- '*) right=${line:2} ;;
        '+ '*)
            wrong=${line:2}
            source=$(cat "$scratch/$file" && echo x)
            source=${source%x}
            before=${source%%"$right"*}
            if [[ $before == "$source" ]]; then
                echo "$name: $file does not contain: $right"
                exit 1
            fi
            after=${source#*"$right"}
            if [[ $after == *"$right"* ]]; then
                echo "$name: $file contains more than once: $right"
                exit 1
            fi
            printf '%s' "$before$wrong$after" >"$scratch/$file"
            count=$((count + 1))
            if passes; then
                echo "NOT NOTICED  $name"
                survivors=$((survivors + 1))
            else
                failed=$(grep -m 1 -A 1 -e '^-----*$' "$scratch/test.log" | tail -n 1 || true)
                echo "noticed      $name   [$failed]"
            fi
            printf '%s' "$source" >"$scratch/$file"
            ;;
        *)
            echo "tests/mutation/misprints.txt: unknown line: $line"
            exit 1
            ;;
    esac
done <tests/mutation/misprints.txt
echo "$count misprints, $survivors not noticed"
((count > 0 && survivors == 0))
