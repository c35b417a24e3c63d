#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The first C++ example of README.md compiles, runs and prints as it stands there: readme_example.sh BUILD_DIRECTORY.
# What it prints are the lines of the example that begin with `// prints: `.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

build=$1
out=$build/readme_example
mkdir -p "$out"
example=$out/example.cpp
awk '/^```/ { if (inside) exit; inside = ($0 ~ /^```cpp/); next } inside' README.md >"$example"
expected=$(sed -n 's#^ *// prints: ##p' "$example")
if [[ ! -s $example || -z $expected ]]; then
    echo "README.md has no C++ example, or it has no line '// prints: ...'"
    exit 1
fi

cat >"$out/CMakeLists.txt" <<'PROJECT'
cmake_minimum_required(VERSION 3.22)
project(readme_example LANGUAGES CXX)
find_package(splinefeed CONFIG REQUIRED)
add_executable(example example.cpp)
target_link_libraries(example PRIVATE splinefeed::core splinefeed::hal)
target_compile_options(example PRIVATE -Wall -Wextra -Werror)
PROJECT
cmake --install "$build" --prefix "$out/prefix" >/dev/null
rm -rf "$out/build" # it may be of another generator
cmake -G Ninja -S "$out" -B "$out/build" -DCMAKE_PREFIX_PATH="$(cd "$out" && pwd)/prefix"
cmake --build "$out/build"
output=$(timeout 60 "$out/build/example")
if ! diff <(echo "$expected") <(echo "$output"); then
    echo "README.md claims the lines marked <, its example prints those marked >"
    exit 1
fi
echo "$output"
