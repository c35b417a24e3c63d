#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What PlatformIO and Zephyr read of this repository, as far as it can be checked without them: manifests name what is there, the
options of Kconfig mean what the core takes, and the module's CMake file compiles the core with them (with stand-ins for Zephyr's functions).
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SKIPPED = 77
DEBIAN_MODULES = "/usr/lib/python3/dist-packages"  # for a Python that is not Debian's


def check(condition, what):
    if not condition:
        sys.exit(what)


def sources():
    return sorted(path.resolve() for path in (ROOT / "firmware_core").rglob("*.cpp"))


def platformio():
    manifest = json.loads((ROOT / "library.json").read_text())
    version = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
    check(manifest["version"] == version, f"library.json: version {manifest['version']}; CMakeLists.txt has {version}")
    build = manifest["build"]
    for name in manifest["export"]["include"] + [build["srcDir"], build["includeDir"]]:
        check((ROOT / name).exists(), f"library.json: there is no {name}")
    for header in manifest["headers"]:
        check((ROOT / build["includeDir"] / header).exists(), f"library.json: there is no {header}")
    check(sources() == sorted(path.resolve() for path in (ROOT / build["srcDir"]).rglob("*.c*")),
          "library.json: the sources are not those of the core")
    # As PlatformIO does: with the flags of the project and of the library, those of "unflags" taken away.
    flags = [flag for flag in ["-std=gnu++17", *build["flags"]] if flag not in build["unflags"]]
    subprocess.run(["g++", *flags, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{ROOT / build['includeDir']}",
                    ROOT / "tests/install/core.cpp", sources()[0]], check=True)
    print(f"library.json: {len(sources())} sources, {' '.join(flags)}")


def kconfig(assignments):
    """The values of the module's options where a firmware's file assigns these."""
    sys.path.append(DEBIAN_MODULES)
    import kconfiglib  # pylint: disable=import-outside-toplevel
    with tempfile.TemporaryDirectory() as scratch:
        top = pathlib.Path(scratch) / "Kconfig"
        # The options of Zephyr that the module's depend on.
        top.write_text('config CPP\n\tbool "C++"\nconfig STD_CPP20\n\tbool "C++20"\nconfig STD_CPP2B\n\tbool "C++23"\n'
                       f'config REQUIRES_FULL_LIBCPP\n\tbool\nsource "{ROOT}/zephyr/Kconfig"\n')
        chosen = pathlib.Path(scratch) / "prj.conf"
        chosen.write_text("".join(f"CONFIG_{name}={value}\n" for name, value in assignments.items()))
        options = kconfiglib.Kconfig(str(top), warn_to_stderr=False)
        options.load_config(str(chosen))
        return {name: symbol.str_value for name, symbol in options.syms.items()}, options.warnings


def zephyr():
    module = (ROOT / "zephyr/module.yml").read_text()
    for key, name in (("cmake", "CMakeLists.txt"), ("kconfig", "")):
        path = ROOT / re.search(rf"^  {key}: (\S+)$", module, re.MULTILINE)[1] / name
        check(path.exists(), f"zephyr/module.yml: {key}: there is no {path.relative_to(ROOT)}")
    cpp = {"CPP": "y", "STD_CPP20": "y"}
    values, warnings = kconfig({**cpp, "SPLINEFEED": "y"})
    check(not warnings, f"zephyr/Kconfig: {warnings}")
    check((values["SPLINEFEED"], values["SPLINEFEED_MAX_AXES"], values["REQUIRES_FULL_LIBCPP"]) == ("y", "3", "y"),
          f"zephyr/Kconfig: {values}")
    check(kconfig({"CPP": "y", "SPLINEFEED": "y"})[0]["SPLINEFEED"] == "n", "zephyr/Kconfig: it does not need C++20")
    check(kconfig({**cpp, "SPLINEFEED": "y", "SPLINEFEED_MAX_AXES": "9"})[0]["SPLINEFEED_MAX_AXES"] != "9",
          "zephyr/Kconfig: nine axes")
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT / "tests/install/zephyr", "-B", scratch, f"-DMODULE={ROOT}",
                        "-DCONFIG_SPLINEFEED=y", "-DCONFIG_SPLINEFEED_MAX_AXES=3", "-DCONFIG_SPLINEFEED_MAX_DEGREE=3"],
                       check=True, stdout=subprocess.DEVNULL)
        commands = json.loads((pathlib.Path(scratch) / "compile_commands.json").read_text())
        check(sources() == sorted(pathlib.Path(command["file"]).resolve() for command in commands),
              "zephyr/CMakeLists.txt: the sources are not those of the core")
        first = commands[0]["command"]
        for wanted in ("-DSPLINEFEED_MAX_AXES=3", "-DSPLINEFEED_MAX_DEGREE=3", "-ffp-contract=off", "-fno-exceptions"):
            check(wanted in first.split(), f"zephyr/CMakeLists.txt: no {wanted} in {first}")
        made = re.search(r"CMakeFiles/\S*\.o", first)[0]
        subprocess.run(["ninja", "-C", scratch, f"module/{made}"] if not made.startswith("module/") else
                       ["ninja", "-C", scratch, made], check=True, stdout=subprocess.DEVNULL)
    print(f"zephyr: {len(commands)} sources")


def main():
    platformio()
    sys.path.append(DEBIAN_MODULES)
    try:
        import kconfiglib  # pylint: disable=import-outside-toplevel,unused-import
    except ImportError:
        print("SKIPPED: there is no kconfiglib (Debian: apt-get install python3-kconfiglib)")
        return SKIPPED
    zephyr()
    return 0


if __name__ == "__main__":
    sys.exit(main())
