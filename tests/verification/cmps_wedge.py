"""Impact pressure against published figures: a wedge that enters calm water at constant speed, without gravity.

The flow is self-similar, and its pressure is known: Dobrovol'skaya's (1969) solution as computed by Zhao & Faltinsen (1993, table 1):
at a deadrise angle of 40 degrees the largest pressure coefficient p / (rho V^2 / 2) on the wedge is 3.266, and the force on both
faces is 5.477 rho V^3 t; at 30 degrees 6.927 and 14.139. Here the wedge stands still and the water rises (cmps.water_velocity): half
of it beside a wall that is the plane of symmetry, as a quarter of a disc whose free rim is six times as far as the water's
undisturbed edge on the wedge; a rim that near takes about (1/6)^2 off the force. Resolution is told by the depth of penetration at
the end over l0. Figures are means over the last half of the way, and over lattices.
"""
import numpy as np

from cmps_program import Run, expect, finish

SPEED, DURATION, EXTENT = 0.1, 1.0, 6.0
DEEPEST = SPEED * DURATION
AVERAGE = 0.02  # s, of readings: the flow grows by 2 to 4 % in it; as long as the forces' interval, so that every step counts
EXACT = {30: (6.927, 14.139), 40: (3.266, 5.477)}


def scene(angle, spacing):
    slope = np.tan(np.radians(angle))
    edge = 0.5 * np.pi * DEEPEST / slope  # Wagner's wetted half width
    rim = ", ".join(f"[{EXTENT * edge * np.cos(a):.6f}, {-EXTENT * edge * np.sin(a):.6f}]" for a in np.linspace(0, 0.5 * np.pi, 60))
    places = np.linspace(0.03, 1.2, 50) * edge
    gauges = "\n".join(f'p{i} = {{x = {x:.6f}, z = {x * slope:.6f}, kind = "pressure", interval = 0.01}}' for i, x in enumerate(places))
    return places, f"""
title = "wedge entry at {angle} degrees"
[time]
end = {DURATION}
window = {DURATION}
[gauges]
{gauges}
[cmps]
drive = "none"
tank = [0, {2 * EXTENT * edge:.6f}, {-1.5 * EXTENT * edge:.6f}, {4 * edge:.6f}]
structure = [[[0, 0], [{3 * edge:.6f}, {3 * edge * slope:.6f}], [0, {3 * edge * slope:.6f}]]]
water = [[[0, 0], {rim}]]
water_velocity = [[0, {SPEED}]]
gravity = [0, 0]
particle_spacing = {spacing}
pressure_average = {AVERAGE}
particles_interval = {DURATION}
"""


def similar(angle, over_depth, lattices):
    """Force coefficient, and the profile of the pressure coefficient over z/(V t) from the undisturbed surface, each over lattices."""
    slope = np.tan(np.radians(angle))
    bins = np.arange(-1.0, 0.9, 0.05)
    forces, sums, counts = [], np.zeros(len(bins) - 1), np.zeros(len(bins) - 1)
    for stretch in lattices:
        places, text = scene(angle, stretch * DEEPEST / over_depth)
        run = Run(f"wedge_{angle}_{over_depth}_{stretch}", text)
        expect(run.status == 0 and not run.messages, f"wedge of {angle} degrees, Vt/l0 = {over_depth / stretch:.1f}: exit {run.status} {run.messages.strip()}")
        t, force = run.series("structure/time", "structure/force")
        late = t > 0.5 * DURATION
        forces.append(np.mean(2 * force[late, 0, 1] / (1000 * SPEED**3 * t[late])))
        for i, x in enumerate(places):
            t, pressure = run.gauge(f"p{i}", "pressure")
            late = t > 0.5 * DURATION
            z = x * slope / (SPEED * t[late]) - 1
            sums += np.histogram(z, bins, weights=pressure[late] / (0.5 * 1000 * SPEED**2))[0]
            counts += np.histogram(z, bins)[0]
    return np.mean(forces), sums / np.maximum(counts, 1), 0.5 * (bins[1:] + bins[:-1])


def wedge(angle, over_depth, lattices):
    """How far force and largest pressure are from the published ones, relative."""
    peak, force = EXACT[angle]
    force *= 1 - 1 / EXTENT**2  # the rim's share
    measured, profile, z = similar(angle, over_depth, lattices)
    at = np.argmax(profile)
    print(f"      wedge of {angle} degrees, Vt/l0 = {over_depth}, {len(lattices)} lattices: force {measured:.2f} rho V3 t ({force:.2f}), largest pressure {profile[at]:.2f} rho V2/2 ({peak}) at z = {z[at]:+.2f} V t")
    return abs(measured / force - 1), abs(profile[at] / peak - 1)


three, two = (0.96, 1.0, 1.04), (0.98, 1.02)
coarse, middle, fine = wedge(40, 5, three), wedge(40, 10, three), wedge(40, 20, two)
# the front is a particle thick at its edge, so that errors fall with l0, not faster
expect(fine[0] < 0.06, f"wedge of 40 degrees: force off by {fine[0]:.3f} at Vt/l0 = 20 (bound 0.06), {middle[0]:.3f} at 10, {coarse[0]:.3f} at 5")
expect(fine[1] < 0.08, f"wedge of 40 degrees: largest pressure off by {fine[1]:.3f} at Vt/l0 = 20 (bound 0.08), {middle[1]:.3f} at 10, {coarse[1]:.3f} at 5")
# order 1 would be a quarter
expect(fine[0] < 0.5 * coarse[0] and fine[1] < 0.5 * coarse[1], "wedge of 40 degrees: four times finer, both errors are less than half")
steep = wedge(30, 10, (0.96, 0.98, 1.0, 1.02, 1.04))
expect(steep[0] < 0.08 and steep[1] < 0.12, f"wedge of 30 degrees: force off by {steep[0]:.3f} (bound 0.08), largest pressure by {steep[1]:.3f} (bound 0.12) at Vt/l0 = 10: as far as at 40 degrees")
finish()
