"""Perturbed first states: seed 0 changes nothing, a seed says all, and members of an ensemble start within rounding of each other."""
import h5py
import numpy as np

import perturbations
from harness import *

perturbations.FIRST = 0  # every seed here is chosen

COLUMN = """
[time]
end = 0.5
window = 0.25
[cmps]
drive = "none"
tank = [0, 0.8, 0, 0.5]
water = [[[0, 0], [0.3, 0], [0.3, 0.3], [0, 0.3]]]
particle_spacing = 0.02
particles_interval = 0.05
"""
WAVES = """
[time]
end = 6.0
window = 2.0
[flume]
bed = [[0, -0.4], [16, -0.4], [24, 0.1]]
[waves]
kind = "regular"
height = 0.1
period = 1.65
[boussinesq]
spacing = 0.05
"""
LAKE = """
[time]
end = 2.0
window = 1.0
[flume]
bed = [[0, -0.4], [4, -0.4], [8, 0.3]]
[waves]
kind = "none"
"""


def member(folder, program, text, seed=None):
    out = folder / f"{program}_{seed}"
    options = [] if seed is None else ["--set", f"perturbation={seed}"]
    run(program, "run", write_scene(folder, text, f"{program}.toml"), "--out", out, "--quiet", *options).expect_done()
    return out


@test
def particles(folder):
    plain, zero, first, again, second = (member(folder, "cmps", COLUMN, seed) for seed in (None, 0, 1, "1 ", 2))
    check_same_bytes(plain, zero)
    check_same_bytes(first, again)
    places = [run_folder.read_series(out, "/particles/position")[1] for out in (plain, first, second)]
    for other in (places[1], places[2]):
        check_below("first positions apart", abs(other[0] - places[0][0]).max(), 2e-8, "m", "single precision at 0.3 m: 3e-8")
    for a, b in ((0, 1), (0, 2), (1, 2)):
        apart = np.sqrt(np.mean((places[a][-1] - places[b][-1]) ** 2))
        check(apart > 0.001, f"members {a} and {b} are {apart:.2g} m rms apart at the end: they should have parted by a twentieth of l0 and more")


def state(out, name):
    with h5py.File(out / "state.h5") as file:
        return file[name][:]


@test
def waves(folder):
    plain, zero, first, again, second = (member(folder, "boussinesq", WAVES, seed) for seed in (None, 0, 1, "1 ", 2))
    check_same_bytes(plain, zero)
    check_same_bytes(first, again)
    depth = [state(out, "depth") for out in (plain, first, second)]
    for a, b in ((0, 1), (0, 2), (1, 2)):
        check((depth[a] != depth[b]).any(), f"members {a} and {b} are the same")
    check_below("depths apart after four periods", abs(depth[1] - depth[0]).max(), 1e-9, "m", "waves on a beach are not chaotic: rounding stays rounding")


@test
def lake_at_rest(folder):
    for seed in (0, 5):
        still = member(folder, "boussinesq", LAKE, seed)
        check_below(f"largest discharge, seed {seed}", abs(state(still, "discharge")).max(), 1e-14, "m2/s", "round-off of a 0.4 m deep lake")


main()
