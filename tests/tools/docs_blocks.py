#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs every shell block of README.md and docs/ as it stands there, page by page: docs_blocks.py BUILD_DIRECTORY [PAGE...].

A page's blocks (```sh) run in one shell, in a copy of the repository's folder that has the tool where ./run and CMake put it, and
on PATH. A block fails if a command in it does. A comment on the line before a block says what is different:

    <!-- not run: WHY -->      it cannot run here: a drive, a chip, root, minutes
    <!-- exit status N -->     its one command ends with N
    <!-- output -->            (before ```text) what the block before printed; ... stands for any text, also of several lines

The ports 1502 to 1505 of a page become free ones. A block that starts a drive ends with `sleep N`, since whoever pastes a page goes on at
once; here it is over when the drive answers, too. A page for users names the tool where ./run puts it, build/tool."""
import concurrent.futures
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LANGUAGES = {"sh", "text", "toml", "csv", "json", "cpp", "cmake", "python"}
COPIED = ("docs", "examples", "bench")  # a page may write there
LIMIT_S, WAIT_S = 60, 10  # of a page; until a drive answers
COMMAND = re.compile(r"^ {4}(\$ |\./|splinefeed |build/|docs/\S*\.py|bench/|cmake |ctest |sudo |apt|printf |echo |socat )", re.MULTILINE)


class Block:
    """A fenced block: its language, its text, the comment before it and its line."""

    def __init__(self, language, text, note, line):
        self.language, self.text, self.note, self.line = language, text, note, line
        self.not_run = self.expected_status = None
        self.output = ""
        if language == "text":
            if note == "output":
                self.output = text
            return
        if language != "sh" or not note:
            return
        if match := re.fullmatch(r"not run: (\S.*)", note):
            self.not_run = match[1]
        elif match := re.fullmatch(r"exit status (\d+)", note):
            self.expected_status = int(match[1])
        else:
            raise ValueError(f"line {line - 1}: a block cannot have the comment '{note}'")


def blocks_of(text):
    """The fenced blocks of a page, in order; what does not say what it is raises ValueError."""
    lines, found, at = text.split("\n"), [], 0
    while at < len(lines):
        fence = re.match(r"^ *```(.*)$", lines[at])
        if not fence:
            if COMMAND.match(lines[at]):
                raise ValueError(f"line {at + 1}: a command outside of a ```sh block")
            at += 1
            continue
        if fence[1] not in LANGUAGES:
            raise ValueError(f"line {at + 1}: '{fence[1]}' is none of {', '.join(sorted(LANGUAGES))}")
        end = next(i for i in range(at + 1, len(lines)) if lines[i].strip() == "```")
        note = re.match(r"^ *<!-- (.*) -->$", lines[at - 1])
        found.append(Block(fence[1], "\n".join(lines[at + 1:end]) + "\n", note[1] if note else "", at + 1))
        at = end + 1
    return found


def pasted(page, text, blocks):
    """What goes wrong where a user pastes the page: a drive that does not listen yet, a tool that ./run puts elsewhere."""
    for block in blocks:
        if block.language == "sh" and "--listen" in block.text and "&\n" in block.text and not re.search(r"^ *(sleep|until) ", block.text, re.MULTILINE):
            yield f"{page}:{block.line}: the next block comes before the drive listens; end this one with `sleep 1`"
    for_users = page == "README.md" or page.startswith(("docs/tutorial", "docs/how-to"))
    for number, line in enumerate(text.split("\n"), 1):
        if re.search(r"cmake --install build\b(?!/)", line):
            yield f"{page}:{number}: ./run builds in build/tool"
        if for_users and re.search(r"build/release/bin/splinefeed", line) and "cmake --preset release" not in text:
            yield f"{page}:{number}: ./run puts the tool into build/tool/bin"


def scratch(folder, build):
    """A folder like the repository's root, with the tool where ./run and the preset release put it."""
    for entry in ROOT.iterdir():
        if entry.name in COPIED:
            shutil.copytree(entry, folder / entry.name)
        elif entry.name not in ("build", ".git"):
            (folder / entry.name).symlink_to(entry)
    (folder / "build").mkdir()
    for name in ("release", "tool"):
        (folder / "build" / name).symlink_to(build)


def free_ports(count):
    """Ports that nobody has at this moment."""
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def with_ports(text, ports):
    for number, port in zip(range(1502, 1506), ports):
        text = re.sub(rf"\b{number}\b", str(port), text)
    return text


def waits_for(text):
    """Shell lines that wait until what a block left running can be reached."""
    for port in re.findall(r"--listen '?tcp://127\.0\.0\.1:(\d+)", text):
        yield f"for i in {{1..{10 * WAIT_S}}}; do (exec 3<>/dev/tcp/127.0.0.1/{port}) 2>/dev/null && break; sleep 0.1; done; [ $i -lt {10 * WAIT_S} ]"
    for path in re.findall(r"link=([^\s,]+)", text):
        yield f"for i in {{1..{10 * WAIT_S}}}; do [ -e {path} ] && break; sleep 0.1; done; [ -e {path} ]"


def script_of(blocks, ports, folder):
    """One shell script for all blocks that run; each has its output in a file, and `ok` with its number when it is over."""
    out = []
    for number, block in enumerate(blocks):
        if block.language != "sh" or block.not_run:
            continue
        text = with_ports(block.text, ports)
        file, output = folder / f".block{number}.sh", folder / f".block{number}.out"
        file.write_text(text)
        if block.expected_status is None:
            out += ["set -e", f"{{ . {file}; }} >{output} 2>&1"]
            out += list(waits_for(text)) if "&\n" in text else []
            out += [f"echo ok {number} >&9"]
        else:
            out += ["set +e", f"{{ . {file}; }} >{output} 2>&1", f"echo status {number} $? >&9"]
    return "\n".join(out) + "\n"


def pattern_of(shown, ports):
    text = re.escape(with_ports(shown, ports).strip()).replace(re.escape("..."), "(?s:.*)")
    return re.compile(text)


def run(page, build):
    """(complaints, blocks that ran, reasons of those that did not)"""
    text = (ROOT / page).read_text()
    try:
        blocks = blocks_of(text)
    except ValueError as problem:
        return [f"{page}: {problem}"], 0, []
    if problems := list(pasted(page, text, blocks)):
        return problems, 0, []
    shell = [b for b in blocks if b.language == "sh"]
    reasons = [b.not_run for b in shell if b.not_run]
    if len(reasons) == len(shell):
        return [], 0, reasons
    with tempfile.TemporaryDirectory(prefix="splinefeed_docs_") as name:
        folder = pathlib.Path(name)
        scratch(folder, build)
        ports = free_ports(4)
        for machine in (folder / "examples").glob("*.toml"):
            machine.write_text(with_ports(machine.read_text(), ports))
        environment = dict(os.environ, PATH=f"{build / 'bin'}:{os.environ['PATH']}", PYTHONDONTWRITEBYTECODE="1")
        with (folder / ".said").open("w+") as said:
            process = subprocess.Popen(["bash", "-c", "exec 9>&1 >/dev/null\n" + script_of(blocks, ports, folder)], cwd=folder,
                                       env=environment, stdin=subprocess.DEVNULL, stdout=said, start_new_session=True)
            try:
                status = process.wait(LIMIT_S)
            except subprocess.TimeoutExpired:
                status = f"none within {LIMIT_S} s"
            finally:
                try:
                    os.killpg(process.pid, signal.SIGKILL)  # drives that a page leaves running
                except ProcessLookupError:
                    pass
        answers = {int(line.split()[1]): line.split()[2:] for line in (folder / ".said").read_text().splitlines()}
        return check(page, blocks, answers, status, ports, folder), len(shell) - len(reasons), reasons


def check(page, blocks, answers, status, ports, folder):
    """What is wrong with the blocks of a page: the first that failed, wrong statuses, and outputs that are not as shown."""
    printed = ""
    for number, block in enumerate(blocks):
        if block.language == "sh":
            output = folder / f".block{number}.out"
            printed = output.read_text() if output.exists() else None
            if block.not_run:
                continue
            if number not in answers:
                return [f"{page}:{block.line}: the block ended with exit status {status}:\n{block.text}{printed or ''}"]
            if answers[number] and int(answers[number][0]) != block.expected_status:
                return [f"{page}:{block.line}: exit status {answers[number][0]}, not {block.expected_status}\n{printed}"]
        elif block.output and printed is not None and not pattern_of(block.output, ports).search(printed):
            return [f"{page}:{block.line}: the block before it printed something else:\n{printed}"]
    return []


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    if not (build / "bin" / "splinefeed").exists():
        print(f"{build}/bin/splinefeed is not built")
        return 1
    pages = sys.argv[2:] or ["README.md", *sorted(str(p.relative_to(ROOT)) for p in (ROOT / "docs").rglob("*.md"))]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        results = list(pool.map(lambda page: run(page, build), pages))
    complaints = [line for bad, _, _ in results for line in bad]
    reasons = [reason for _, _, some in results for reason in some]
    print(f"{len(pages)} pages: {sum(ran for _, ran, _ in results)} blocks ran, {len(reasons)} were not run:")
    for reason in sorted(set(reasons)):
        print(f"  {reasons.count(reason)}: {reason}")
    print("\n".join(complaints))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
