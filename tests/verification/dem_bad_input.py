"""Bad input gets one clear line with file, line and key, exit 2, before anything runs; nothing written is lost."""
import os
import tempfile

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


def refused(what, text, *words, arguments=()):
    r = run(text, *arguments)
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
refused("negative friction", put("", "width = 0.1", "width = 0.1\nfriction = -1.0"), "dem.friction")
refused("mound whose x does not increase", put("", "[[0.0, -0.2], [0.2, -0.2]]", "[[0.2, -0.2], [0.0, -0.2]]"), "dem.mound.profile")
refused("no blocks", "[time]\nend = 1.0\n[dem]\ndry = true\n", "no blocks")
refused("blocks inside each other", GOOD.split("[dem.blocks]")[0] +
        '[[dem.block]]\nshape = "cube27"\nposition = [0.0, 0.05, 0.0]\n[[dem.block]]\nshape = "cube27"\nposition = [0.01, 0.05, 0.0]\n', "starts", "deep in block", "position")
refused("block inside the mound", put('[[dem.block]]\nshape = "sphere"\nposition = [0.05, 0.05, -0.25]\n'), "starts inside the mound", "position")
refused("effect that cannot be on", put('[effects]\nwires = "on"\n'), "effects.wires", "no links")

far = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(far, standing_wave(0.05, 1.2, 0.3, 1.0), np.linspace(0.12, 1.0, 20), np.linspace(-0.3, 0.2, 11), 0.0, 0.2, 0.1, 0.02)
refused("flow that does not cover the blocks", GOOD, "does not cover block", arguments=("--flow", far))
short = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(short, standing_wave(0.05, 1.2, 0.3, 1.0), np.linspace(0.0, 1.0, 20), np.linspace(-0.3, 0.2, 11), 0.0, 0.1, 0.1, 0.02)
refused("flow that ends before the time asked for", GOOD, "the flow ends at t = 0.1 s", arguments=("--flow", short))
refused("flow folder that is not there", GOOD, "no such folder", arguments=("--flow", "/nonexistent"))

packed = run(GOOD, verb="pack")
check.true("packing for the state tests", packed.status == 0, packed.message)
state = os.path.join(packed.folder, "state.h5")
refused("state of another scene", put("", "roughness = 0.004", "roughness = 0.004\nseed = 2"), "state of another scene", arguments=("--from", state))
with open(state, "rb") as f:
    content = f.read()
with open(state + ".cut", "wb") as f:
    f.write(content[: len(content) // 2])
refused("truncated state", GOOD, "state.h5.cut", arguments=("--from", state + ".cut"))

# What an earlier run wrote survives a bad second call.
done = run(GOOD)
before = done.windows()
bad = run(put("[[wires.link]]\nblocks = [2, 2]\n"), folder=os.path.dirname(done.folder))
check.true("a refused call leaves earlier results alone", bad.status == 2 and done.windows() == before and len(before) == 2)
check.end()
