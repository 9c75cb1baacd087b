"""Bad input to cmps: one clear line with the key at fault, exit 2, before anything runs; what an earlier run left stays."""
import os
import subprocess

import h5py

from cmps_program import FOLDER, PROGRAM, expect, finish
from cmps_waves import write_waves

GOOD = {
    "time": "end = 4.0\nwindow = 1.0",
    "flume": "bed = [[0.0, -0.4], [40.0, -0.4]]",
    "cmps": "offshore = 25.0\nonshore = 31.0\nparticle_spacing = 0.05",
    "cmps.flow": "x = [29.0, 30.0]\nz = [-0.4, 0.1]",
}


def attempt(name, verb, upstream, **changes):
    sections = dict(GOOD)
    sections.update({key.replace("__", "."): value for key, value in changes.items()})
    text = "".join(f"[{key}]\n{value}\n" for key, value in sections.items() if value is not None)
    path, out = os.path.join(FOLDER, name + ".toml"), os.path.join(FOLDER, name + "_out")
    with open(path, "w") as file:
        file.write(text)
    os.makedirs(out, exist_ok=True)
    earlier = os.path.join(out, "window_000000.h5")
    with open(earlier, "w") as file:
        file.write("an earlier run's window")
    command = [PROGRAM, verb, path] + (["--out", out, "--quiet"] if verb == "run" else []) + (["--waves", upstream] if upstream else [])
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    untouched = os.listdir(out) == ["window_000000.h5"] and open(earlier).read() == "an earlier run's window"
    return done.returncode, done.stderr.strip(), untouched


def folder_of_waves(name, *arguments, **keys):
    path = os.path.join(FOLDER, name)
    write_waves(path, *arguments, **keys)
    return path


waves = folder_of_waves("waves", 0.06, 1.65, 0.4, 24, 34, 4.0, window=1.0)
elsewhere = folder_of_waves("elsewhere", 0.06, 1.65, 0.4, 2, 8, 4.0, window=1.0)
short = folder_of_waves("short", 0.06, 1.65, 0.4, 24, 30, 2.0, window=1.0)
deeper = folder_of_waves("deeper", 0.06, 1.65, 0.5, 24, 30, 4.0, window=1.0)
flat = folder_of_waves("flat", 1e-7, 1.65, 0.4, 24, 30, 4.0, window=1.0)
twice = folder_of_waves("twice", 0.06, 1.65, 0.4, 24, 34, 4.0, window=1.0)  # a place given twice
cut = folder_of_waves("cut", 0.06, 1.65, 0.4, 24, 34, 4.0, window=1.0)  # samples that end before their window
with h5py.File(os.path.join(twice, "window_000000.h5"), "r+") as file:
    file["x"][30] = file["x"][29]
with h5py.File(os.path.join(cut, "window_000000.h5"), "r+") as file:
    file["time"][-1] = 0.99
huge = folder_of_waves("huge", 0.06, 1.65, 0.4, 24, 34, 4.0, window=1.0)  # one value that a sound checksum covers
fast = folder_of_waves("fast", 0.06, 1.65, 0.4, 24, 34, 4.0, window=1.0)
high = folder_of_waves("high", 0.06, 1.65, 0.4, 24, 34, 4.0, window=1.0)
with h5py.File(os.path.join(huge, "window_000001.h5"), "r+") as file:
    file["velocity"][3, 5] = 1e30
with h5py.File(os.path.join(fast, "window_000000.h5"), "r+") as file:
    file["velocity"][...] = 1e9
with h5py.File(os.path.join(high, "window_000000.h5"), "r+") as file:
    file["surface_elevation"][0, 0] = -50.0
backwards = os.path.join(FOLDER, "backwards.csv")
with open(backwards, "w") as file:
    file.write("t,x\n0.0,0.0\n1.0,0.1\n0.5,0.2\n")

nan_inside, piston_through, piston_away = (os.path.join(FOLDER, name) for name in ("nan.csv", "through.csv", "away.csv"))
shaken = os.path.join(FOLDER, "shaken.csv")
fast_piston, far_piston, strong_gravity = (os.path.join(FOLDER, name) for name in ("fast.csv", "far.csv", "strong.csv"))
for path, lines in ((fast_piston, "0.0,0.0\n1e-6,0.1\n1.0,0.1\n"), (far_piston, "0.0,0.0\n1e30,-1e30\n"), (strong_gravity, "0.0,0.0,-9.81\n1.0,1e9,-9.81\n"), (shaken, "0.0,0.0,-9.81\n1.0,0.5,-9.81\n"), (nan_inside, "t,x\n0.0,0.0\nnan,0.1\n1.0,0.2\n"), (piston_through, "0.0,0.0\n2.0,4.5\n"), (piston_away, "0.0,0.5\n2.0,0.5\n")):
    with open(path, "w") as file:
        file.write(lines)

wall = "offshore = 25.0\nonshore = 31.0\nparticle_spacing = 0.05\n"
dry = 'drive = "none"\ntank = [0, 1, 0, 1]\nparticle_spacing = 0.05\n'
no_flow = {"cmps__flow": None}
BLOCK = "[[29.0, -0.4], [29.0, 0.1], [29.4, 0.1], [29.4, -0.4]]"
WALL_AT_29 = f"structure = [{BLOCK}]"
pool = dry + "water = [[[0, 0], [1, 0], [1, 0.4], [0, 0.4]]]\n"
# name, waves, changes, what the line must say
cases = [
    # polygons
    ("crossing", waves, {"cmps": wall + "structure = [[[29.0, -0.4], [30.0, 0.2], [30.0, -0.4], [29.0, 0.2]]]"}, "cmps.structure: polygon 1 crosses itself"),
    ("open", waves, {"cmps": wall + "structure = [[[29.0, -0.4], [30.0, 0.2]]]"}, "at least 3"),
    ("inside", waves, {"cmps": wall + "structure = [[[24.5, -0.4], [30.0, -0.4], [30.0, 0.2]]]"}, "stands in the structure"),
    ("outside", waves, {"cmps": wall + "structure = [[[34.0, -0.4], [35.0, -0.4], [35.0, 0.2]]]"}, "cmps.structure: polygon 1 (x = 34 to 35 m) lies outside the near field, x = 25 to 31 m"),
    ("buried", waves, {"cmps": wall + "structure = [[[29.0, -0.9], [30.0, -0.9], [30.0, -0.6]]]"}, "polygon 1 lies wholly under the bed"),
    ("not_numbers", waves, {"cmps": wall + 'structure = [[["a", 0], [1, 0], [1, 1]]]'}, "cmps.structure"),
    ("double_water", None, {"cmps": dry + "water = [[[0, 0], [0.5, 0], [0.5, 0.5], [0, 0.5]], [[0.3, 0], [0.8, 0], [0.8, 0.5], [0.3, 0.5]]]", **no_flow}, "cmps.water: polygons 1 and 2 overlap"),
    ("water_in_water", None, {"cmps": dry + "water = [[[0, 0], [0.8, 0], [0.8, 0.5], [0, 0.5]], [[0.3, 0.1], [0.5, 0.1], [0.5, 0.3], [0.3, 0.3]]]", **no_flow}, "cmps.water: polygons 1 and 2 overlap"),
    ("hasty", waves, {"cmps": wall + "time_step_factor = 4"}, "cmps.time_step_factor: 4 times cmps.courant = 0.25: water would move by 1 l0 in a step"),
    ("velocities", None, {"cmps": dry + "water = [[[0, 0], [0.5, 0], [0.5, 0.5], [0, 0.5]]]\nwater_velocity = [[1, 0], [2, 0]]", **no_flow}, "cmps.water_velocity: 2 velocities for 1 polygons of cmps.water"),
    ("velocity_of_nothing", waves, {"cmps": wall + "water_velocity = [[1, 0]]"}, "cmps.water_velocity: 1 velocities for 0 polygons of cmps.water"),
    ("spilled", None, {"cmps": dry + "water = [[[0, 0], [1.5, 0], [1.5, 0.5], [0, 0.5]]]", **no_flow}, "cmps.water: polygon 1 (x = 0 to 1.5, z = 0 to 0.5 m) leaves the tank"),
    ("tank_upside_down", None, {"cmps": 'drive = "none"\ntank = [0, 1, 1, 0]', **no_flow}, "x0 < x1 and z0 < z1"),
    ("twice_the_water", None, {"cmps": dry + "water = [[[0, 0], [0.4, 0], [0, 0.4]], [[0, 0], [0.4, 0], [0, 0.4]]]", **no_flow}, "cmps.water: polygons 1 and 2 overlap"),
    ("no_area", None, {"cmps": pool + "structure = [[[0.3, 0.1], [0.7, 0.1], [0.5, 0.1]]]", **no_flow}, "cmps.structure: polygon 1 folds back on itself at its point 2, (0.7, 0.1)"),
    ("folded", None, {"cmps": pool + "structure = [[[0.3, 0.1], [0.7, 0.1], [0.7, 0.3], [0.7, 0.1], [0.5, 0.05]]]", **no_flow}, "folds back on itself at its point 3, (0.7, 0.3)"),
    ("above_tank", None, {"cmps": pool + "structure = [[[0.3, 2], [0.7, 2], [0.7, 3], [0.3, 3]]]", **no_flow}, "polygon 1 (z = 2 to 3 m) lies outside the tank, z = 0 to 1 m"),
    ("thin_plate", None, {"cmps": pool + "structure = [[[0.5, 0], [0.6, 0], [0.6, 0.8], [0.5, 0.8]]]", **no_flow}, "0.1 m thick, thinner than 3 particles of 0.05 m: the pressures of its two sides would mix; a particle_spacing of 0.033 m would do"),
    ("thin_hung_plate", waves, {"cmps": wall + "structure = [[[29.0, -0.2], [30.0, -0.2], [30.0, -0.15], [29.0, -0.15]]]"}, "0.05 m thick"),
    ("narrow_slot", None, {"cmps": pool + "structure = [[[0, 0.2], [0.47, 0.2], [0.47, 0.8], [0, 0.8]], [[0.53, 0.2], [1, 0.2], [1, 0.8], [0.53, 0.8]]]", **no_flow}, "a gap is 0.06 m wide, narrower than 1.5 particles of 0.05 m: close it; a particle_spacing of 0.04 m would do"),
    ("narrow_gate", None, {"cmps": pool + "structure = [[[0.4, 0.02], [0.6, 0.02], [0.6, 0.8], [0.4, 0.8]]]", **no_flow}, "a gap is 0.02 m wide"),
    # resolution and sizes
    ("coarse", waves, {"cmps": "offshore = 25.0\nonshore = 31.0\nparticle_spacing = 0.5"}, "too coarse"),
    ("too_fine", waves, {"cmps": "offshore = 25.0\nonshore = 31.0\nparticle_spacing = 1e-5"}, "makes about 2.4e+10 particles"),
    ("grid_too_fine", waves, {"cmps__flow": "x = [29.0, 30.0]\nz = [-0.4, 0.1]\nspacing = 2e-5"}, "cmps.flow.spacing: the grid has 1.3e+09 points"),
    ("grid_too_often", waves, {"cmps__flow": "x = [29.0, 30.0]\nz = [-0.4, 0.1]\nspacing = 0.02\ninterval = 1e-6"}, "samples in a window"),
    ("grid_too_seldom", waves, {"cmps__flow": "x = [29.0, 30.0]\nz = [-0.4, 0.1]\ninterval = 2.0"}, "cmps.flow.interval: 2 s is longer than time.window = 1 s"),
    ("gauge_too_often", waves, {"gauges": "g = {x = 29.0, interval = 1e-9}"}, "gauges.g.interval: expected a number of at least 1e-06"),
    # places
    ("ends", waves, {"cmps": "offshore = 31.0\nonshore = 25.0\nparticle_spacing = 0.05"}, "shoreward of cmps.offshore"),
    ("beyond_bed", waves, {"cmps": "offshore = 25.0\nonshore = 45.0\nparticle_spacing = 0.05"}, "lies outside the flume's bed"),
    ("on_land", waves, {"flume": "bed = [[0.0, 0.1], [40.0, 0.1]]"}, "there is no water"),
    ("grid", waves, {"cmps__flow": "x = [20.0, 30.0]\nz = [-0.4, 0.1]"}, "leaves the near field"),
    ("grid_backwards", waves, {"cmps__flow": "x = [30.0, 29.0]\nz = [-0.4, 0.1]"}, "x0 < x1"),
    ("zone_too_long", waves, {"cmps": wall + "relaxation_length = 7.0"}, "longer than the near field"),
    ("wall_in_tank", None, {"cmps": pool + "offshore = 0.3", **no_flow}, "cmps.offshore: the tank's wall stands at x = 0 m"),
    ("end_in_tank", None, {"cmps": pool + "onshore = 0.7", **no_flow}, "cmps.onshore: the tank's wall stands at x = 1 m"),
    ("waves_in_tank", waves, {"cmps": 'drive = "waves"\ntank = [24, 30, -0.4, 1]\nparticle_spacing = 0.05', **no_flow}, "cmps.drive: waves come into a flume, not into a tank"),
    ("gauge_in_structure", None, {"cmps": pool + "structure = [[[0.3, 0], [0.7, 0], [0.7, 0.3], [0.3, 0.3]]]", "gauges": 'g = {x = 0.5, z = 0.15, kind = "pressure"}', **no_flow}, "gauges.g: (0.5, 0.15) m lies inside"),
    ("gauge_behind", waves, {"cmps": wall + WALL_AT_29, "gauges": "lee = 30.0"}, "gauges.lee: no water in reach at x = 30 m: water behind the structure, whose rear is at x = 29.4 m, is counted and not simulated"),
    ("velocity_behind", waves, {"cmps": wall + WALL_AT_29, "gauges": 'lee = {x = 30.0, z = -0.1, kind = "velocity"}'}, "gauges.lee: no water in reach at x = 30 m"),
    ("gauge_behind_high_wall", waves, {"cmps": wall + WALL_AT_29.replace("0.1", "1.5"), "gauges": "lee = 30.0"}, "gauges.lee: no water in reach at x = 30 m: water behind the structure, whose rear is at x = 29.4 m, is out of reach"),
    ("surface_in_structure", waves, {"cmps": wall + WALL_AT_29.replace("0.1", "1.5"), "gauges": "inside = 29.2"}, "gauges.inside: no water in reach at x = 29.2 m: bed, structure or walls fill all of it"),
    ("gauge_behind_piston", None, {"cmps": wall + f'drive = "piston"\npiston_file = "{piston_away}"', "gauges": "behind = 25.2"}, "gauges.behind: no water in reach at x = 25.2 m: it stands behind the piston, which goes back to x = 25.5 m only"),
    ("gauge_in_the_sky", waves, {"gauges": 'sky = {x = 28.0, z = 3.0, kind = "pressure"}'}, "gauges.sky: no water in reach at x = 28 m: no water rises above z = 0.8 m"),
    ("gauge_under_bed", waves, {"gauges": 'deep = {x = 28.0, z = -0.6, kind = "velocity"}'}, "gauges.deep: (28, -0.6) m lies inside"),
    ("structure_twice", waves, {"cmps": wall + f"structure = [{BLOCK}, {BLOCK}]"}, "cmps.structure: polygons 1 and 2 are the same: give one"),
    ("structure_twice_from_elsewhere", waves, {"cmps": wall + f"structure = [{BLOCK}, [[29.4, 0.1], [29.4, -0.4], [29.0, -0.4], [29.0, 0.1]]]"}, "cmps.structure: polygon 2 has no face of its own"),
    ("structure_in_structure", waves, {"cmps": wall + f"structure = [[[29.1, -0.4], [29.1, 0.0], [29.3, 0.0], [29.3, -0.4]], {BLOCK}]"}, "cmps.structure: polygon 1 has no face of its own"),
    ("far_away", None, {"flume": "bed = [[2e6, -0.4], [2000040.0, -0.4]]", "cmps": 'drive = "none"\nparticle_spacing = 0.05', **no_flow}, "cmps.onshore: x = 2.00004e+06 m is too far from the origin, at most 1e+06 m"),
    ("two_densities", waves, {"cmps": wall + "density = 1000", "dem": "water_density = 1025"}, "cmps.density: 1000 kg/m3, but dem.water_density = 1025 kg/m3: it is the same water; give one of them"),
    # words and numbers
    ("unknown", waves, {"cmps": wall + "particel_spacing = 0.05"}, "particel_spacing"),
    ("word", waves, {"cmps": wall + 'gradient = "best"'}, "corrected"),
    ("negative", waves, {"cmps": wall + "viscosity = -1.0"}, "cmps.viscosity"),
    ("not_a_number", waves, {"cmps": wall + "courant = nan"}, "cmps.courant"),
    ("start_word", waves, {"cmps": wall + 'start = "late"'}, "cmps.start"),
    ("start_too_late", waves, {"cmps": wall + "start = 9.0"}, "time.end = 4 s lies before the near field starts"),
    ("effect_word", waves, {"effects": 'turbulence = "maybe"'}, "effects.turbulence"),
    # tables
    ("no_piston", None, {"cmps": wall + 'drive = "piston"'}, "piston_file"),
    ("absent_piston", None, {"cmps": wall + 'drive = "piston"\npiston_file = "nothing.csv"'}, "nothing.csv"),
    ("backward_piston", None, {"cmps": wall + f'drive = "piston"\npiston_file = "{backwards}"'}, "backwards.csv"),
    ("nan_piston", None, {"cmps": wall + f'drive = "piston"\npiston_file = "{nan_inside}"'}, "nan.csv:3: expected 2 numbers"),
    ("idle_piston", None, {"cmps": pool + f'piston_file = "{backwards}"', **no_flow}, "backwards.csv"),
    ("piston_for_nothing", None, {"cmps": pool + f'piston_file = "{piston_away}"', **no_flow}, "cmps.piston_file: nothing moves by it"),
    ("piston_into_structure", None, {"cmps": wall + f'drive = "piston"\npiston_file = "{piston_through}"\nstructure = [[[29.0, -0.4], [30.0, -0.4], [30.0, 0.2]]]'}, "cmps.piston_file: the moving wall at x = 29.5 m stands in the structure"),
    ("water_behind_piston", None, {"cmps": wall + f'drive = "piston"\npiston_file = "{piston_away}"\nwater = [[[25, -0.4], [31, -0.4], [31, 0], [25, 0]]]'}, "stands behind the piston, which starts at x = 25.5 m"),
    ("fast_piston", None, {"cmps": wall + f'drive = "piston"\npiston_file = "{fast_piston}"'}, "fast.csv: the wall moves at 100000 m/s between two rows; at most 19.8"),
    ("far_piston", None, {"cmps": wall + f'drive = "piston"\npiston_file = "{far_piston}"'}, "far.csv: the wall goes back by 1e+30 m, more than ten times the near field's length"),
    ("strong_gravity", None, {"cmps": pool + f'gravity_file = "{strong_gravity}"', **no_flow}, "strong.csv: 1e+09 m/s2 in column 2; at most 10000"),
    ("strong_constant_gravity", None, {"cmps": pool + "gravity = [0, -1e30]", **no_flow}, "cmps.gravity"),
    ("thrown", None, {"cmps": pool + "water_velocity = [[1e30, 0]]", **no_flow}, "cmps.water_velocity: [1e+30, 0] m/s; at most 10000"),
    ("dense", waves, {"cmps": wall + "density = 1e308"}, "cmps.density"),
    ("thick", waves, {"cmps": wall + "viscosity = 1e308"}, "cmps.viscosity"),
    ("two_gravities", None, {"cmps": pool + f'gravity = [0, -9.81]\ngravity_file = "{shaken}"', **no_flow}, "cmps.gravity: cmps.gravity_file says it too"),
    ("low_water", waves, {"cmps": wall + "water = [[[25, -0.4], [31, -0.4], [31, -0.15], [25, -0.15]]]"}, "cmps.water: at the moving wall, x = 25 m, it must reach from the bed up to z = 0"),
    ("water_off_the_wall", waves, {"cmps": wall + "water = [[[25.5, -0.4], [31, -0.4], [31, 0], [25.5, 0]]]"}, "cmps.water: at the moving wall, x = 25 m"),
    ("falls_up", None, {"cmps": wall + 'drive = "none"\ngravity = [0, 9.81]'}, "cmps.gravity: z is up"),
    ("gravity_of_no_waves", waves, {"cmps": wall + "gravity = [0, -1.62]"}, "cmps.gravity: [0, -1.62] is not that of the waves that come in"),
    ("wall_of_nothing", waves, {"cmps": wall + 'boundary = "paper"\ncrest_lowering = 0.5'}, "cmps.crest_lowering: 0.5 m leaves nothing of the wall in water 0.4 m deep"),
    ("pictures_too_often", waves, {"cmps": wall + "particles_interval = 1e-6"}, "cmps.particles_interval: 1e-06 s: some 960 particles and 1e+06 pictures in a window"),
    # waves
    ("elsewhere", elsewhere, {}, "cover x"),
    ("short", short, {}, "end at t = 2"),
    ("deeper", deeper, {}, "/still_water_depth is 0.5 m at x = 24.35 m, where flume.bed of the scene leaves 0.4 m"),
    ("twice", twice, {}, "twice/window_000000.h5: dataset /x does not increase"),
    ("cut", cut, {}, "cut/window_000000.h5: dataset /time does not reach from t_begin = 0 s to t_end = 1 s"),
    ("huge", huge, {}, "huge/window_000001.h5: dataset /velocity is 1e+30 m/s at element 608: no waves in water 0.4 m deep exceed 9.9"),
    ("fast", fast, {}, "fast/window_000000.h5: dataset /velocity is 1e+09 m/s at element 0"),
    ("high", high, {}, "high/window_000000.h5: dataset /surface_elevation is -50 m at element 0: no waves in water 0.4 m deep exceed 2"),
    ("flat", flat, {}, "the waves never reach cmps.offshore"),
    ("nowhere", os.path.join(FOLDER, "nothing"), {}, "no such folder"),
    ("no_waves", None, {}, "--waves DIR is needed"),
    ("lower_than_a_particle", waves, {"waves": 'kind = "regular"\nheight = 0.02\nperiod = 1.65'}, "waves.height: 0.02 m is 0.4 particles of cmps.particle_spacing = 0.05 m: the near field cannot tell waves lower than 0.5"),
    ("never_arrives", waves, {"cmps": wall + "arrival_threshold = 0.1", "waves": 'kind = "regular"\nheight = 0.06\nperiod = 1.65'}, "cmps.arrival_threshold: 0.1 m is more than waves.height = 0.06 m: the waves would never arrive"),
    ("wave_height", waves, {"waves": 'kind = "regular"\nheight = "tall"\nperiod = 1.65'}, "waves.height"),
    ("wave_period", waves, {"waves": 'kind = "regular"\nheight = 0.06\nperiod = -1'}, "waves.period"),
    ("wave_kind", waves, {"waves": 'kind = "regluar"\nheight = 0.06\nperiod = 1.65'}, "waves.kind"),
]
for name, folder, changes, phrase in cases:
    status, message, untouched = attempt(name, "run", folder, **changes)
    told = message.replace(FOLDER + os.sep, "")
    expect(status == 2 and phrase in message and len(message.splitlines()) == 1, f"{name}: exit {status}: {told}")
    expect(untouched, f"{name}: the earlier run's files are as they were")
    if name != "no_waves":  # check needs no waves
        seen, said, _ = attempt(name, "check", folder, **changes)
        expect(seen == 2 and said == message, f"{name}: check says the same" if said == message else f"{name}: check, exit {seen}: {said}")
finish()
