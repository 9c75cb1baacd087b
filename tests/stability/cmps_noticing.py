"""What a run notices, what it must not take for a fault, and what it says before it starts."""
import os
import re
import subprocess

import h5py
import numpy as np

from cmps_program import FOLDER, PROGRAM, Run, expect, finish, members
from cmps_waves import write_waves, write_window

RHO, G = 1000.0, 9.81


def tank(end, box, water, spacing, more="", head=""):
    return f"[time]\nend = {end}\nwindow = 1.0\n{head}\n[cmps]\ndrive = \"none\"\ntank = {box}\nwater = {water}\nparticle_spacing = {spacing}\n{more}\n"


def rectangle(x0, x1, z0, z1):
    return f"[[[{x0}, {z0}], [{x1}, {z0}], [{x1}, {z1}], [{x0}, {z1}]]]"


# a block that falls from 10 m is no fault, and its steps are foretold
run = Run("fall", tank(1.35, [0, 0.5, 0, 11], rectangle(0.2, 0.3, 10, 10.1), 0.02, head='[gauges]\np = {x = 0.25, z = 10.05, kind = "pressure"}'))
expect(run.status == 0, f"falling block: exit {run.status} {run.messages.strip()}")
told = subprocess.run([PROGRAM, "check", run.path], capture_output=True, text=True).stdout
steps = float(re.search(r"steps +about (\d+)", told)[1])
expect(abs(steps / run.figure("steps") - 1) < 0.1, f"falling block: {steps:.0f} steps told, {run.figure('steps'):.0f} taken (bound 10 %: its speed is known)")
_, pressure = run.gauge("p", "pressure")
expect(pressure[0] < 0.02 * RHO * G * 0.1, f"falling block: first pressure {pressure[0]:.1f} Pa, truth 0 (bound 2 % of what it would be at rest)")

# a full box: its pressure is known up to a constant, which does not wander
head = '[gauges]\nfloor = {x = 0.25, z = 0.0, kind = "pressure"}\nlid = {x = 0.25, z = 0.3, kind = "pressure"}'
run = Run("full_long", tank(10, [0, 0.5, 0, 0.3], rectangle(0, 0.5, 0, 0.3), 0.02, head=head))
expect(run.status == 0 and not run.messages.strip(), f"full box: exit {run.status} {run.messages.strip()}")
_, floor = run.gauge("floor", "pressure")
_, lid = run.gauge("lid", "pressure")
weight = RHO * G * 0.3
expect(abs((floor - lid).mean() / weight - 1) < 0.03, f"full box: floor less lid {(floor - lid).mean() / weight:.3f} rho g h (bound 3 %)")
expect(lid.mean() < 0.3 * weight and lid.max() < 5 * weight, f"full box: lid {lid.mean() / weight:.2f} rho g h in the mean, {lid.max() / weight:.2f} at most, lowest pressure zero (bounds 0.3, 5: it once wandered to hundreds)")

# a viscosity that is given acts, and its steps bear it
for viscosity in (0.1, 0.3):
    run = Run(f"thick{viscosity}", tank(0.5, [0, 0.6, 0, 0.6], rectangle(0, 0.3, 0, 0.3), 0.02, f"viscosity = {viscosity}"))
    gain = run.invariant("largest_energy_gain")
    expect(run.status == 0 and gain < 0.01, f"viscosity {viscosity} m2/s: exit {run.status}, energy gain {gain:.4f} (bound 0.01) {run.messages.strip()}")
    viscous = [effect for effect in run.record["effects"] if (effect if isinstance(effect, str) else effect["name"]) == "viscosity"] if isinstance(run.record["effects"], list) else [run.record["effects"]["viscosity"]]
    expect("True" in str(viscous) or "'on'" in str(viscous), f"viscosity {viscosity} m2/s: the effect is on: {viscous}")

# Every bound by which a run judges itself, broken by a scene (but that on solves that do not converge: none could be found that
# do not), by a factor of two and more in every member of an ensemble: scenes that break at a blow, for what grows slowly is met
# just above its bound by the next look.
def windows_of(height, folder):
    """A surge of so many depths, that goes on."""
    os.makedirs(folder, exist_ok=True)
    x = np.arange(0, 3.01, 0.05)
    for index in range(6):
        t = np.linspace(0.5 * index, 0.5 * (index + 1), 21)
        eta = height * 0.4 * np.interp(t, [0.1, 0.5], [0, 1])[:, None] * np.ones_like(x)
        write_window(folder, index, t[0], t[-1], t, x, np.full_like(x, 0.4), eta, eta * np.sqrt(G * (0.4 + eta)) / (0.4 + eta))
    with open(os.path.join(folder, "run.json"), "w") as file:
        file.write('{"stage": "boussinesq", "status": "done", "windows": 6}')
    return folder


def table(name, text):
    path = os.path.join(FOLDER, name)
    with open(path, "w") as file:
        file.write(text)
    return path


def flume(drive, depth=0.3, x=(-2.0, 4.0), more=""):
    return f"[time]\nend = 3.0\nwindow = 0.25\n[flume]\nbed = [[{x[0]}, {-depth}], [{x[1]}, {-depth}]]\n[cmps]\ndrive = \"{drive}\"\n{more}\n"


# a block that falls half a metre, in a tank so high that no speed is too high: with next to no kernel its fall on the floor bursts
def falling(more="", height=20, fall=0.5, window=0.21):
    return tank(2, [0, 0.4, 0, height], rectangle(0, 0.4, fall, fall + 0.2), 0.02, more).replace("window = 1.0", f"window = {window}")


gravity_table = table("gravity.csv", "t, gx, gz\n0, 0, -9.81\n10, 0, -9.81\n")
from_none = table("from_none.csv", "t, gx, gz\n0, 0, 0\n1.5, 0, 0\n1.501, 0, -9.81\n10, 0, -9.81\n")
blow = table("blow.csv", "t, gx, gz\n0, 0, -9.81\n0.3, 0, -9.81\n0.3001, 0, 6000\n0.31, 0, 6000\n0.3101, 0, -9.81\n10, 0, -9.81\n")
piston_table = table("piston.csv", "t, x\n" + "".join(f"{t:.2f}, {1e-4 * np.sin(2 * np.pi * t / 3.2):.9f}\n" for t in np.arange(0, 6, 0.02)))
bursts = ["cmps.kernel_radius=1.6", "cmps.stabilisation=0", "cmps.shifting=0"]
near_field = "offshore = 1.0\nonshore = 3.0\nstart = 0.0\nparticle_spacing = 0.04"
for name, scene, sets, waves, said in (
        # weightless at first; then next to nothing keeps its particles apart
        ("volume", f'[time]\nend = 3.0\nwindow = 1.5\n[cmps]\ndrive = "none"\ntank = [0, 1, -0.5, 20]\nparticle_spacing = 0.02\ngravity_file = "{from_none}"\n', ["cmps.stabilisation=0.2", "cmps.shifting=0", "cmps.time_step_factor=3"], None, r"the water's volume is off by -(\d+) %, bound (\d+) %"),
        ("energy of closed water", falling(), bursts, None, r"gained ([\d.]+) of rho g h / 2, bound ([\d.]+), and nothing does work on it"),
        ("energy beyond a table's work", falling(f'gravity_file = "{gravity_table}"'), bursts, None, r"gained ([\d.]+) of rho g h / 2, bound ([\d.]+), beyond the work of -?\d+\.\d+ done on it"),
        ("energy beyond a piston's work", falling().replace('drive = "none"', f'drive = "piston"\npiston_file = "{piston_table}"'), bursts, None, r"gained ([\d.]+) of rho g h / 2, bound ([\d.]+), beyond the work of -?\d+\.\d+ done on it"),
        ("energy of waves", flume("waves", 0.4, (0.0, 4.0), near_field), [], windows_of(3.0, os.path.join(FOLDER, "surge")), r"gained ([\d.]+) of rho g h / 2, bound ([\d.]+), more than waves can bring"),
        # water that is set in motion has no bound of energy
        ("put back", falling("water_velocity = [[0, -0.001]]", height=0.9, fall=0.7, window=0.25), ["cmps.source=density", "cmps.time_step_factor=3"], None, r"put back out of the solid (\d+) times in \d+ steps of \d+ particles, bound (\d+)"),
        # a blow from below, of 6000 m/s2 for a hundredth of a second: 60 m/s
        ("speed", flume("none", more=f'offshore = 0.0\nonshore = 0.4\nparticle_spacing = 0.02\ngravity_file = "{blow}"'), [], None, r"moves at ([\d.]+) m/s, limit ([\d.]+)")):
    over = []
    for member in members(3):
        run = Run(f"{name.replace(' ', '_')}_{member}", scene, waves=waves, sets=sets, perturbation=member)
        last = run.messages.strip().splitlines()[-1] if run.messages.strip() else ""
        met = re.search(r"unstable at t = [\d.]+ s.*" + said, last)
        over.append(float(met[1]) / float(met[2]) if met else 0.0)
        whole = [path for path in run.windows() if h5py.File(path).attrs["t_end"] > 0]
        expect(run.status == 1 and met and run.record.get("status") == "failed" and len(whole) > 0,
               f"{name}, member {member}: exit {run.status}, run.json says {run.record.get('status')}, {len(whole)} good windows on disk, {last}")
    expect(min(over) > 2, f"{name}: over its bound by factors of {', '.join(f'{factor:.3g}' for factor in over)} (2 and more)")

# said before anything runs
for name, scene, text in (
        ("no water", tank(1, [0, 1, 0, 1], rectangle(0.5, 0.5001, 0.1, 0.4), 0.02), "no water at all"),
        ("gauge beside the tank", tank(1, [0, 1, 0, 1], rectangle(0, 1, 0, 0.4), 0.02, head="[gauges]\naside = 5.0"), "gauges.aside"),
        ("gauge above the tank", tank(1, [0, 1, 0, 1], rectangle(0, 1, 0, 0.4), 0.02, head='[gauges]\nhigh = {x = 0.5, z = 7.0, kind = "pressure"}'), "gauges.high")):
    run = Run(name.replace(" ", "_"), scene)
    expect(run.status == 2 and text in run.messages and not run.windows(), f"{name}: exit {run.status}, {run.messages.strip()}")
run = Run("no_waves", tank(0.1, [0, 0.6, 0, 0.6], rectangle(0, 0.6, 0, 0.3), 0.05, '[effects]\nwall_overflow = "on"\nabsorption = "on"'))
listed = subprocess.run([PROGRAM, "check", run.path], capture_output=True, text=True).stdout
expect(len(re.findall(r"(?:wall_overflow|absorption) +off +not driven by waves", listed)) == 2, "effects of waves are off where none come, whatever was wished")
# waves that come too late: a guess without the waves, a refusal with them
late = flume("waves", 0.4, (0.0, 60.0), "offshore = 40.0\nonshore = 43.0\nparticle_spacing = 0.05")
path = table("late.toml", late)
done = subprocess.run([PROGRAM, "check", path], capture_output=True, text=True)
expect(done.returncode == 0 and re.search(r"time +nothing to simulate: waves reach cmps.offshore = 40 m at about 20\.2 s, after time.end = 3 s", done.stdout) and "steps" not in done.stdout and "run time" not in done.stdout,
       f"waves after the end: exit {done.returncode}, " + " ".join(line.strip() for line in done.stdout.splitlines() if line.startswith("  time")))  # 40 m at sqrt(9.81 0.4) m/s
done = subprocess.run([PROGRAM, "check", path, "--set", "time.end=25"], capture_output=True, text=True)
expect(re.search(r"time +from about 20\.2 s to 25 s", done.stdout) and "steps" in done.stdout, "waves before the end: from about 20.2 s, with steps and run time")
write_waves(os.path.join(FOLDER, "late_waves"), 0.05, 1.65, 0.4, 38, 44, 6, window=1.0, arrival=4.0)
done = subprocess.run([PROGRAM, "check", path, "--waves", os.path.join(FOLDER, "late_waves")], capture_output=True, text=True)
expect(done.returncode == 2 and "time.end = 3 s lies before the near field starts" in done.stderr, f"waves after the end, known: exit {done.returncode}, {done.stderr.strip()}")
finish()
