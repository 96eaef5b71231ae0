#!/usr/bin/env python3
"""Holds scenario files against the JSON schemas that `pulvis schema` prints, with the validator that Python has for them.

    python3 scripts/check_schema.py <pulvis> <root of the repository>

Every file that Pulvis takes has to pass. Of the files with mistakes, those with an unknown key have to be refused by the schema,
too, and so has every file that passes as soon as any of its tables gets a key that nobody knows.

Exit status: 0 all well, 1 trouble, 2 wrong use.
"""

import copy
import glob
import json
import os
import subprocess
import sys

UNKNOWN = "zzz_unknown"


def kind_of(data):
    if "figure" in data or "panels" in data:
        return None
    for key, kind in (("study", "study"), ("collision", "collision"), ("probe", "probe"), ("stages", "scenario")):
        if key in data:
            return kind
    return None


def tables(data, path=()):
    """Paths of all tables whose keys are fixed."""
    free = path and path[-1] in ("materials", "contacts", "walls", "columns", "set", "programs")
    if isinstance(data, dict):
        if not free:
            yield path
        for key, value in data.items():
            # Values of these are what the user likes.
            if not (path and path[-1] in ("set", "programs", "columns")):
                yield from tables(value, path + (key,))
    elif isinstance(data, list):
        for index, value in enumerate(data):
            yield from tables(value, path + (index,))


def at(data, path):
    for step in path:
        data = data[step]
    return data


def main():
    import tomllib

    import jsonschema

    program, root = sys.argv[1:]
    validators = {}
    for kind in ("scenario", "collision", "probe", "study"):
        text = subprocess.run([program, "schema", kind], check=True, capture_output=True, text=True).stdout
        schema = json.loads(text)
        jsonschema.Draft7Validator.check_schema(schema)
        validators[kind] = jsonschema.Draft7Validator(schema)
    folders = ("crates/pulvis-input/tests/good", "crates/pulvis-cli/templates", "docs", "experiments")
    files = [file for folder in folders for file in glob.glob(os.path.join(root, folder, "**", "*.toml"), recursive=True)]
    troubles, passed, changed = [], 0, 0
    for file in sorted(files):
        with open(file, "rb") as text:
            data = tomllib.load(text)
        kind = kind_of(data)
        if kind is None:
            continue
        # A scenario that starts from another run may leave anything out, but not misspell it.
        errors = list(validators[kind].iter_errors(data))
        if errors:
            best = jsonschema.exceptions.best_match(errors)
            troubles.append(f"{file}: {list(best.absolute_path)}: {best.message[:300]}")
            continue
        passed += 1
        if "tests/good" not in file:
            continue
        for path in tables(data):
            wrong = copy.deepcopy(data)
            at(wrong, path)[UNKNOWN] = 1
            changed += 1
            if validators[kind].is_valid(wrong):
                troubles.append(f"{file}: a key that nobody knows passes in {list(path)}")
    refused = 0
    for file in sorted(glob.glob(os.path.join(root, "crates/pulvis-input/tests/bad/*.toml"))):
        with open(file, "rb") as text:
            content = text.read().decode()
        # What stages set is free: its mistakes are those of the scenario that it leads to.
        if "unknown key" not in content or os.path.basename(file).startswith("set_"):
            continue
        try:
            data = tomllib.loads(content)
        except tomllib.TOMLDecodeError:
            continue
        kind = kind_of(data) or "scenario"
        refused += 1
        if validators[kind].is_valid(data):
            troubles.append(f"{file}: passes, and has an unknown key")
    if passed < 100 or changed < 200 or refused < 10:
        troubles.append(f"only {passed} files, {changed} changed tables and {refused} bad files were found")
    for trouble in troubles:
        print(f"error: {trouble}", file=sys.stderr)
    if not troubles:
        print(f"the schemas take {passed} files and refuse {changed} unknown keys in them and {refused} bad files")
    return 1 if troubles else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    sys.exit(main())
