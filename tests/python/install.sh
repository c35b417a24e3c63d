#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The Python module installed by CMake, by pip and of a source distribution, without a network, and used from elsewhere:
# install.sh PYTHON BUILD_DIRECTORY.
source "$(dirname "${BASH_SOURCE[0]}")/../tools/common.sh"

python=$1 build=$(cd "$2" && pwd)
for module in build pip setuptools venv wheel; do
    "$python" -c "import $module" 2>/dev/null || skip "$python has no $module (Debian: apt-get install python3-build python3-pip python3-setuptools python3-venv python3-wheel)"
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# use_from PYTHON: it is not the repository's folder that is imported.
use_from() {
    (cd "$scratch" && "$1" -W error -c "
import pathlib, splinefeed
assert pathlib.Path(splinefeed.__file__).is_relative_to('$scratch'), splinefeed.__file__
for name in ('py.typed', '_native.pyi'):
    assert (pathlib.Path(splinefeed.__file__).parent / name).exists(), name
print(splinefeed.__version__, splinefeed.plan([[0, 0], [10, 5], [20, 0], [30, 5], [40, 0]]).time)")
}

cmake --install "$build" --component python --prefix "$scratch/prefix" >/dev/null
by_cmake=$(PYTHONPATH=$(echo "$scratch"/prefix/lib/python3*/*-packages) use_from "$python")

# In the repository, where a compiler cache finds what was compiled; without a network where the kernel lets us be without.
trap 'rm -rf "$scratch" python/*.egg-info' EXIT
export CMAKE_ARGS=-DSPLINEFEED_WERROR=ON # as everything here is compiled
offline=()
if unshare --net true 2>/dev/null; then offline=(unshare --net); fi
# install_from WHAT NAME: what pip makes of it says what it is.
install_from() {
    "$python" -m venv --system-site-packages "$scratch/$2"
    "${offline[@]}" "$scratch/$2/bin/pip" install --quiet --no-build-isolation --no-deps --disable-pip-version-check "$1"
    use_from "$scratch/$2/bin/python"
}
by_pip=$(install_from . by_pip)

# The source distribution has all that it needs: it is compiled in a folder of its own, which is no git repository.
"${offline[@]}" "$python" -m build --sdist --no-isolation --outdir "$scratch/dist" . >"$scratch/sdist.log" 2>&1 || { cat "$scratch/sdist.log"; exit 1; }
mkdir "$scratch/elsewhere"
tar --extract --file "$scratch"/dist/splinefeed-*.tar.gz --directory "$scratch/elsewhere"
by_sdist=$(install_from "$(echo "$scratch"/elsewhere/splinefeed-*)" by_sdist)

echo "by CMake: $by_cmake; by pip: $by_pip; of the source distribution of $(du -k "$scratch"/dist/*.tar.gz | cut -f 1) kB: $by_sdist"
[[ $by_cmake == "$by_pip" && $by_cmake == "$by_sdist" && $by_pip == *" 0.602" ]]
