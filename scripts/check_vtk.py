#!/usr/bin/env python3
"""Reads a run folder with the real VTK readers and prints what they found.

    python3 scripts/check_vtk.py <run folder> [--sample] [--without-ovito]

Every `*series.pvd` of the folder is opened; each frame must have the block Particles and may have Contacts, Walls and Surfaces, one value per
row in each array, and times that increase. With --sample the values of the example `sample_run` of pulvis-io are
compared too. OVITO repeats the check if it is installed, but not of compressed files, which it does not read: --without-ovito.

Exit status: 0 all well (or, aloud, no Python VTK here), 1 trouble, 2 wrong use.
"""

import math
import os
import sys
import xml.etree.ElementTree as xml

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkCommand
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader
except ImportError as error:
    print(f"skipped: Python VTK is not installed ({error}); `pip install vtk` makes this check run")
    sys.exit(0)


class Trouble(Exception):
    """Something a user of the files would stumble over."""


def require(condition, words):
    if not condition:
        raise Trouble(words)


def read_blocks(path):
    """The blocks of a .vtm by name; anything VTK complains about is trouble."""
    reader = vtkXMLMultiBlockDataReader()
    complaints = []
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda *_: complaints.append(event))
    reader.SetFileName(path)
    reader.Update()
    require(not complaints and reader.GetErrorCode() == 0, f"VTK complains about {path}")
    blocks = reader.GetOutput()
    named = {}
    for number in range(blocks.GetNumberOfBlocks()):
        name = blocks.GetMetaData(number).Get(blocks.NAME())
        require(blocks.GetBlock(number) is not None, f"block {name} of {path} is empty: its file cannot be read")
        named[name] = blocks.GetBlock(number)
    known = {"Particles", "Contacts", "Walls", "Surfaces"}
    require({"Particles"} <= set(named) <= known, f"{path} has the blocks {sorted(named)}")
    return named


def arrays(data, rows, what):
    """Named numpy arrays of point or cell data, one row each."""
    found = {}
    for number in range(data.GetNumberOfArrays()):
        array = data.GetArray(number)
        require(array is not None, f"an array of the {what} cannot be read")
        require(array.GetNumberOfTuples() == rows, f"{what} array {array.GetName()} has not one value per row")
        found[array.GetName()] = vtk_to_numpy(array)
    return found


def describe(named):
    return ", ".join(
        f"{name}[{'x'.join(map(str, values.shape[1:])) or 1}] {values.dtype}" for name, values in named.items()
    )


def check_frame(path, time, sample):
    blocks = read_blocks(path)
    # A frame without contacts has no such block.
    particles, contacts = blocks["Particles"], blocks.get("Contacts", vtkPolyData())
    count, lines = particles.GetNumberOfPoints(), contacts.GetNumberOfLines()
    require(particles.GetNumberOfVerts() == count, f"{path}: not one vertex per particle")
    require(contacts.GetNumberOfPoints() == 2 * lines, f"{path}: not two points per contact")
    of_particles = arrays(particles.GetPointData(), count, "particle")
    of_contacts = arrays(contacts.GetCellData(), lines, "contact")
    print(f"  t = {time:<12g} {count} particles, {lines} contacts")
    if count:
        print(f"    particles: {describe(of_particles)}")
    if lines:
        print(f"    contacts:  {describe(of_contacts)}")
    if count and lines and {"id"} <= set(of_particles) and {"id1", "id2"} <= set(of_contacts):
        known = set(of_particles["id"].tolist())
        for name in ("id1", "id2"):
            # A wall contact has no second particle: its id2 is -1 - the number of the wall.
            named = {number for number in of_contacts[name].tolist() if name == "id1" or number >= 0}
            missing = named - known
            require(not missing, f"{path}: {name} names particles that do not exist: {sorted(missing)[:5]}")
    if sample and count:
        check_sample(particles, contacts, of_particles, of_contacts, time)
    return count, lines


def check_sample(particles, contacts, of_particles, of_contacts, time):
    """The formulas of examples/sample_run.rs, bit for bit."""
    count = particles.GetNumberOfPoints()
    for row in range(count):
        number = row + 1
        expected = (2.0e-3 * number, time, -1.0)
        require(particles.GetPoint(row) == expected, f"particle {number} is at {particles.GetPoint(row)}")
        require(of_particles["id"][row] == number, f"particle {number} has another id")
        require(of_particles["type"][row] == number % 2 + 1, f"particle {number} has another type")
        require(of_particles["radius"][row] == 1.0e-3 * (1.0 + 1.0 / number), f"particle {number}: radius")
        require(tuple(of_particles["v"][row]) == (number, 0.5, time), f"particle {number}: velocity")
    for row in range(contacts.GetNumberOfLines()):
        require(tuple(of_contacts["force"][row]) == (row, -0.5, 1.0e-9), f"contact {row}: force")
        require(of_contacts["overlap"][row] == 1.0e-6 * row, f"contact {row}: overlap")
        require((of_contacts["id1"][row], of_contacts["id2"][row]) == (row + 1, row + 2), f"contact {row}: ids")
        ends = [contacts.GetCell(row).GetPointId(end) for end in (0, 1)]
        for end, point in enumerate(ends):
            expected = particles.GetPoint(row + end)
            require(contacts.GetPoint(point) == expected, f"contact {row} ends at {contacts.GetPoint(point)}")


def check_series(index, sample, with_ovito):
    print(index)
    folder = os.path.dirname(index)
    entries = [(float(e.get("timestep")), e.get("file")) for e in xml.parse(index).iter("DataSet")]
    require(entries, f"{index} lists no frame")
    times = [time for time, _ in entries]
    require(all(map(math.isfinite, times)), f"{index} has a time that is not finite")
    require(all(a < b for a, b in zip(times, times[1:])), f"{index} has times that do not increase")
    frames = [check_frame(os.path.join(folder, file), time, sample) for time, file in entries]
    check_with_pyvista(index, times, frames)
    if with_ovito:
        check_with_ovito(folder, entries, frames)


def check_with_pyvista(index, times, frames):
    try:
        import pyvista
    except ImportError:
        print("  skipped: pyvista is not installed")
        return
    reader = pyvista.get_reader(index)
    require(list(reader.time_values) == times, f"pyvista reads the times {reader.time_values}")
    for time, (count, _) in zip(times, frames):
        reader.set_active_time_value(time)
        found = reader.read()[0]
        require(found["Particles"].n_points == count, f"pyvista finds {found['Particles'].n_points} particles")
    print(f"  pyvista {pyvista.__version__} reads the index: {len(times)} frames")


def check_with_ovito(folder, entries, frames):
    try:
        import ovito
        from ovito.io import import_file
    except ImportError:
        print("  skipped: ovito is not installed")
        return
    for (_, file), (count, lines) in zip(entries, frames):
        if not count:
            continue
        data = import_file(os.path.join(folder, file)).compute()
        require(data.particles is not None, f"OVITO finds no particles in {file}")
        require(data.particles.count == count, f"OVITO finds {data.particles.count} particles in {file}")
        if lines:
            held = count_ovito_contacts(data)
            require(held == lines, f"OVITO finds {held} of {lines} contacts in {file}")
    print(f"  OVITO {ovito.version_string} reads the frames")


def count_ovito_contacts(data):
    """Newer OVITO shows contacts as lines of two vertices, older ones as bonds."""
    if data.particles.bonds is not None:
        return data.particles.bonds.count
    return sum(line.count // 2 for line in data.lines.values()) if hasattr(data, "lines") else 0


def main(arguments):
    folders = [argument for argument in arguments if not argument.startswith("--")]
    if len(folders) != 1 or set(arguments) - set(folders) - {"--sample", "--without-ovito"}:
        print(__doc__)
        return 2
    indices = sorted(name for name in os.listdir(folders[0]) if name.endswith("series.pvd"))
    try:
        require(indices, f"{folders[0]} has no series.pvd")
        for name in indices:
            check_series(os.path.join(folders[0], name), "--sample" in arguments, "--without-ovito" not in arguments)
    except (Trouble, OSError, ValueError, xml.ParseError) as trouble:
        print(f"trouble: {trouble}")
        return 1
    print("all well")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
