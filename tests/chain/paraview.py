"""What `make paraview` writes, read by VTK: every field at every stored time as the windows hold it.

VTK's own XML readers are those that ParaView opens a .pvd with. Where ParaView is installed, pvbatch reads the .pvd files too.
"""
import shutil
import subprocess
import sys
import xml.etree.ElementTree

import h5py
import numpy
try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLRectilinearGridReader
except ImportError:
    sys.exit("VTK's Python modules are missing: `workflows/set_up test` installs python3-vtk9")

from harness import SCENES, SOURCE, check, environment, main, run, run_folder, test

# picture: folder, group, time, what lies at each place
PICTURES = {
    "waves": ("waves", "/", "/time", ["surface_elevation", "velocity", "still_water_depth"]),
    "flow": ("flow", "/flow/", "/flow/time", ["velocity", "acceleration", "wet"]),
    "particles": ("flow", "/particles/", "/particles/time", ["velocity", "pressure", "kind"]),
    "blocks": ("blocks", "/blocks/", "/time", ["velocity", "orientation", "angular_velocity", "displacement"]),
    "blocks_wires": ("blocks", "/wires/", "/time", ["tension", "intact"]),
}
FIXED = {"still_water_depth", "kind"}
READ_ALL = """
import sys, numpy
from paraview.simple import PVDReader
from paraview.vtk.util.numpy_support import vtk_to_numpy
for name in sys.argv[2:]:
    reader = PVDReader(FileName=f"{sys.argv[1]}/paraview/{name}.pvd")
    reader.UpdatePipelineInformation()
    for k, time in enumerate(list(reader.TimestepValues)):
        reader.UpdatePipeline(time)
        data = reader.GetClientSideObject().GetOutputDataObject(0)
        fields = {"time": time, "count": data.GetNumberOfPoints()}
        for place in (data.GetPointData(), data.GetCellData()):
            for i in range(place.GetNumberOfArrays()):
                fields[place.GetArrayName(i)] = vtk_to_numpy(place.GetArray(i))
        numpy.savez(f"{sys.argv[1]}/pvbatch_{name}_{k:06d}.npz", **fields)
"""
_chain = None


def chain(folder):
    """The small scene's first seconds, run and exported once."""
    global _chain
    if _chain is None:
        _chain = folder.parent / (folder.name + "_chain")
        run("coupler", "run", SCENES / "small.toml", "--set", "time.end=2.6", "--out", _chain).expect_done()
        make_paraview(_chain)
    return _chain


def make_paraview(out, *words):
    ended = subprocess.run(["make", "-s", "-C", SOURCE / "workflows", "paraview", f"OUT={out}", *words], capture_output=True,
                           text=True, env=environment(MAKEFLAGS=""))
    check(ended.returncode == 0, ended.stderr)


def stored(chain, picture):
    """[(time, {field: values})] of a picture as its windows hold it; an instant that two windows share once."""
    part, group, time_name, names = PICTURES[picture]
    samples = []
    for path in run_folder.window_paths(chain / part):
        with h5py.File(path) as window:
            for k, time in enumerate(window[time_name][()]):
                if not samples or time > samples[-1][0] + 1e-9:
                    samples.append((time, {name: window[group + name][()] if name in FIXED else window[group + name][k]
                                           for name in names}))
    return samples


def collection(chain, picture):
    """[(time, file)] of a .pvd."""
    root = xml.etree.ElementTree.parse(chain / f"paraview/{picture}.pvd").getroot()
    return [(float(item.get("timestep")), chain / "paraview" / item.get("file")) for item in root.iter("DataSet")]


def read(path):
    """A file as VTK reads it: the data set, and {field: values} of points and cells."""
    reader = vtkXMLRectilinearGridReader() if path.suffix == ".vtr" else vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    check(reader.GetErrorCode() == 0, f"{path}: VTK's error {reader.GetErrorCode()}")
    data = reader.GetOutput()
    return data, {place.GetArrayName(i): vtk_to_numpy(place.GetArray(i)) for place in (data.GetPointData(), data.GetCellData())
                  for i in range(place.GetNumberOfArrays())}


def check_same(what, shown, values):
    """Bit for bit, in the precision of the window; a pair (x, z) is shown as (x, 0, z)."""
    count = len(shown)
    values = values.reshape(count, -1)
    shown = shown.reshape(count, -1)
    if shown.shape[1] == 3 and values.shape[1] == 2:
        check(not shown[:, 1].any(), f"{what}: y is not zero")
        shown = shown[:, [0, 2]]
    check(shown.dtype == values.dtype, f"{what}: {shown.dtype}, stored as {values.dtype}")
    check(shown.shape == values.shape and numpy.array_equal(shown, values), f"{what}: other values than stored")


@test
def every_field_at_every_time_is_as_stored(folder):
    for picture in PICTURES:
        samples, shown = stored(chain(folder), picture), collection(chain(folder), picture)
        check([time for time, _ in shown] == [time for time, _ in samples], f"{picture}: other times than stored, or one twice")
        for (time, fields), (_, path) in zip(samples, shown):
            data, found = read(path)
            check(data.GetNumberOfPoints() > 0, f"{path}: no points")
            for name, values in fields.items():
                check(name in found, f"{picture} at {time} s: no {name}")
                check_same(f"{picture}: {name} at {time} s", found[name], values)
        print(f"    {picture}: {len(shown)} samples of {', '.join(fields)}")


@test
def places_are_those_of_the_chain(folder):
    """Points in the axes of the chain: x shoreward, z up."""
    for picture, (part, name, time_name) in {"particles": ("flow", "/particles/position", "/particles/time"),
                                             "blocks": ("blocks", "/blocks/position", "/time")}.items():
        path = collection(chain(folder), picture)[-1][1]
        with h5py.File(run_folder.window_paths(chain(folder) / part)[-1]) as window:
            check_same(f"{picture}: points", vtk_to_numpy(read(path)[0].GetPoints().GetData()), window[name][-1])
    with h5py.File(run_folder.window_paths(chain(folder) / "waves")[-1]) as window:
        points = vtk_to_numpy(read(collection(chain(folder), "waves")[-1][1])[0].GetPoints().GetData())
        check(numpy.array_equal(points, numpy.column_stack([window["x"], 0 * window["x"][()], window["surface_elevation"][-1]])),
              "waves: the line is not the water's surface")
    with h5py.File(run_folder.window_paths(chain(folder) / "flow")[-1]) as window:
        grid = read(collection(chain(folder), "flow")[-1][1])[0]
        check(grid.GetDimensions() == (len(window["flow/x"]), 1, len(window["flow/z"])), f"flow: {grid.GetDimensions()}")
        check_same("flow: x", vtk_to_numpy(grid.GetXCoordinates()), window["flow/x"][()])
        check_same("flow: z", vtk_to_numpy(grid.GetZCoordinates()), window["flow/z"][()])


@test
def wires_are_as_long_as_the_blocks_hold_them(folder):
    """Before anything moves a wire has its rest length, so its drawn ends are the spheres it is tied to."""
    blocks = chain(folder) / "blocks"
    points = vtk_to_numpy(read(collection(chain(folder), "blocks_wires")[0][1])[0].GetPoints().GetData())
    lengths = numpy.linalg.norm(points[::2] - points[1::2], axis=1)
    rest = run_folder.read_geometry(blocks)["/wires/rest_length"]
    check(abs(lengths - rest).max() < 1e-9, f"lengths {lengths[:3]}, at rest {rest[:3]}")


@test
def what_does_not_move_is_there(folder):
    for name, lines in (("structure", 1), ("bed", 1), ("blocks_mound", 0)):
        data, _ = read(chain(folder) / f"paraview/{name}.vtp")
        check(data.GetNumberOfPoints() > 1 and data.GetNumberOfLines() == lines, name)


@test
def a_run_that_went_on_is_completed(folder):
    """Samples of windows that did not change stay as they are; later ones follow; a part of the time can be asked for."""
    out = folder / "chain"
    run("boussinesq", "run", SCENES / "small.toml", "--set", "time.end=1", "--out", out / "waves").expect_done()
    make_paraview(out)
    first = {path: path.stat().st_mtime_ns for _, path in collection(out, "waves")}
    shutil.copy(run_folder.window_paths(chain(folder) / "waves")[2], out / "waves")
    make_paraview(out)
    check(len(collection(out, "waves")) == len(first) + 20, "0.5 s of samples every 0.025 s did not follow")
    check(all(path.stat().st_mtime_ns == before for path, before in first.items()), "written again without need")
    ended = subprocess.run(["/usr/bin/python3", SOURCE / "workflows/paraview.py", out, "--begin", "0.9", "--end", "1.1"])
    times = [time for time, _ in collection(out, "waves")]
    check(ended.returncode == 0 and len(times) == 9 and len(list((out / "paraview/waves").iterdir())) == 9, times)


@test
def an_empty_folder_is_told(folder):
    ended = subprocess.run(["/usr/bin/python3", SOURCE / "workflows/paraview.py", folder], capture_output=True, text=True)
    check(ended.returncode == 1 and str(folder) in ended.stderr and len(ended.stderr.splitlines()) == 1, ended.stderr)


@test
def pvbatch_shows_the_same(folder):
    if shutil.which("pvbatch") is None:
        print("    ParaView is not installed here")
        return
    script = folder / "read_all.py"
    script.write_text(READ_ALL)
    ended = subprocess.run(["pvbatch", "--force-offscreen-rendering", script, chain(folder), *PICTURES], capture_output=True, text=True)
    check(ended.returncode == 0, ended.stderr)
    for picture in PICTURES:
        for k, (time, fields) in enumerate(stored(chain(folder), picture)):
            with numpy.load(chain(folder) / f"pvbatch_{picture}_{k:06d}.npz") as found:
                check(found["time"] == time and found["count"] > 0, f"{picture}: {found['time']} for {time} s")
                for name, values in fields.items():
                    check_same(f"{picture}: {name} at {time} s", found[name], values)
        print(f"    {picture}: {k + 1} samples")


try:
    main()
finally:
    if _chain is not None:
        shutil.rmtree(_chain, ignore_errors=True)
