#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""source_keys.py SALT SOURCE...: for each source a line `KEY SOURCE`. The key is another one whenever the source, a file of the
repository that it includes, directly or not, or SALT is."""
import functools
import hashlib
import os
import re
import sys

ROOTS = ("", "firmware_core", "hal")
INCLUDE = re.compile(rb'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


@functools.cache
def text_of(path):
    with open(path, "rb") as file:
        return file.read()


def found(name, includer):
    places = [os.path.join(root, name) for root in (os.path.dirname(includer), *ROOTS)]
    return next((os.path.normpath(place) for place in places if os.path.isfile(place)), None)


@functools.cache
def included(path):
    """The files of the repository that it includes itself; those of libraries are not found."""
    names = (name.decode() for name in INCLUDE.findall(text_of(path)))
    return {file for name in names if (file := found(name, path))}


def key(salt, source):
    seen, waiting = {source}, [source]
    while waiting:
        new = included(waiting.pop()) - seen
        seen |= new
        waiting += new
    digest = hashlib.sha256(salt.encode())
    for path in sorted(seen):
        digest.update(path.encode() + b"\0" + hashlib.sha256(text_of(path)).digest())
    return digest.hexdigest()[:32]


for name in sys.argv[2:]:
    print(key(sys.argv[1], name), name)
