#!/usr/bin/env python3
"""Compares the HDF5 files of a run with its CSV files of the same instants, and both with its fields.json; needs h5py and pandas.

    python3 scripts/check_hdf5.py <run folder>

The scenario is xtask/src/hdf5.toml.

Exit status: 0 all well, 1 trouble, 2 wrong use.
"""

import os
import sys

AXES = "xyz"
# What a field is called in CSV files; others by their name, and vectors end in _x, _y, _z.
STEMS = {"v": "v", "omega": "omega", "f": "f", "torque": "tq", "position": ""}


class Trouble(Exception):
    """Something a user of the files would stumble over."""


def require(condition, words):
    if not condition:
        raise Trouble(words)


def same(numpy, value, table, name, what):
    """All numbers, to the bit; not-a-number is itself."""
    if value.ndim == 1:
        columns = [name]
    else:
        require(value.shape[1:] == (3,), f"{what}: shape {value.shape} of {name}")
        columns = [STEMS.get(name, f"{name}_") + axis for axis in AXES]
    expected = table[columns].to_numpy(dtype=float).reshape(value.shape)
    require(numpy.array_equal(value.astype(float), expected, equal_nan=True), f"{what}: {name} differs")


def check(folder):
    import h5py
    import numpy
    import pandas

    fields = pandas.read_json(os.path.join(folder, "fields.json"))
    fields = fields[fields["file"] == "packed_*.h5"]
    require(len(fields) > 12, f"fields.json describes {len(fields)} fields")
    # Before version 3 pandas reads every bit only if told so.
    options = {} if int(pandas.__version__.split(".")[0]) >= 3 else {"float_precision": "round_trip"}
    counts = set()
    with h5py.File(os.path.join(folder, "packed.h5")) as index:
        frames = sorted(index["frames"])
        require(len(frames) > 5, f"{len(frames)} frames")
        for number, name in enumerate(frames):
            frame = index[f"frames/{name}"]
            require(frame["time"][0] == index["time"][number] and frame["step"][0] == index["step"][number], f"{name}: another time")
            particles = pandas.read_csv(os.path.join(folder, f"text_{name}.csv"), **options)
            contacts = pandas.read_csv(os.path.join(folder, f"text_contacts_{name}.csv"), **options)
            counts.add((len(particles), len(contacts)))
            require(index["particle_count"][number] == len(particles), f"{name}: number of particles")
            require(index["contact_count"][number] == len(contacts), f"{name}: number of contacts")
            names = list(frame["parameters/materials"].attrs["names"])
            for field in fields.itertuples():
                for path in field.columns.split():
                    require(path in frame, f"{name} has no {path}")
                    value = frame[path]
                    if field.unit not in ("1", "SI"):
                        require(value.attrs["unit"] == field.unit, f"{path}: unit {dict(value.attrs)}, not {field.unit}")
                    if field.field == "type":
                        materials = [names[species] for species in value[0]]
                        require(materials == particles["material"].tolist(), f"{name}: other materials")
                        continue
                    of_contacts = path.startswith("contacts/")
                    column = path.split("/")[1] if field.field == "memory" else field.field
                    same(numpy, value[0], contacts if of_contacts else particles, column, f"{name}, {path}")
    require(len(counts) > 3, f"all frames have {counts} particles and contacts")
    print(f"h5py {h5py.__version__} reads {len(frames)} frames of a run, and finds the numbers of the CSV files")


def main(arguments):
    if len(arguments) != 1:
        print(__doc__)
        return 2
    try:
        check(arguments[0])
    except (Trouble, OSError, ValueError, KeyError) as trouble:
        print(f"trouble: {trouble}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
