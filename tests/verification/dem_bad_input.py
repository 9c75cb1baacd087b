"""Bad input gets one clear line with file, line and key, exit 2, before anything runs; nothing written is lost."""
import os
import shutil
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


def refused(what, text, *words, arguments=(), verb="run", files={}):
    """Refused with one line that holds all of `words`; `files`: name and text of what stands beside the scene."""
    folder = tempfile.mkdtemp(prefix="tsunagi_dem_")
    for name, content in files.items():
        with open(os.path.join(folder, name), "w") as f:
            f.write(content)
    r = run(text, *arguments, verb=verb, folder=folder)
    lines = [line for line in r.message.strip().splitlines() if line]
    good = r.status == 2 and len(lines) == 1 and all(w in lines[0] for w in words) and not os.path.exists(os.path.join(r.folder, "run.json"))
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
INSIDE = '[time]\nend = 0.1\n[dem]\ndry = true\n[[dem.block]]\nshape = "cube27"\nposition = [0.0, 0.0, 0.0]\n[[dem.block]]\nshape = "sphere"\nposition = [{}, 0.0, 0.0]\n'
refused("block within another, where none of its outer spheres is", INSIDE.format(0.0), "scene.toml:10:", "block 2 starts 0.008 m deep in block 1")
check.true("and one beside it, which touches it", run(INSIDE.format(0.016)).status == 0)
PEBBLES = "[dem.shape]\nspheres = [[0.0, 0.0, 0.0]]\ndiameter = 0.25\n"
refused("small blocks in one place, no deeper than elements may start", INSIDE.format(0.0002).replace("cube27", "pebble.toml").replace('"sphere"', '"pebble.toml"'), "scene.toml:10:",
        "block", "deep in block", "at most 0.0005 m", files={"pebble.toml": PEBBLES})
refused("block too far away to tell overlaps apart", INSIDE.format(1.0e9), "scene.toml:10:", "block 2 is so far from the origin", "2e-07 m")
for verb in ("run", "pack", "check"):
    refused(f"{verb}: gravity that takes blocks off the mound", put("", "width = 0.1", "width = 0.1\ngravity = [0.0, 0.0, 9.81]"), "scene.toml:6:", "dem.gravity", "never settle", verb=verb)
refused("gravity along a mound with nothing at its end", put("", "width = 0.1", "width = 0.1\ngravity = [9.81, 0.0, 0.0]"), "scene.toml:6:", "dem.gravity", "never settle")
AIR = GOOD.split("[dem.mound]")[0].replace("pitch", "level = 0.1\npitch")
refused("blocks in the air over nothing", AIR, "dem.gravity", "never settle")
SLOPE = AIR.replace("width = 0.1", "width = 0.1\n{}planes = [{{ point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] }}]")
refused("blocks on a floor steeper than friction", SLOPE.format("gravity = [6.0, 0.0, -9.81]\n"), "scene.toml:6:", "dem.gravity", "never settle")
check.true("and on floors less steep, or level and without friction", all(run(SLOPE.format(keys)).status == 0 for keys in ("gravity = [5.0, 0.0, -9.81]\n", "friction = 0.0\n")))
refused("spheres that fall through the mound", put('[[dem.block]]\nshape = "tiny.toml"\nposition = [0.05, 0.05, -0.1]\n'), "scene.toml:18:", "shape", "fall through the mound",
        files={"tiny.toml": "[dem.shape]\nspheres = [[0.0, 0.0, 0.0]]\ndiameter = 0.3\n"})
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
refused("mound of too many columns", put("", "[[0.0, -0.2], [0.2, -0.2]]", "[[0.0, -0.2], [90000.0, -0.2]]"), "dem.mound.profile", "spheres")
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
# Steps that contacts and wires cannot bear, as far as a short trial shows; and those they can are let through.
def dem_keys(text):
    return put("", "width = 0.1", "width = 0.1\n" + text)


for verb in ("run", "pack", "check"):
    refused(f"{verb}: time step past what contacts bear", dem_keys("time_step = 0.01"), "scene.toml:6:", "dem.time_step", "past the limit", "that the contacts set", verb=verb)
refused("time step at which blocks tremble", dem_keys("time_step = 1.0e-3"), "dem.time_step", "past the limit")
refused("dashpots too strong for the step", dem_keys("damping_ratio = 10.0"), "dem.time_step", "the program's choice")
refused("wires too stiff for the step", put("[[wires.link]]\nblocks = [1, 2]\nstiffness = 1.0e12\n"), "dem.time_step", "that the wires set")
refused("drag too stiff for the step", dem_keys("viscosity = 10.0"), "dem.time_step", "that the water's drag sets")
refused("shape too easily turned for the step", put('[[dem.block]]\nshape = "light.toml"\nposition = [0.05, 0.05, -0.185]\n'), "dem.time_step", "past the limit",
        files={"light.toml": "[dem.shape]\nspheres = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\ninertia = [1.0e-16, 1.0e-16, 1.0e-16]\n"})
for step in (2.0e-4, 4.0e-4):
    r = run(dem_keys(f"time_step = {step}"))
    check.true(f"a step of {step} s, which contacts bear, runs", r.status == 0, r.message)
refused("time step that never arrives", dem_keys("time_step = 1.0e-25"), "dem.time_step", "steps to time.end")
refused("elements too soft to stand", dem_keys("young_modulus = 1.0e-3"), "dem.young_modulus", "too soft")
refused("deep overlaps that stop before they are counted", dem_keys("overlap_noted = 0.6"), "dem.overlap_noted", "overlap_limit")
refused("output interval of zero", dem_keys("output_interval = 0.0"), "dem.output_interval")
refused("current without water", dem_keys("dry = true\ncurrent = [1.0, 0.0, 0.0]"), "scene.toml:7:", "dem.current", "no water")
refused("blocks that float", dem_keys("density_ratio = 0.5"), "dem.density_ratio", "floats")
refused("blocks that float by the water they displace", put("", "rows = 2", "rows = 2\ndisplaced_volume = 1.0"), "dem.blocks.displaced_volume", "floats")
refused("fixed spheres in one place", dem_keys("fixed_spheres = [[0.0, 0.0, -3.0], [0.1, 0.0, -3.0], [0.0, 0.0, -3.0]]"), "dem.fixed_spheres", "1 and 3")
refused("plane of two coordinates", dem_keys("planes = [{ point = [0.0, 0.0], normal = [0.0, 0.0, 1.0] }]"), "planes[1].point", "3 numbers")
refused("element of no size", dem_keys("element_diameter = 0.0"), "dem.element_diameter")
refused("more blocks than memory", put("", "rows = 2\ncolumns = 2", "rows = 10000\ncolumns = 10000") + "[[wires.along]]\nrows = [1]\n", "dem.blocks.rows", "at most 1e+06")
refused("mound of too much roughness", put("", "roughness = 0.004", "roughness = 4000.0"), "dem.mound.profile", "spheres")
refused("mound of too much depth", put("", "roughness = 0.004", "roughness = 0.004\nleast_depth = 1.0e9"), "dem.mound.profile", "spheres")
refused("seed of more than 32 bits", put("", "roughness = 0.004", "roughness = 0.004\nseed = 4294967297"), "dem.mound.seed")

# Single blocks.
SINGLE = '[[dem.block]]\nshape = "sphere"\nposition = [0.05, 0.05, -0.1]\n'
refused("orientation of no length, and a link to that block", put(SINGLE + "orientation = [0.0, 0.0, 0.0, 0.0]\n[[wires.link]]\nblocks = [1, 5]\n"), "scene.toml:20:", "orientation")
refused("no other block than one of no orientation", '[time]\nend = 0.1\n[dem]\ndry = true\n' + SINGLE + "orientation = [0.0, 0.0, 0.0, 0.0]\n", "scene.toml:8:", "orientation")
refused("orientation that is not finite", put(SINGLE + "orientation = [nan, 0.0, 0.0, 0.0]\n"), "orientation")
refused("orientation of three numbers", put(SINGLE + "orientation = [1.0, 0.0, 0.0]\n"), "orientation", "4 numbers")
refused("velocity that is not finite", put(SINGLE + "velocity = [inf, 0.0, 0.0]\n"), "velocity")
refused("velocity past all contacts", put(SINGLE + "velocity = [1.0e6, 0.0, 0.0]\n"), "scene.toml:20:", "velocity", "contacts would be missed")
refused("spin past all contacts", put(SINGLE + "angular_velocity = [1.0e6, 0.0, 0.0]\n"), "angular_velocity", "contacts would be missed")
refused("velocity of a fixed block", put(SINGLE + "velocity = [1.0, 0.0, 0.0]\nfixed = true\n"), "scene.toml:20:", "velocity", "does not move")
refused("unknown key of a block", put(SINGLE + "mass = 3.0\n"), "mass", "unknown key")

# Links.
FIXED = ("rows = 2", "rows = 2\nfixed_rows = 1")
refused("link between two fixed blocks", put("[[wires.link]]\nblocks = [5, 6]\n", *FIXED), "scene.toml:19:", "wires.link[1].blocks", "blocks 5 and 6 are both fixed")
r = run(put("[[wires.link]]\nblocks = [1, 5]\n", *FIXED))
check.true("a link from a fixed block to one that moves is mounted", r.status == 0 and r.figure("wires.count") > 0, r.message)
refused("the same spheres linked twice, the other way round", put("[[wires.link]]\nblocks = [1, 2]\nspheres = [3, 4]\n[[wires.link]]\nblocks = [2, 1]\nspheres = [4, 3]\n"), "scene.toml:21:", "linked twice")
refused("the same row twice", put("[[wires.along]]\nrows = [1, 1]\n"), "scene.toml:18:", "linked twice")
refused("row and link the same", put("[[wires.along]]\nrows = [1]\n[[wires.link]]\nblocks = [2, 1]\n"), "linked twice")
refused("list of no rows", put("[[wires.along]]\nrows = []\n"), "wires.along[1].rows", "names none")
refused("span of one column", put("[[wires.along]]\nrows = [1]\ncolumns = [1, 1]\n"), "wires.along[1].columns", "neighbours")
refused("span that is not whole", put("[[wires.along]]\nrows = [1]\ncolumns = [1.5, 2.0]\n"), "wires.along[1].columns", "whole numbers")
refused("rows where there are none", '[time]\nend = 0.1\n[dem]\ndry = true\n' + SINGLE + "[[wires.along]]\nrows = [1]\n", "wires.along[1]", "needs [dem.blocks]")
refused("one wire of two spheres, and how many", put("[[wires.link]]\nblocks = [1, 2]\nspheres = [1, 2]\nwires = 5\n"), "scene.toml:20:", "wires.link[1].wires", "does not go with spheres")
refused("more wires than spheres face each other", put("[[wires.link]]\nblocks = [1, 2]\nwires = 500\n"), "wires.link[1].wires", "18 pairs")
refused("rest length and slack", put("[[wires.link]]\nblocks = [1, 2]\nrest_length = 0.02\nslack = 0.01\n"), "scene.toml:20:", "slack", "rest_length")


# Shape files.
def refused_shape(what, text, *words):
    refused(f"shape {what}", put("", '"beehive96"', '"mine.toml"'), "scene.toml:7:", "dem.blocks.shape", *words, files={"mine.toml": text})


TWO = "[dem.shape]\nspheres = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]\n"
refused_shape("of no spheres", "[dem.shape]\nspheres = []\n", "at least one sphere")
refused_shape("with a sphere twice", "[dem.shape]\nspheres = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]\n", "at the same place")
refused_shape("with spheres of two coordinates", "[dem.shape]\nspheres = [[0.0, 0.0], [1.0, 0.0]]\n", "mine.toml:2:", "3 numbers", "and 1 more")
refused_shape("with a sphere at no number", "[dem.shape]\nspheres = [[0.0, 0.0, nan]]\n", "mine.toml:2:", "spheres")
refused_shape("of no mass", TWO + "mass = 0.0\n", "mine.toml:3:", "mass")
refused_shape("of negative inertia", TWO + "inertia = [1.0e-6, 1.0e-6, -1.0e-6]\n", "mine.toml:3:", "inertia")
refused_shape("of an inertia no body has", TWO + "inertia = [1.0e-6, 1.0e-6, 1.0e-5]\n", "no body has the moments of inertia")
refused_shape("with an unknown key", TWO + "element = 2.0\n", "mine.toml:3:", "did you mean 'elements'")
refused_shape("with sections of a scene", TWO + "[wires]\npsi = 1.0\n", "mine.toml:3:", "wires", "does not belong in a shape")



def one_line(what, text, *words):
    r = run(text)
    lines = r.message.strip().splitlines()
    check.true(what, r.status == 2 and len(lines) == 1 and all(w in lines[0] for w in words), r.message.strip())


TRIO = '[time]\nend = 0.1\nwindow = 0.1\n[dem]\ndry = true\ngravity = [0.0, 0.0, 0.0]\n' + "".join(
    f'[[dem.block]]\nshape = "sphere"\nposition = [{0.02 * k}, 0.0, 1.0]\n' for k in range(3))
# One mistake, one line: the other keys of the same table are known all the same.
one_line("an unknown block is one mistake", TRIO + "[[wires.link]]\nblocks = [1, 7]\nspheres = [1, 1]\nrest_length = 0.02\n", "no block 7")
one_line("a link to itself is one mistake", TRIO + "[[wires.link]]\nblocks = [2, 2]\nspheres = [1, 1]\nslack = 0.02\n", "linked to itself")
one_line("rows without [dem.blocks] are one mistake", TRIO + "[[wires.along]]\nrows = [1]\nwires = 3\n", "[dem.blocks]")
one_line("rows put back without [dem.blocks] too", TRIO + "[wires.put_back]\nrows = [1]\n", "put_back", "[dem.blocks]")
refused("broken TOML", put("[[wires.link"), "scene.toml:17")

far = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(far, standing_wave(0.05, 1.2, 0.3, 1.0), np.linspace(0.12, 1.0, 20), np.linspace(-0.3, 0.2, 11), 0.0, 0.2, 0.1, 0.02)
refused("flow that does not cover the blocks", GOOD, "does not cover block", arguments=("--flow", far))
short = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(short, standing_wave(0.05, 1.2, 0.3, 1.0), np.linspace(0.0, 1.0, 20), np.linspace(-0.3, 0.2, 11), 0.0, 0.1, 0.1, 0.02)
refused("flow that ends before the time asked for", GOOD, "the flow ends at t = 0.1 s", arguments=("--flow", short))
whole = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(whole, standing_wave(0.05, 1.2, 0.3, 1.0), np.linspace(0.0, 1.0, 20), np.linspace(-0.3, 0.2, 11), 0.0, 0.2, 0.1, 0.02)
refused("flow where all is dry", dem_keys("dry = true"), "scene.toml:6:", "dem.dry", "--flow", arguments=("--flow", whole))
refused("flow and a current", dem_keys("current = [1.0, 0.0, 0.0]"), "scene.toml:6:", "dem.current", "--flow", arguments=("--flow", whole))
late = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(late, standing_wave(0.05, 1.2, 0.3, 1.0), np.linspace(0.0, 1.0, 20), np.linspace(-0.3, 0.2, 11), 0.3, 0.5, 0.1, 0.02)
refused("flow that begins after the time asked for", GOOD, "would start at t = 0.3 s", "time.end = 0.2 s", arguments=("--flow", late))
refused("check of the same", GOOD, "would start at t = 0.3 s", arguments=("--flow", late), verb="check")
for excess in (-0.1, 1.5):
    wet = tempfile.mkdtemp(prefix="tsunagi_flow_")
    write_flow(wet, lambda t, X, Z: (0.0, 0.0, 0.0, 0.0, np.where(X < 0.5, 1.0, 1.0 if t < 0.05 else excess)), np.linspace(0.0, 1.0, 20), np.linspace(-0.3, 0.2, 11), 0.0, 0.2, 0.2, 0.02)
    refused(f"wet fraction of {excess}", GOOD, "window_000000.h5", "/flow/wet", f"{excess}", "0 to 1", arguments=("--flow", wet))
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

moving = run(GOOD + "[[wires.link]]\nblocks = [1, 2]\nspheres = [1, 1]\n")
kept = os.path.join(moving.folder, "state.h5")
refused("another rest length for a wire that is kept", GOOD.replace("end = 0.2", "end = 0.4") + "[[wires.link]]\nblocks = [2, 1]\nspheres = [1, 1]\nrest_length = 0.2\n",
        "rest_length of 0.2 m", "blocks 2 and 1", arguments=("--from", kept))
check.true("no word where none is given", run(GOOD.replace("end = 0.2", "end = 0.4") + "[[wires.link]]\nblocks = [2, 1]\nspheres = [1, 1]\n", "--from", kept).status == 0)

# Whole files whose values cannot be: said before anything runs, not after some steps as if the time step were at fault.
def refused_state(what, name, dataset, place, value, *words):
    folder = os.path.join(tempfile.mkdtemp(prefix="tsunagi_dem_"), "earlier")
    shutil.copytree(moving.folder, folder)
    with h5py.File(os.path.join(folder, name), "r+") as f:
        values = f[dataset][:]
        if place is None:
            unit = f[dataset].attrs["units"]
            del f[dataset]
            f.create_dataset(dataset, data=values[:-1]).attrs["units"] = unit
        else:
            values[place] = value
            f[dataset][...] = values
    refused(f"{name} with {what}", GOOD.replace("end = 0.2", "end = 0.4"), name, *words, arguments=("--from", os.path.join(folder, name)))


refused_state("a place that is no number", "state.h5", "/blocks/position", (0, 0), np.nan, "/blocks/position is not finite at element 0")
refused_state("a speed too few", "state.h5", "/blocks/velocity", None, None, "/blocks/velocity has 3 rows, expected 4")
refused_state("a turn that is none", "state.h5", "/blocks/orientation", 1, 0.0, "/blocks/orientation is no unit quaternion at block 1")
refused_state("a turn that is none", "window_000001.h5", "/blocks/orientation", (-1, 1), 0.0, "/blocks/orientation is no unit quaternion at block 1")
refused_state("a wire to no block", "state.h5", "/wires/ends", (0, 0), 99, "wires name sphere 0 of block 99")
refused_state("a wire to no sphere", "state.h5", "/wires/ends", (0, 1), 96, "wires name sphere 96 of block 0")
refused_state("a contact of no sphere", "window_000001.h5", "/contacts/spheres", (0, 0), 96, "contacts name sphere 96")
refused_state("a negative number of contacts", "state.h5", "/contacts/bodies", (0, 3), -2, "/contacts/bodies names fewer contacts")

# What an earlier run wrote survives a bad second call.
done = run(GOOD)
before = done.windows()
bad = run(put("[[wires.link]]\nblocks = [2, 2]\n"), folder=os.path.dirname(done.folder))
check.true("a refused call leaves earlier results alone", bad.status == 2 and done.windows() == before and len(before) == 2)
check.end()
