#!/usr/bin/env python3
"""Reads the folder `formats` of the example `sample_run` of pulvis-io with the programs that they are made for, and compares all numbers.

    python3 scripts/check_formats.py <run folder>/formats

NumPy reads the npz archives, pandas the CSV tables, VTK the frames and an image, OVITO dumps and extended XYZ, h5py the HDF5 files where
the example was built with them. What is not installed is skipped aloud.

Exit status: 0 all well, 1 trouble, 2 wrong use.
"""

import os
import sys

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

COUNT, STEPS = 7, (0, 100, 200)
# Position, radius and so on of the formula in examples/sample_run.rs: first part, number of parts.
PARTS = {"position": (0, 3), "radius": (10, 1), "v": (11, 3), "omega": (14, 3), "f": (17, 3), "stress": (20, 9)}


class Trouble(Exception):
    """Something a user of the files would stumble over."""


def require(condition, words):
    if not condition:
        raise Trouble(words)


def expected(numpy, name, step):
    first, parts = PARTS[name]
    ids = numpy.arange(COUNT)[:, None]
    values = (ids + 1.0) / 3.0 + 1.0e-7 * numpy.arange(first, first + parts)[None, :] + step / 700.0
    return values[:, 0] if parts == 1 else values


def compare(numpy, found, name, step, end, what, tolerance=None):
    """Exactly where a reader keeps the bits, else to the tolerance."""
    values = expected(numpy, name, step)
    found = numpy.asarray(found, dtype=float).reshape(values.shape)
    if tolerance is None:
        values = values if end == "double" else values.astype(numpy.float32).astype(float)
        found = found if end == "double" else found.astype(numpy.float32).astype(float)
        require((found == values).all(), f"{what}: {name} differs")
    else:
        require((abs(found - values) <= tolerance * abs(values)).all(), f"{what}: {name} differs")


def check_npz(folder, end):
    import numpy

    for number, step in enumerate(STEPS):
        file = os.path.join(folder, f"npz_{end}_{number:04d}.npz")
        with numpy.load(file) as data:
            require(data["time"] == step / 700.0 and data["step"] == step, f"{file}: another time")
            require(data["box"].tolist() == [[0.0, -1.0, 0.0], [3.0, 1.0, 2.0]], f"{file}: another box")
            require(data["periodic"].tolist() == [True, False, True], f"{file}: other periodic directions")
            kind = "float64" if end == "double" else "float32"
            for name in PARTS:
                compare(numpy, data[name], name, step, end, file)
                require(data[name].dtype == kind, f"{file}: {name} is {data[name].dtype}")
            require(data["stress"].shape == (COUNT, 3, 3), f"{file}: shape of the stress")
            require(data["contact_id2"].tolist() == [1, -1], f"{file}: other contacts")
            require(data["contact_force"].shape == (2, 3), f"{file}: shape of the forces")
    print(f"numpy {numpy.__version__} reads npz ({end})")


def check_hdf5(folder, end):
    import numpy

    if not os.path.exists(os.path.join(folder, f"hdf5_{end}.h5")):
        raise ImportError("the example was built without the feature `hdf5`")
    import h5py

    names = {"v": "velocity", "f": "force"}
    # Of a rising xy, xz, yz: each row a vector of the box.
    edges = [[[3.0, 0.0, 0.0], [0.5, 2.0, 0.0], [0.0, -0.25, 2.0]]]
    kind = "float64" if end == "double" else "float32"
    # The compressed files have 64 bits.
    for series in [f"hdf5_{end}"] + (["hdf5_compressed"] if end == "double" else []):
        with h5py.File(os.path.join(folder, f"{series}.h5")) as index:
            require(list(index["frames"]) == ["0000", "0001", "0002"], f"{series}: frames {list(index['frames'])}")
            require(index["step"][:].tolist() == list(STEPS), f"{series}: other steps")
            require(index["time"][:].tolist() == [step / 700.0 for step in STEPS], f"{series}: other times")
            require(index["particle_count"][:].tolist() == [COUNT] * 3, f"{series}: other numbers of particles")
            require(index["contact_count"][:].tolist() == [2] * 3, f"{series}: other numbers of contacts")
            for number, step in enumerate(STEPS):
                frame, what = index[f"frames/{number:04d}"], f"{series}, frame {number}"
                require(frame["h5md"].attrs["version"].tolist() == [1, 1], f"{what}: no H5MD")
                particles, contacts = frame["particles/all"], frame["contacts"]
                require(list(frame["parameters/materials"].attrs["names"]) == ["glass", "steel"], f"{what}: other materials")
                box = particles["box"]
                require(box.attrs["dimension"] == 3, f"{what}: dimension of the box")
                require(list(box.attrs["boundary"]) == ["periodic", "none", "periodic"], f"{what}: other periodic directions")
                require(box["edges/value"][:].tolist() == edges, f"{what}: the box is {box['edges/value'][:]}")
                require(box["offset/value"][:].tolist() == [[0.0, -1.0, 0.0]], f"{what}: another corner")
                for group in [frame, particles["position"], contacts["force"], box["edges"]]:
                    require(group["step"][:].tolist() == [step] and group["time"][:].tolist() == [step / 700.0], f"{what}: another time")
                    require(group["time"].attrs["unit"] == "s", f"{what}: unit of the time")
                for name, (_, parts) in PARTS.items():
                    value = particles[f"{names.get(name, name)}/value"]
                    shape = {1: (), 3: (3,), 9: (3, 3)}[parts]
                    require(value.shape == (1, COUNT) + shape, f"{what}: shape {value.shape} of {name}")
                    require(value.dtype == kind, f"{what}: {name} is {value.dtype}")
                    compare(numpy, value[0], name, step, end, what)
                    filters = (value.compression, value.shuffle)
                    require(filters == (("gzip", True) if series == "hdf5_compressed" else (None, False)), f"{what}: filters {filters}")
                require(particles["species/value"][0].tolist() == [0, 1] * 3 + [0], f"{what}: other materials")
                if series != "hdf5_compressed":
                    units = [particles[f"{name}/value"].attrs["unit"] for name in ("position", "radius", "velocity", "stress")]
                    require(units == ["m", "m", "m/s", "Pa"], f"{what}: units {units}")
                    require(contacts["force/value"].attrs["unit"] == "N", f"{what}: unit of the force")
                require(contacts["id2/value"][0].tolist() == [1, -1], f"{what}: other contacts")
                forces = numpy.array([[0.1, 0.2, 0.3], [step / 700.0, 0.0, -1.0e-9]]).astype(kind)
                require((contacts["force/value"][0] == forces).all(), f"{what}: other forces")
    print(f"h5py {h5py.__version__} reads hdf5 ({end})")


def check_csv(folder, end):
    import numpy
    import pandas

    axes = "xyz"
    columns = {
        "position": list(axes),
        "radius": ["radius"],
        "v": ["vx", "vy", "vz"],
        "omega": ["omegax", "omegay", "omegaz"],
        "f": ["fx", "fy", "fz"],
        "stress": [f"stress_{one}{other}" for one in axes for other in axes],
    }
    for number, step in enumerate(STEPS):
        file = os.path.join(folder, f"csv_{end}_{number:04d}.csv")
        # Before version 3 pandas reads every bit only if told so.
        options = {} if int(pandas.__version__.split(".")[0]) >= 3 else {"float_precision": "round_trip"}
        table = pandas.read_csv(file, **options)
        require(table["material"].tolist() == ["glass", "steel"] * 3 + ["glass"], f"{file}: other materials")
        for name, names in columns.items():
            compare(numpy, table[names].values, name, step, end, file)
        contacts = pandas.read_csv(os.path.join(folder, f"csv_{end}_contacts_{number:04d}.csv"))
        require(contacts["id2"].tolist() == [1, -1], f"{file}: other contacts")
    print(f"pandas {pandas.__version__} reads csv ({end})")


def check_compressed(folder, end):
    """The same numbers from compressed files, to the bit."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    if end != "double":
        return
    for number in range(len(STEPS)):
        for kind in ("particles", "contacts"):
            read = []
            for name in ("double", "compressed"):
                reader = vtkXMLPolyDataReader()
                reader.SetFileName(os.path.join(folder, f"vtk_{name}_{kind}_{number:04d}.vtp"))
                reader.Update()
                data = reader.GetOutput()
                columns = data.GetPointData() if kind == "particles" else data.GetCellData()
                arrays = {columns.GetArrayName(n): vtk_to_numpy(columns.GetArray(n)) for n in range(columns.GetNumberOfArrays())}
                arrays["Points"] = vtk_to_numpy(data.GetPoints().GetData())
                read.append(arrays)
            plain, compressed = read
            require(plain.keys() == compressed.keys() and len(plain) > 3, f"{kind}: {sorted(compressed)}")
            for name, values in plain.items():
                require((values == compressed[name]).all() and values.shape == compressed[name].shape, f"compressed {kind}: {name} differs")
    print("VTK reads compressed files")


def check_vtk(folder, end):
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    for number, step in enumerate(STEPS):
        file = os.path.join(folder, f"vtk_{end}_particles_{number:04d}.vtp")
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(file)
        reader.Update()
        data = reader.GetOutput()
        arrays = data.GetPointData()
        found = {name: vtk_to_numpy(arrays.GetArray(name)) for name in PARTS if name != "position"}
        found["position"] = vtk_to_numpy(data.GetPoints().GetData())
        for name, values in found.items():
            compare(numpy, values, name, step, end, file)
            require(values.dtype == ("float64" if end == "double" else "float32"), f"{file}: {name} is {values.dtype}")
        if end == "double":
            check_surfaces(folder, number, step)
    print(f"VTK reads vtk ({end})")


def check_surfaces(folder, number, step):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    reader = vtkXMLPolyDataReader()
    file = os.path.join(folder, f"vtk_double_surfaces_{number:04d}.vtp")
    reader.SetFileName(file)
    reader.Update()
    data = reader.GetOutput()
    require(data.GetNumberOfPolys() == 1 and data.GetNumberOfPoints() == 3, f"{file}: no triangle")
    height = vtk_to_numpy(data.GetPoints().GetData())[:, 2]
    require((height == step / 700.0).all(), f"{file}: another height")
    require(vtk_to_numpy(data.GetCellData().GetArray("wall")).tolist() == [2], f"{file}: another wall")


def check_image(folder, end):
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLImageDataReader

    if end != "double":
        return
    reader = vtkXMLImageDataReader()
    file = os.path.join(folder, "image.vti")
    reader.SetFileName(file)
    reader.Update()
    data = reader.GetOutput()
    require(data.GetDimensions() == (5, 4, 3), f"{file}: {data.GetDimensions()} points")
    require(data.GetOrigin() == (-1.0, 0.0, 0.1), f"{file}: another origin")
    require(data.GetSpacing() == (0.5, 0.25, 1.0 / 3.0), f"{file}: another spacing")
    density = vtk_to_numpy(data.GetCellData().GetArray("density"))
    require((density == numpy.arange(24) / 7.0).all(), f"{file}: density differs")
    stress = vtk_to_numpy(data.GetCellData().GetArray("stress"))
    require((stress == numpy.arange(24.0)[:, None] + numpy.arange(9) / 3.0).all(), f"{file}: stress differs")
    print("VTK reads images of fields")


def check_ovito(folder, end):
    import numpy
    import ovito
    from ovito.io import import_file

    # OVITO keeps radii with 32 bits; of other numbers its parser may miss the last bits.
    rounded = 1.2e-7
    names = {"position": "Position", "radius": "Radius", "v": "Velocity", "omega": "Angular Velocity", "f": "Force"}
    for file in (f"lammps_dump_{end}.dump", f"xyz_{end}.xyz"):
        pipeline = import_file(os.path.join(folder, file))
        require(pipeline.num_frames == len(STEPS), f"OVITO finds {pipeline.num_frames} frames in {file}")
        for number, step in enumerate(STEPS):
            data = pipeline.compute(number)
            require(abs(data.attributes["Time"] - step / 700.0) < 1e-15, f"{file}: another time")
            cell = numpy.asarray(data.cell)
            vectors = [[3.0, 0.5, 0.0, 0.0], [0.0, 2.0, -0.25, -1.0], [0.0, 0.0, 2.0, 0.0]]
            require(numpy.allclose(cell, vectors, rtol=0, atol=1e-6), f"{file}: the cell is {cell}")
            require(tuple(data.cell.pbc) == (True, False, True), f"{file}: other periodic directions")
            for name, ours in names.items():
                tolerance = 1e-14 if end == "double" and name != "radius" else rounded
                compare(numpy, data.particles[ours], name, step, end, file, tolerance)
    print(f"OVITO {ovito.version_string} reads lammps-dump and xyz ({end})")


def main(arguments):
    if len(arguments) != 1:
        print(__doc__)
        return 2
    try:
        for check in (check_npz, check_hdf5, check_csv, check_vtk, check_compressed, check_image, check_ovito):
            for end in ("double", "single"):
                try:
                    check(arguments[0], end)
                except ImportError as error:
                    print(f"skipped: {check.__name__}: {error}")
    except (Trouble, OSError, ValueError, KeyError) as trouble:
        print(f"trouble: {trouble}")
        return 1
    print("all well")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
