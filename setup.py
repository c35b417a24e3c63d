# SPDX-License-Identifier: MIT
"""Builds the extension by CMake, as ./run builds the tool. Options of CMake are in the variable CMAKE_ARGS of the environment."""
import os
import pathlib
import re
import shlex
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
VERSION = re.search(r"project\(splinefeed VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]


class CMakeBuild(build_ext):
    """The target splinefeed_python. A newer compiler than ours may warn of something: that is no error here."""

    def build_extension(self, ext):
        build = ROOT / "build" / sys.implementation.cache_tag  # as deep as others: a compiler cache finds what they have compiled
        subprocess.run(["cmake", "--preset", "release", "-S", ROOT, "-B", build, "-DSPLINEFEED_PYTHON=ON", "-DSPLINEFEED_TESTS=OFF",
                        "-DSPLINEFEED_BENCHMARKS=OFF", "-DSPLINEFEED_BITS=OFF", "-DSPLINEFEED_WERROR=OFF",
                        f"-DPython_EXECUTABLE={sys.executable}", *shlex.split(os.environ.get("CMAKE_ARGS", ""))], cwd=ROOT, check=True)
        subprocess.run(["cmake", "--build", build, "--target", "splinefeed_python"], check=True)
        made, = (build / "python/splinefeed").glob("_native.*.so")
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(made.read_bytes())


setup(version=VERSION, ext_modules=[Extension("splinefeed._native", sources=[])], cmdclass={"build_ext": CMakeBuild})
