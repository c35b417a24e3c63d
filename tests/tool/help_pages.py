#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The man pages and the completion of bash have every command and option that --help shows: help_pages.py TOOL.

Where man is installed each page is typeset without a warning."""
import pathlib
import re
import shutil
import subprocess
import sys

TOOL = pathlib.Path(sys.argv[1]).resolve()


def said(*arguments):
    return subprocess.run([TOOL, *arguments], capture_output=True, text=True, check=True).stdout


def completed(script, *words):
    """What bash offers for the last of the words."""
    quoted = " ".join(f"'{word}'" for word in ("splinefeed", *words))
    run = f"{script}\nCOMP_WORDS=({quoted})\nCOMP_CWORD={len(words)}\n_splinefeed\nprintf '%s\\n' \"${{COMPREPLY[@]}}\""
    return set(subprocess.run(["bash", "-c", run], capture_output=True, text=True, check=True).stdout.split())


def main():
    script, bad = said("--completion"), []
    commands = re.findall(r"^  ([a-z]+) {2,}\S", said("--help").partition("Subcommands:")[2], re.MULTILINE)
    if len(commands) < 8 or completed(script, "") != set(commands):
        bad.append(f"--help has the commands {commands}, the completion {completed(script, '')}")
    options = 0
    for command in commands:
        names = {name for line in re.findall(r"^  (-[^ ]*(?:, ?-[^ ]*)*)", said(command, "--help"), re.MULTILINE) for name in line.replace(" ", "").split(",")}
        page = said("--man", command)
        shown = {name.replace("\\-", "-") for line in re.findall(r"^\.TP\n(.*)$", page, re.MULTILINE) for name in re.findall(r"\\fB(.*?)\\fR", line)}
        options += len(names)
        for where, found in (("man page", {name for name in shown if name.startswith("-")}), ("completion", completed(script, command, "-"))):
            if names != found:
                bad.append(f"{command}: the {where} has {sorted(found ^ names)} in the one or in the other alone")
        bad += [f"splinefeed: its page does not name {command}"] if f"\\fBsplinefeed-{command}\\fR(1)" not in said("--man", "splinefeed") else []
    for words, meant in ((("run", "--dialect", ""), {"linuxcnc", "grbl", "marlin", "fanuc", "klipper", "auto"}), (("check", "--dialect", "gr"), {"grbl"}),
                         (("run", "--start", ""), {"check", "move", "here"}), (("run", "--tr"), {"--trace"}), (("run", "--trace", "/dev/nul"), {"/dev/null"}), (("schema", "ma"), {"machine", "map"})):
        if (found := completed(script, *words)) != meant:
            bad.append(f"{words}: {found}")
    for command in commands:
        bad += [f"help {command} is not {command} --help"] if said("help", command) != said(command, "--help") else []
    ended = subprocess.run(f"'{TOOL}' --man run 2>&1 | head -n 1", shell=True, capture_output=True, text=True, check=True).stdout.splitlines()
    bad += [f"--man run | head: {ended}"] if len(ended) != 1 else []
    if shutil.which("man"):
        for command in ("splinefeed", *commands):
            warned = subprocess.run(["man", "--warnings", "-l", "-"], input=said("--man", command), capture_output=True, text=True, check=False).stderr
            bad += [f"{command}: man says {warned}"] if warned.strip() else []
    print("\n".join(bad) if bad else f"{len(commands)} commands, {options} options")
    return 1 if bad or options < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
