"""Files that ParaView opens, from the windows of a chain: CHAIN/paraview/<picture>.pvd, each with one file a sample.

usage: paraview.py CHAIN [--begin T] [--end T]

Pictures with time: waves (the water surface, a line), flow (the near field's grid), particles, blocks (a point each) and
blocks_wires (a line each); without time: structure.vtp, bed.vtp, blocks_mound.vtp (points with their diameter). All stand in
the chain's axes (x shoreward, y along the breakwater, z up), so they fit into one view; a vector in the (x, z) plane gets
y = 0. Every field of the windows keeps its name, its precision and its values, at every stored time, once. A sample's file
that is newer than its window is not written again, so a run that still goes on can be looked at again and again.
"""
import argparse
import pathlib
import sys

import h5py
import numpy

sys.dont_write_bytecode = True
import run_folder  # noqa: E402

VTK_TYPES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "i8": "Int64"}


def write_vtk(path, kind, piece, sections, whole=""):
    """One XML file of VTK: the arrays of each section are declared in it, and follow at its end as raw bytes."""
    text, blocks, offset = "", [], 0
    for section, arrays in sections.items():
        text += f"<{section}>"
        for name, values in arrays.items():
            values = numpy.ascontiguousarray(values)
            text += (f'<DataArray type="{VTK_TYPES[values.dtype.str[1:]]}" Name="{name}" format="appended" offset="{offset}" '
                     f'NumberOfComponents="{values.shape[1] if values.ndim == 2 else 1}"/>')
            blocks += [numpy.array(values.nbytes, "u8").tobytes(), values.tobytes()]
            offset += 8 + values.nbytes
        text += f"</{section}>\n"
    unfinished = path.with_suffix(".part")
    with open(unfinished, "wb") as file:
        file.write(f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="1.0" header_type="UInt64" '
                   f'byte_order="{sys.byteorder.capitalize()}Endian">\n<{kind}{whole}>\n<Piece {piece}>\n{text}</Piece>\n</{kind}>\n'
                   '<AppendedData encoding="raw">_'.encode())
        file.writelines(blocks)
        file.write(b"</AppendedData>\n</VTKFile>\n")
    unfinished.replace(path)


def spatial(values):
    """Rows of (x, z) as (x, 0, z); scalars and rows of three or four as they are."""
    if values.ndim == 2 and values.shape[1] == 2:
        return numpy.column_stack([values[:, 0], numpy.zeros_like(values[:, 0]), values[:, 1]])
    return values


def write_points(path, points, point_fields, lines=None, line_fields=None):
    """Points, each drawn as a dot, or joined by `lines` (lists of point numbers)."""
    cells, cell_section = ([[i] for i in range(len(points))], "Verts") if lines is None else (lines, "Lines")
    write_vtk(path, "PolyData", f'NumberOfPoints="{len(points)}" NumberOf{cell_section}="{len(cells)}"', {
        "PointData": {name: spatial(values) for name, values in point_fields.items()},
        "CellData": line_fields or {},
        "Points": {"Points": spatial(points)},
        cell_section: {"connectivity": numpy.array([point for cell in cells for point in cell], "i8"),
                       "offsets": numpy.cumsum([len(cell) for cell in cells], dtype="i8")}})


def fields_of(group, shape, k):
    """Sample k of every dataset of a group that holds a value, or a few, at each of `shape` places, and what is fixed there."""
    count, samples, fields = int(numpy.prod(shape)), len(group["time"] if "time" in group else group.file["time"]), {}
    for name, dataset in group.items():
        if not isinstance(dataset, h5py.Dataset) or name in ("time", "position"):
            continue
        if dataset.shape[:1 + len(shape)] == (samples, *shape):
            fields[name] = dataset[k].reshape(count, *dataset.shape[1 + len(shape):])
        elif dataset.shape == shape:
            fields[name] = dataset[()].reshape(count)
    return fields


def write_waves(path, window, geometry, k):
    x, elevation = window["x"][()], window["surface_elevation"][k]
    write_points(path, numpy.column_stack([x, elevation]), fields_of(window, x.shape, k), [range(len(x))])


def write_flow(path, window, geometry, k):
    group = window["flow"]
    x, z = group["x"][()], group["z"][()]
    extent = f"0 {len(x) - 1} 0 0 0 {len(z) - 1}"
    fields = fields_of(group, (len(z), len(x)), k)
    write_vtk(path, "RectilinearGrid", f'Extent="{extent}"',
              {"PointData": {name: spatial(values) for name, values in fields.items()}, "CellData": {},
               "Coordinates": {"x": x, "y": numpy.zeros(1), "z": z}}, whole=f' WholeExtent="{extent}"')


def write_particles(path, window, geometry, k):
    group = window["particles"]
    position = group["position"][k]
    write_points(path, position, fields_of(group, (len(position),), k))


def write_blocks(path, window, geometry, k):
    position = window["blocks/position"][k]
    places = {name: geometry[f"/blocks/{name}"] for name in ("shape", "fixed")}
    write_points(path, position, {**fields_of(window["blocks"], (len(position),), k), **places,
                                  "number": numpy.arange(1, len(position) + 1)})


def write_wires(path, window, geometry, k):
    """From sphere to sphere; a wire across periodic sides ends at the image of its second sphere."""
    position, orientation = window["blocks/position"][k], window["blocks/orientation"][k]
    ends, shapes = geometry["/wires/ends"], geometry["/blocks/shape"]
    points = numpy.zeros((2 * len(ends), 3))
    for end in (0, 1):
        block, sphere = ends[:, 2 * end], ends[:, 2 * end + 1]
        offset = numpy.array([geometry[f"/shapes/{shapes[b]}/spheres"][s] for b, s in zip(block, sphere)])
        w, axis = orientation[block, :1], orientation[block, 1:]
        cross = numpy.cross(axis, offset)
        points[end::2] = position[block] + offset + 2 * (w * cross + numpy.cross(axis, cross))
    points[1::2, 1] += geometry.get("/wires/image_offset", 0)
    fixed = {name: geometry[f"/wires/{name}"] for name in ("rest_length", "stiffness") if f"/wires/{name}" in geometry}
    write_points(path, points, {}, [(2 * i, 2 * i + 1) for i in range(len(ends))],
                 {**fields_of(window["wires"], (len(ends),), k), **fixed})


def write_picture(chain, folder, name, needed, time_name, write_sample, suffix, begin, end):
    """All samples of one picture and its .pvd; nothing where no window holds it."""
    geometry = run_folder.read_geometry(folder)
    into, last, listed, number = chain / "paraview" / name, -numpy.inf, [], 0
    for path in run_folder.window_paths(folder):
        with h5py.File(path) as window:
            if needed not in window or 0 in window[needed].shape:
                continue
            for k, time in enumerate(window[time_name][()]):
                if time <= last + 1e-9:
                    continue  # the instant that two windows share
                last, number = time, number + 1
                if not begin <= time <= end:
                    continue
                into.mkdir(parents=True, exist_ok=True)
                sample = into / f"{number - 1:06d}.{suffix}"
                if not sample.exists() or sample.stat().st_mtime <= path.stat().st_mtime:
                    write_sample(sample, window, geometry, k)
                listed.append(f'<DataSet timestep="{float(time)!r}" part="0" file="{name}/{sample.name}"/>\n')
    if listed:
        kept = {line.split('file="')[1].split('"')[0].split("/")[1] for line in listed}
        for path in into.iterdir():
            if path.name not in kept:
                path.unlink()
        collection = into.with_suffix(".pvd")
        collection.write_text(f'<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n{"".join(listed)}'
                              "</Collection>\n</VTKFile>\n")
        print(f"{collection}: {len(listed)} samples")


def write_outlines(chain):
    """What does not move: the structure's polygons, the bed and the mound's spheres."""
    into = chain / "paraview"
    for folder in sorted(path.parent for path in chain.glob("*/geometry.h5")):
        geometry, found = run_folder.read_geometry(folder), {}
        polygons = [values for name, values in geometry.items() if name.startswith("/structure/")]
        if polygons:
            starts = numpy.cumsum([0] + [len(polygon) for polygon in polygons])
            found["structure"] = (numpy.concatenate(polygons), {},
                                  [[*range(a, b), a] for a, b in zip(starts, starts[1:])])
        if "/bed_polyline" in geometry:
            found["bed"] = (geometry["/bed_polyline"], {}, [range(len(geometry["/bed_polyline"]))])
        if len(geometry.get("/mound/spheres", ())):
            spheres = geometry["/mound/spheres"]
            found[f"{folder.name}_mound"] = (spheres, {"diameter": numpy.full(len(spheres), geometry["/mound/diameter"][0])}, None)
        for name, (points, fields, lines) in found.items():
            into.mkdir(exist_ok=True)
            write_points(into / f"{name}.vtp", points, fields, lines)
            print(into / f"{name}.vtp")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("chain", type=pathlib.Path, help="folder of a chain: waves, flow, blocks, blocks_<layout>")
    parser.add_argument("--begin", type=float, default=-numpy.inf, help="first instant, s")
    parser.add_argument("--end", type=float, default=numpy.inf, help="last instant, s")
    options = parser.parse_args()
    chain, span = options.chain, (options.begin, options.end)
    pictures = [("waves", "waves", "surface_elevation", "time", write_waves, "vtp"),
                ("flow", "flow", "flow/velocity", "flow/time", write_flow, "vtr"),
                ("flow", "particles", "particles/position", "particles/time", write_particles, "vtp")]
    for folder in sorted(path.parent.name for path in chain.glob("blocks*/geometry.h5")):
        pictures += [(folder, folder, "blocks/position", "time", write_blocks, "vtp"),
                     (folder, f"{folder}_wires", "wires/tension", "time", write_wires, "vtp")]
    present = [picture for picture in pictures if run_folder.window_paths(chain / picture[0])]
    if not present:
        sys.exit(f"paraview: {chain} holds no windows of waves, flow or blocks")
    for folder, *picture in present:
        write_picture(chain, chain / folder, *picture, *span)
    write_outlines(chain)


if __name__ == "__main__":
    main()
