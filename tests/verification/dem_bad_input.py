"""Bad input gets one clear line with file, line and key, exit 2, before anything runs; nothing written is lost."""
import os
import tempfile

import h5py
import numpy as np

from dem_flow import standing_wave, write_flow
from dem_program import Checks, run

check = Checks()
GOOD = """[time]
end = 0.2
window = 0.1
[dem]
width = 0.1
[dem.blocks]
shape = "beehive96"
rows = 2
columns = 2
origin = [0.15, 0.025]
pitch = [0.05, 0.05]
[dem.mound]
profile = [[0.0, -0.2], [0.2, -0.2]]
roughness = 0.004
[wires]
psi = 0.3
"""


def refused(what, text, *words, arguments=(), verb="run"):
    r = run(text, *arguments, verb=verb)
    lines = [line for line in r.message.strip().splitlines() if line]
    good = r.status == 2 and all(any(w in line for line in lines) for w in words) and not os.path.exists(os.path.join(r.folder, "run.json"))
    check.true(what, good, f"exit {r.status}: {r.message.strip()}")


def put(extra, old="", new=""):
    return GOOD.replace(old, new) + extra if old else GOOD + extra


refused("unknown shape", put("", '"beehive96"', '"bee"'), "dem.blocks.shape", "unknown shape 'bee'", "scene.toml:7")
refused("shape file that is missing", put("", '"beehive96"', '"mine.toml"'), "mine.toml")
refused("unknown block in a link", put("[[wires.link]]\nblocks = [1, 9]\n"), "scene.toml:18", "no block 9", "1 to 4")
refused("block number that is no whole number", put("[[wires.link]]\nblocks = [1, 2.5]\n"), "no block 2.5")
refused("link to itself", put("[[wires.link]]\nblocks = [2, 2]\n"), "scene.toml:18", "linked to itself")
refused("the same link twice", put("[[wires.link]]\nblocks = [1, 2]\n[[wires.link]]\nblocks = [2, 1]\n"), "linked twice", "scene.toml:20")
refused("sphere the shape has not", put("[[wires.link]]\nblocks = [1, 2]\nspheres = [1, 97]\n"), "no sphere 97", "1 to 96")
refused("row that is not there", put("[[wires.along]]\nrows = [3]\n"), "wires.along", "no number 3")
refused("unknown key", put("", "width = 0.1", "widht = 0.1"), "did you mean 'width'")
refused("periodic box narrower than two blocks", put("", "width = 0.1", 'width = 0.05\nsides = "periodic"'), "dem.width", "too narrow")
refused("periodic sides and a mound that is not as wide", put("", "roughness = 0.004", "roughness = 0.004\ny = [0.0, 0.12]").replace("width = 0.1", 'width = 0.25\nsides = "periodic"'),
        "scene.toml:16", "dem.mound.y", "0.25 m")
refused("periodic sides and a plane across them", put("", "width = 0.1", 'width = 0.25\nsides = "periodic"\nplanes = [{ point = [0.0, 0.0, -1.0], normal = [0.0, 1.0, 0.0] }]'),
        "scene.toml:7", "normal", "along y")
refused("negative friction", put("", "width = 0.1", "width = 0.1\nfriction = -1.0"), "dem.friction")
refused("mound whose x does not increase", put("", "[[0.0, -0.2], [0.2, -0.2]]", "[[0.2, -0.2], [0.0, -0.2]]"), "dem.mound.profile")
refused("no blocks", "[time]\nend = 1.0\n[dem]\ndry = true\n", "no blocks")
refused("blocks inside each other", GOOD.split("[dem.blocks]")[0] +
        '[[dem.block]]\nshape = "cube27"\nposition = [0.0, 0.05, 0.0]\n[[dem.block]]\nshape = "cube27"\nposition = [0.01, 0.05, 0.0]\n', "starts", "deep in block", "position")
refused("block inside the mound", put('[[dem.block]]\nshape = "sphere"\nposition = [0.05, 0.05, -0.25]\n'), "starts inside the mound", "position")
refused("effect that cannot be on", put('[effects]\nwires = "on"\n'), "effects.wires", "no links")

refused("blocks beside the mound", put("", "origin = [0.15, 0.025]", "origin = [0.30, 0.025]"), "dem.blocks.origin", "beside the mound", "scene.toml:10")
refused("check of blocks beside the mound", put("", "origin = [0.15, 0.025]", "origin = [0.30, 0.025]"), "dem.blocks.origin", "beside the mound", verb="check")
refused("single block beside the mound", put('[[dem.block]]\nshape = "sphere"\nposition = [0.5, 0.05, -0.1]\n'), "beside the mound", "position", "scene.toml:19")
refused("no whole number of rows", put("", "rows = 2", "rows = 2.5"), "dem.blocks.rows")
refused("no rows at all", put("", "rows = 2", "rows = 0"), "dem.blocks.rows")
refused("number that is not finite", put("", "width = 0.1", "width = nan"), "dem.width")
refused("text for a number", put("", "width = 0.1", 'width = "wide"'), "dem.width")
refused("negative roughness", put("", "roughness = 0.004", "roughness = -0.004"), "dem.mound.roughness")
refused("mound of too many columns", put("", "[[0.0, -0.2], [0.2, -0.2]]", "[[0.0, -0.2], [90000.0, -0.2]]"), "dem.mound.profile", "columns")
refused("time step of zero", put("", "width = 0.1", "width = 0.1\ntime_step = 0.0"), "dem.time_step")
refused("Poisson ratio that cannot be", put("", "width = 0.1", "width = 0.1\npoisson_ratio = 0.5"), "dem.poisson_ratio")
refused("unknown contact law", put("", "width = 0.1", 'width = 0.1\ncontact = "herz"'), "dem.contact", "hertz")
refused("negative psi", put("", "psi = 0.3", "psi = -0.3"), "wires.psi")
refused("end before begin", put("", "end = 0.2", "end = -0.2"), "time.end")
refused("fewer wires than none", put("[[wires.link]]\nblocks = [1, 2]\nwires = -1\n"), "wires.link", "wires")
refused("link with a third block", put("[[wires.link]]\nblocks = [1, 2, 3]\n"), "blocks")
refused("span of columns the wrong way round", put("[[wires.along]]\nrows = [1]\ncolumns = [2, 1]\n"), "wires.along", "columns")
refused("orientation of no length", put('[[dem.block]]\nshape = "sphere"\nposition = [0.05, 0.05, -0.1]\norientation = [0.0, 0.0, 0.0, 0.0]\n'), "orientation")
refused("plane without a normal", put("", "width = 0.1", "width = 0.1\nplanes = [{ point = [0.0, 0.0, -1.0], normal = [0.0, 0.0, 0.0] }]"), "normal")
refused("broken TOML", put("[[wires.link"), "scene.toml:17")

far = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(far, standing_wave(0.05, 1.2, 0.3, 1.0), np.linspace(0.12, 1.0, 20), np.linspace(-0.3, 0.2, 11), 0.0, 0.2, 0.1, 0.02)
refused("flow that does not cover the blocks", GOOD, "does not cover block", arguments=("--flow", far))
short = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(short, standing_wave(0.05, 1.2, 0.3, 1.0), np.linspace(0.0, 1.0, 20), np.linspace(-0.3, 0.2, 11), 0.0, 0.1, 0.1, 0.02)
refused("flow that ends before the time asked for", GOOD, "the flow ends at t = 0.1 s", arguments=("--flow", short))
refused("flow folder that is not there", GOOD, "no such folder", arguments=("--flow", "/nonexistent"))

other = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(other, standing_wave(0.05, 1.2, 0.3, 1.0), np.linspace(0.0, 1.0, 20), np.linspace(-0.3, 0.2, 11), 0.0, 0.2, 0.1, 0.02)
with h5py.File(os.path.join(other, "geometry.h5"), "w") as f:
    f["/structure/0"] = np.array([[-0.5, -0.3], [0.0, -0.15], [1.0, -0.15], [1.0, -0.3]])
    f["/structure/0"].attrs.create("units", b"m", dtype="S1")
refused("flow over another mound", GOOD, "flow of another scene", "dem.mound.profile", arguments=("--flow", other))
cut = os.path.join(other, "window_000000.h5")
os.remove(os.path.join(other, "geometry.h5"))
with open(cut, "rb") as f:
    content = f.read()
with open(cut, "wb") as f:
    f.write(content[: len(content) // 2])
refused("truncated window of the flow", GOOD, "window_000000.h5", arguments=("--flow", other))
refused("state file that is not there", GOOD, "nowhere.h5", arguments=("--from", "/nonexistent/nowhere.h5"))

home = tempfile.mkdtemp(prefix="tsunagi_dem_")
layout = os.path.join(home, "layout.toml")
with open(layout, "w") as f:
    f.write("[[wires.along]]\nrows = [1]\n[wires.put_back]\nrows = [1]\n")
refused("blocks put back in a run that has moved none", GOOD, "layout.toml:3:", "wires.put_back", "needs --from", arguments=("--wires", layout))
refused("the same in the scene itself", put("[wires.put_back]\nblocks = [1]\n"), "scene.toml:17:", "wires.put_back", "needs --from")
refused("check of a layout that puts blocks back", GOOD, "layout.toml:3:", "wires.put_back", "needs --from", arguments=("--wires", layout), verb="check")
refused("packing of a scene that puts blocks back", put("[wires.put_back]\nblocks = [1]\n"), "scene.toml:17:", "wires.put_back", "does not belong", verb="pack")

for key, value in (("time", "0.05"), ("clock", "0.0"), ("calm", "true")):
    text = put(f"[dem.restart]\n{key} = {value}\n")
    refused(f"dem.restart.{key} in a run that goes on from none", text, "scene.toml:18:", f"dem.restart.{key}", "needs --from")
    refused(f"check of the same, {key}", text, "scene.toml:18:", f"dem.restart.{key}", "needs --from", verb="check")
    refused(f"packing of the same, {key}", text, "scene.toml:18:", f"dem.restart.{key}", "does not belong", verb="pack")
refused("dem.restart.clock by --set", GOOD, "dem.restart.clock", "needs --from", arguments=("--set", "dem.restart.clock=0.1"))

packed = run(GOOD, verb="pack")
check.true("packing for the state tests", packed.status == 0, packed.message)
state = os.path.join(packed.folder, "state.h5")
checked = run(GOOD, "--wires", layout, "--from", state, verb="check")
check.true("check of the same layout with a state to put blocks back in", checked.status == 0, checked.message.strip()[-200:] if checked.status else "")
refused("check against a state of another scene", put("", "roughness = 0.004", "roughness = 0.004\nseed = 2"), "state of another scene",
        arguments=("--from", state), verb="check")
refused("state of another scene", put("", "roughness = 0.004", "roughness = 0.004\nseed = 2"), "state of another scene", arguments=("--from", state))
fixed = put('[[dem.block]]\nshape = "sphere"\nposition = [0.05, 0.05, 0.1]\nfixed = true\n[wires.put_back]\nblocks = [2, 5]\n')
refused("fixed block put back", fixed, "scene.toml:22:", "wires.put_back.blocks", "block 5 is fixed", arguments=("--from", state))
with open(state, "rb") as f:
    content = f.read()
with open(state + ".cut", "wb") as f:
    f.write(content[: len(content) // 2])
refused("truncated state", GOOD, "state.h5.cut", arguments=("--from", state + ".cut"))

with open(state + ".text", "w") as f:
    f.write("no HDF5 at all")
refused("state that is no HDF5 file", GOOD, "state.h5.text", arguments=("--from", state + ".text"))
refused("restart time without a window", put("[dem.restart]\ntime = 0.05\n"), "restart", arguments=("--from", state))

# What an earlier run wrote survives a bad second call.
done = run(GOOD)
before = done.windows()
bad = run(put("[[wires.link]]\nblocks = [2, 2]\n"), folder=os.path.dirname(done.folder))
check.true("a refused call leaves earlier results alone", bad.status == 2 and done.windows() == before and len(before) == 2)
check.end()
