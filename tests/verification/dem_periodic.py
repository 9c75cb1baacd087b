"""Periodic sides: blocks that cross them again and again behave as anywhere else, to the bit where the run is taken up again, and so do wires."""
import os
import signal
import subprocess
import tempfile
import time

import numpy as np

from dem_program import DEM, Checks, perturbed, run

check = Checks()
WIDTH = 0.2
# A current along the breakwater drives two rows round and round; the blocks of row 1 are a ring, linked across the sides.
SCENE = """
[time]
end = END
window = 0.1
[dem]
width = 0.2
sides = "periodic"
friction = 0.2
current = [0.0, 1.2, 0.0]
skin = 0.15
[dem.blocks]
shape = "beehive96"
rows = 2
columns = 4
origin = [0.15, ORIGIN]
pitch = [0.052, 0.05]
[dem.mound]
profile = [[0.0, -0.2], [0.3, -0.2]]
roughness = 0.002
y = [BEGIN, FINISH]
[wires]
psi = 100.0
[[wires.along]]
rows = [1]
[[wires.link]]
blocks = [4, 1]
"""


def scene(end=1.6, shift=0.0):
    for word, value in (("END", end), ("ORIGIN", 0.025 + shift), ("BEGIN", shift), ("FINISH", shift + WIDTH)):
        text = (text if word != "END" else SCENE).replace(word, repr(value))
    return text


whole = run(scene())
check.true("runs", whole.status == 0, whole.message)
y = whole.series("/blocks/position")[:, :, 1]
crossings = np.abs(np.diff(np.floor(y / WIDTH), axis=0)).sum(axis=0)
check.true("each row crosses the side several times", bool(crossings[:4].min() >= 2 and crossings[4:].min() >= 2), f"{crossings.astype(int)}")
tension = whole.series("/wires/tension")
check.true("wires across the side pull", bool(tension[1:, -18:].max() > 0), f"up to {tension[:, -18:].max():.3g} N")

two = run(scene(), "--threads", "2")
check.true("two threads write the same bytes as one", two.windows() == whole.windows(), two.message)
for skin in (0.02, 0.6):
    other = run(scene().replace("skin = 0.15", f"skin = {skin}"))
    same = all(np.array_equal(other.series(name), whole.series(name)) for name in ("/blocks/position", "/blocks/velocity", "/energy", "/wires/tension"))
    check.true(f"the same bits with dem.skin = {skin}", same, other.message)

# Killed without warning time after time, each time after a few more windows.
base = tempfile.mkdtemp(prefix="tsunagi_dem_")
out, path = os.path.join(base, "out"), os.path.join(base, "scene.toml")
with open(path, "w") as f:
    f.write(scene())
kills = 0
for last in (2, 6, 10):
    process = subprocess.Popen([DEM, "run", path, "--out", out, "--quiet", "--resume", *perturbed()])
    while not os.path.exists(os.path.join(out, f"window_{last:06d}.h5")) and process.poll() is None:
        time.sleep(0.002)
    kills += process.poll() is None
    process.send_signal(signal.SIGKILL)
    process.wait()
resumed = run(scene(), "--resume", folder=base)
check.true("killed again and again while it ran", kills >= 2, f"{kills} of 3 times")
check.true("and resumed: same bytes", resumed.windows() == whole.windows(), resumed.message)

# The side is nowhere in particular: the whole scene moved along by a third of the width. Rounding differs and contacts amplify it, as they do
# when the last bit of the friction changes.
END = 0.5


def off(text, shift=0.0):
    """Farthest that any block is from where it is in the scene as it stands, at every sample (m)."""
    return np.abs(run(text).series("/blocks/position") - [0, shift, 0] - here.series("/blocks/position")).max(axis=(1, 2))


here = run(scene(END))
y = here.series("/blocks/position")[:, :, 1]
check.true("until then blocks have crossed the side", bool(np.abs(np.diff(np.floor(y / WIDTH), axis=0)).sum() >= 4))
rounding = np.maximum(off(scene(END).replace("friction = 0.2", "friction = 0.20000000000000004")), off(scene(END).replace("friction = 0.2", "friction = 0.19999999999999996")))
for share in (1 / 3, -5 / 3):
    moved = off(scene(END, share * WIDTH), share * WIDTH)
    check.below(f"moved by {share:+.2f} widths: difference at 0.1 s", moved[2], 1e-13, "m")  # 1000 times the rounding of a position
    check.below(f"moved by {share:+.2f} widths: over what a last bit of the friction does, at any time", (moved / rounding)[1:].max(), 100, "")  # measured: 8

# Two spheres joined across the side swing as two in the middle of the box do, and the wire breaks at the same stretch.
PAIR = """
[time]
end = 0.2
window = 0.05
[dem]
dry = true
gravity = [0.0, 0.0, 0.0]
width = 0.2
sides = "periodic"
time_step = 2.0e-5
output_interval = 0.01
[[dem.block]]
shape = "sphere"
position = [0.0, FIRST, 0.0]
velocity = [0.02, 0.0, 0.0]
[[dem.block]]
shape = "sphere"
position = [0.0, SECOND, 0.001]
velocity = [0.0, SPEED, 0.0]
[wires]
psi = PSI
stiffness = 20.0
[[wires.link]]
blocks = [1, 2]
"""


def pair(first, second, psi, speed=0.06):
    text = PAIR
    for word, value in (("FIRST", first), ("SECOND", second), ("PSI", psi), ("SPEED", speed)):
        text = text.replace(word, repr(value))
    return run(text)


for psi, what in ((1.0, "swings"), (0.02, "breaks")):
    middle, across, back = pair(0.09, 0.11, psi), pair(0.19, 0.01, psi), pair(0.01, 0.19, psi, -0.06)
    check.true(f"a wire that {what}", middle.figure("wires.broken") == (psi < 0.1) and middle.figure("wires.largest_tension") > 0)
    for name in ("/blocks/velocity", "/wires/tension"):
        check.below(f"{what}, across the side: {name}", np.abs(across.series(name) - middle.series(name)).max(), 1e-12)  # rounding, some turns of it
    check.true(f"{what}: broken alike", np.array_equal(across.series("/wires/intact"), middle.series("/wires/intact")))
    check.below(f"{what}, the other way round: largest tension", abs(back.figure("wires.largest_tension") - middle.figure("wires.largest_tension")), 1e-12, "N")
check.end()
