#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Debian's packages: lintian has no error, a bare Debian installs them from files alone, runs README.md's 60 seconds there, the Python module
# and a project against the library, and removes them without a trace. As root.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

source tests/install/bare_debian.sh

need lintian
scratch=$(mktemp -d)
bare_debian "$scratch"
cmake/packaging/debian.sh "$scratch/packages" >"$scratch/log" 2>&1 || { tail -n 30 "$scratch/log"; exit 1; }
ls -l "$scratch"/packages/*.deb
lintian --allow-root --fail-on error --tag-display-limit 0 "$scratch"/packages/*.deb

cp "$scratch"/packages/*.deb "$root/packages/"
# That of LinuxCNC would bring half a desktop with it: what it has is looked at here.
for deb in "$root"/packages/linuxcnc-splinefeed_*.deb; do
    if [[ ! -e $deb ]]; then continue; fi
    dpkg-deb --contents "$deb" | grep ' ./usr/lib/linuxcnc/modules/splinefeed_tp.so$' >/dev/null
    dpkg-deb --fsys-tarfile "$deb" | tar --extract --to-stdout ./usr/share/doc/linuxcnc-splinefeed/copyright | grep GPL-2 >/dev/null
    dpkg-deb --field "$deb" Depends | grep 'linuxcnc-uspace (>= .*linuxcnc-uspace (<< ' >/dev/null
    rm "$deb"
done
# What the packages bring with them is there before, and stays.
in_root "apt-get update --quiet=2
depends() { for deb in /packages/*.deb; do dpkg-deb --field \$deb Depends | tr ',' '\n' | sed 's/ *(.*//; s/^ *//; s/ *|.*//'; done | sort -u; }
apt-get install --quiet=2 --no-install-recommends \$(depends) g++ cmake make man-db bash-completion >/dev/null"
traces() { in_root "find / -xdev -not -path '/proc*' -not -path '/dev*' -not -path '/var/lib/dpkg/*' -not -path '/var/log/*' -not -path '/var/cache/*' -not -path '/work*' -not -path '/tmp/*' | sort"; }
before=$(traces)

in_root "apt-get install --quiet=2 --no-install-recommends /packages/*.deb >/dev/null"
in_root "cd /work
printf '0,0\n10,5\n20,0\n30,5\n40,0\n' > part.csv
examples=/usr/share/doc/splinefeed/examples
splinefeed run part.csv -m \$examples/three_axis.toml --report part.html --quiet | grep 'cycle time .* 0.602000 s'
test -s part.html
splinefeed check \$examples/bracket.ngc -m \$examples/three_axis.toml >/dev/null
man -w splinefeed-run >/dev/null
splinefeed schema machine | cmp - /usr/share/splinefeed/schemas/machine.schema.json
source /usr/share/bash-completion/completions/splinefeed
python3 -W error -c 'import splinefeed; assert splinefeed.plan([[0, 0], [10, 5], [20, 0], [30, 5], [40, 0]]).time == 0.602'
python3 \$examples/python/feed_study.py | grep '4.280 s'
mkdir project && cd project
cat > CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.22)
project(consumer LANGUAGES CXX)
find_package(splinefeed CONFIG REQUIRED)
add_executable(consumer main.cpp)
target_link_libraries(consumer PRIVATE splinefeed::core splinefeed::hal)
END
printf '#include <splinefeed/splinefeed.hpp>\nint main() { return splinefeed::G2Spline<double>({.axes = 2}).finish().ok() ? 1 : 0; }\n' > main.cpp
cmake . >/dev/null && make >/dev/null && ./consumer"
in_root "apt-get purge --quiet=2 splinefeed libsplinefeed-dev python3-splinefeed >/dev/null"
if ! diff <(echo "$before") <(traces); then
    echo "these files are more or less than before the packages were installed"
    exit 1
fi
echo "installed, used and removed without a trace"
