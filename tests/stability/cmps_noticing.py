"""What a run notices, what it must not take for a fault, and what it says before it starts."""
import re
import subprocess

from cmps_program import PROGRAM, Run, expect, finish

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
finish()
