"""A scene that lies hundreds of kilometres from the origin, as in the coordinates of a country: what it writes is what the same
scene writes at the origin, so far on."""
import numpy as np

from harness import *

FAR = 350_000.0  # m
SPACING = 0.02


def scene(origin):
    def at(x):
        return repr(origin + x)

    return f"""
[time]
end = 0.1
window = 0.05
[flume]
bed = [[{at(0)}, -0.4], [{at(3)}, -0.4]]
[gauges]
"before" = {at(1.4)}
[cmps]
drive = "none"
offshore = {at(0.5)}
onshore = {at(2.5)}
particle_spacing = {SPACING}
particles_interval = 0.05
water = [[[{at(0.5)}, -0.4], [{at(1.0)}, -0.4], [{at(1.0)}, 0.0], [{at(0.5)}, 0.0]], [[{at(1.0)}, -0.4], [{at(1.7)}, -0.4], [{at(1.7)}, -0.2], [{at(1.0)}, -0.2]]]
structure = [[[{at(1.7)}, -0.4], [{at(1.7)}, 0.1], [{at(1.9)}, 0.1], [{at(1.9)}, -0.4]]]
[cmps.flow]
x = [{at(1.0)}, {at(1.6)}]
z = [-0.4, 0.0]
interval = 0.05
"""


def left_by(folder, origin):
    out = folder / f"from_{origin:g}"
    run("cmps", "run", write_scene(folder, scene(origin), f"{origin:g}.toml"), "--out", out, "--quiet").expect_done()
    return out


@test
def same_pictures(folder):
    here, there = left_by(folder, 0.0), left_by(folder, FAR)
    _, near = run_folder.read_series(here, "/particles/position")
    _, far = run_folder.read_series(there, "/particles/position")
    check(near.shape == far.shape, f"{near.shape} and {far.shape}: as many particles in as many pictures")
    apart = np.abs(far - [FAR, 0.0] - near).max(axis=(1, 2)) / SPACING
    # places there are rounded to 6e-11 m, 3e-9 spacings; what that grows to while the water settles and falls is left room for
    check_below("farthest apart in any picture", apart.max(), 1e-4, "l0", "single precision would make 0.8")
    (_, level), (_, far_level) = run_folder.gauge(here, "before"), run_folder.gauge(there, "before")
    check_below("levels at the gauge apart", np.abs(level - far_level).max(), 1e-3 * SPACING, "m")


main()
