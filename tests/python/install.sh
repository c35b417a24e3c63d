#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The Python module installed by CMake and by pip, without a network, and used from elsewhere: install.sh PYTHON BUILD_DIRECTORY.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

python=$1 build=$(cd "$2" && pwd)
for module in pip setuptools venv wheel; do
    "$python" -c "import $module" 2>/dev/null || skip "$python has no $module (Debian: apt-get install python3-pip python3-setuptools python3-venv python3-wheel)"
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# use_from PYTHON: it is not the repository's folder that is imported.
use_from() {
    (cd "$scratch" && "$1" -W error -c "
import pathlib, splinefeed
assert pathlib.Path(splinefeed.__file__).is_relative_to('$scratch'), splinefeed.__file__
assert (pathlib.Path(splinefeed.__file__).parent / 'py.typed').exists()
print(splinefeed.__version__, splinefeed.plan([[0, 0], [10, 5], [20, 0], [30, 5], [40, 0]]).time)")
}

cmake --install "$build" --component python --prefix "$scratch/prefix" >/dev/null
by_cmake=$(PYTHONPATH=$(echo "$scratch"/prefix/lib/python3*/*-packages) use_from "$python")

# In the repository, where a compiler cache finds what was compiled; without a network where the kernel lets us be without.
trap 'rm -rf "$scratch" python/build python/*.egg-info' EXIT
offline=()
if unshare --net true 2>/dev/null; then offline=(unshare --net); fi
"$python" -m venv --system-site-packages "$scratch/venv"
"${offline[@]}" "$scratch/venv/bin/pip" install --quiet --no-build-isolation --no-deps --disable-pip-version-check ./python
by_pip=$(use_from "$scratch/venv/bin/python")

echo "by CMake: $by_cmake; by pip: $by_pip"
[[ $by_cmake == "$by_pip" && $by_pip == *" 0.602" ]]
