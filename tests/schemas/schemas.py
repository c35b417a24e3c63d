#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The schemas are schemas, every file of this repository validates, what is broken does not, and each key has a sentence: schemas.py TOOL FOLDER.

json_schema_test.cpp compares the readers with the rows that the schemas are made of."""
import copy
import csv
import json
import pathlib
import re
import subprocess
import sys
import tomllib

try:
    import jsonschema
except ImportError:
    print("SKIPPED: there is no jsonschema for Python (Debian: python3-jsonschema)")
    sys.exit(77)

TOOL = pathlib.Path(sys.argv[1]).resolve()
ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = ROOT / "tests/schemas"
EVENTS = "t,event,value\n0,hold,\n0.2,resume,\n0.3,override,0.5\n86400,abort,\n"

# Changes of a file that validates, after which it does not: a path in it, and the value there; None: the key is gone.
BROKEN = {
    "machine": [(["path", "max_feed_mm_s"], 20000), (["path", "max_feed_mm_s"], None), (["axis", 0, "name"], "w"), (["axis"], []),
                (["axis", 0, "max_velocity"], 100), (["axis", 0, "travel_end_velocity_mm_s"], None), (["axis", 0, "motors"], 3),
                (["input", 0, "coil"], 3), (["output", 0, "number"], 64), (["spindle", "spin_up_s"], None), (["lines", "chip"], "gpiochip0"),
                (["spindle", "at_speed", "bias"], "up"), (["axis", 0, "travel_mm"], [1, 2, 3]), (["sample_period_us"], 50.5)],
    "profile": [(["stream"], "cycles"), (["link", "functions"], [6, 16]), (["field", 0, "name"], "status"), (["field", 0, "width"], 24),
                (["command", 0, "steps", 0, "mask"], 0), (["sources"], []), (["name"], "Maker"), (["link", "unit"], 250), (["identity", 0, "sentence"], None),
                (["stays_on", 0, "value"], None), (["field", 0, "table"], "coils")],
    "map": [(["axis", "x", "step"], 65536), (["axis", "x", "step2"], {"chip": "/dev/gpiochip0"}), (["axis", "u"], {"step": 1, "direction": 2}),
            (["input", 0, "role"], "stop"), (["home", "x", "pull_off_mm"], 0), (["thread", "priority"], 99), (["consumer"], "a" * 32)],
    "events": [([0, "event"], "pause"), ([2, "value"], None), ([2, "value"], 2.5), ([0, "value"], 1), ([0, "t"], -1), ([0, "t"], None)],
    "summary": [(["cycle_time_s"], None), (["cycle_time_s"], "1"), (["limit_use", "velocity", "x"], "full"), (["surplus"], 1), (["stopped"], None),
                (["memory_bytes", "curve"], 1.5)],
}


def said(*arguments, **more):
    return subprocess.run([TOOL, *arguments], capture_output=True, text=True, check=True, **more).stdout


def changed(document, path, value):
    document = copy.deepcopy(document)
    place = document
    for step in path[:-1]:
        place = place[step]
    if value is None:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return document


def events_of(text):
    rows = csv.DictReader(line for line in text.splitlines())
    return [{"t": float(row["t"]), "event": row["event"], **({"value": float(row["value"])} if row["value"] else {})} for row in rows]


def toml_files():
    """Each .toml that people or tests have, with its kind."""
    for folder in ("examples", "hal/profiles", "tests/serve", "tests/gpio/vm", "tests/schemas", "tests/fuzz/corpus"):
        for path in sorted((ROOT / folder).rglob("*.toml")):
            document = tomllib.loads(path.read_text())
            kind = "profile" if "sources" in document else "map" if isinstance(document.get("axis"), dict) else "machine"
            yield kind, str(path.relative_to(ROOT)), document


def summaries(scratch):
    (scratch / "events.csv").write_text(EVENTS)
    runs = {"waypoints": ["examples/star.csv"], "jerk": ["examples/star.csv", "-m", "examples/jerk_limited.toml"],
            "steered": ["examples/star.csv", "--events", str(scratch / "events.csv"), "--no-advice"], "G-code": ["examples/bracket.ngc"],
            "left out": ["examples/ring.gcode", "--dialect", "marlin", "--ignore", "E,unknown"], "elements": ["examples/logo.json"],
            "control points": ["examples/star.csv", "--curve", "bspline"]}
    for name, arguments in runs.items():
        yield name, json.loads(subprocess.run([TOOL, "run", *arguments, "--summary", "json", "--quiet"], capture_output=True, text=True, check=False, cwd=ROOT).stdout)


def without_sentence(schema, path=""):
    for key, value in schema.get("properties", {}).items():
        if not re.fullmatch(r"(?:\[[^]]+\] )?.+[.:].*", value.get("description", "")):
            yield f"{path}.{key}"
        yield from without_sentence(value, f"{path}.{key}")
    for inner in (schema.get("items"), *schema.get("patternProperties", {}).values(), *schema.get("anyOf", [])):
        if isinstance(inner, dict):
            yield from without_sentence(inner, path)


def main():
    scratch = pathlib.Path(sys.argv[2])
    scratch.mkdir(parents=True, exist_ok=True)
    schemas = {kind: json.loads(said("schema", kind)) for kind in BROKEN}
    bad, right, wrong = [], 0, 0
    for kind, schema in schemas.items():
        jsonschema.Draft7Validator.check_schema(schema)
        bad += [f"{kind}: {path} has no sentence" for path in without_sentence(schema)]
    files = [*toml_files(), ("events", "events.csv", events_of(EVENTS)), *(("summary", *one) for one in summaries(scratch))]
    for kind, name, document in files:
        errors = list(jsonschema.Draft7Validator(schemas[kind]).iter_errors(document))
        right += 1
        bad += [f"{kind} {name}: {error.json_path}: {error.message}" for error in errors]
    for kind, changes in BROKEN.items():
        document = next(one for k, name, one in files if k == kind and (kind in ("events", "summary") or name == f"tests/schemas/{kind}.toml"))
        for path, value in changes:
            wrong += 1
            if jsonschema.Draft7Validator(schemas[kind]).is_valid(changed(document, path, value)):
                bad.append(f"{kind}: {path} = {value} validates")
    print("\n".join(bad) if bad else f"{right} files validate, {wrong} broken ones do not")
    return 1 if bad or right < 25 else 0


if __name__ == "__main__":
    sys.exit(main())
