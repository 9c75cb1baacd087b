"""Measured waves: a submerged bar, a plane beach, run-up. Figures are published measurements with their citation."""
import numpy

from harness import *


def run_scene(folder, text, *options):
    scene = write_scene(folder, text)
    run("boussinesq", "run", scene, "--out", folder / "waves", "--quiet", *options).expect_done()
    check_invariants(folder / "waves")
    return run_folder.read_run(folder / "waves")["figures"]


def harmonics(time, elevation, period, count=4):
    """Amplitudes of the first harmonics by least squares."""
    phase = 2 * numpy.pi / period * time
    columns = [numpy.ones_like(time)] + [f(n * phase) for n in range(1, count + 2) for f in (numpy.cos, numpy.sin)]
    solution = numpy.linalg.lstsq(numpy.column_stack(columns), elevation, rcond=None)[0]
    return [float(numpy.hypot(solution[2 * n - 1], solution[2 * n])) for n in range(1, count + 1)]


@test
def harmonics_over_a_submerged_bar(folder):
    # Luth, Klopman and Kitou (1994), case A: T = 2.02 s, H = 0.020 m over the bar of Beji and Battjes at twice the scale.
    # Amplitudes (mm) of the first three harmonics, from the digitised records of x = 12.5 ... 21 m.
    measured = {12.5: (11.1, 5.6, 3.2), 13.5: (9.0, 6.3, 5.8), 14.5: (6.7, 8.2, 5.8), 15.7: (6.0, 9.7, 4.0),
                17.3: (5.4, 8.8, 5.0), 19.0: (6.1, 7.2, 5.2), 21.0: (5.7, 8.5, 4.9)}
    gauges = "\n".join(f'"g{x}" = {{x = {x}, interval = 0.02}}' for x in measured)
    run_scene(folder, f"""
[time]
end = 60.0
window = 10.0
[flume]
bed = [[-10.0, -0.4], [6.0, -0.4], [12.0, -0.1], [14.0, -0.1], [17.0, -0.4], [40.0, -0.4]]
[waves]
kind = "regular"
height = 0.02
period = 2.02
[boussinesq]
spacing = 0.05
output_interval = 1.0
[gauges]
{gauges}
""")
    errors = []
    for x, amplitudes in measured.items():
        time, elevation = run_folder.gauge(folder / "waves", f"g{x}")
        last = time > 60.0 - 5 * 2.02
        computed = harmonics(time[last], elevation[last], 2.02)
        print(f"    x = {x}: " + ", ".join(f"{1e3 * c:.1f} ({m})" for c, m in zip(computed, amplitudes)) + " mm")
        errors += [1e3 * c - m for c, m in zip(computed, amplitudes)]
    check_below("rms difference of the harmonics", float(numpy.sqrt(numpy.mean(numpy.square(errors)))), 1.2, "mm",
                "6 % of the height asked for")


@test
def regular_waves_breaking_on_a_plane_beach(folder):
    # Hansen and Svendsen (1979), no. 061071: T = 1.667 s, depth 0.36 m, slope 1:34.26 from x = 0.
    # x (m), height (m), mean level (m), every fourth of the digitised points.
    measured = numpy.array([(0.010, 0.0686, -0.0001), (0.997, 0.0691, -0.0004), (2.253, 0.0695, -0.0002), (3.435, 0.0717, -0.0005),
                            (4.616, 0.0727, -0.0008), (5.702, 0.0767, -0.0013), (6.736, 0.0829, -0.0013), (7.747, 0.0956, -0.0014),
                            (8.733, 0.0850, -0.0015), (9.716, 0.0501, 0.0014), (10.455, 0.0350, 0.0045)])
    figures = run_scene(folder, """
[time]
end = 80.0
window = 10.0
[flume]
bed = [[-18.0, -0.36], [0.0, -0.36], [16.3336, 0.116754]]
[waves]
kind = "regular"
height = 0.0686
period = 1.667
[boussinesq]
spacing = 0.025
output_interval = 1.0
""")
    envelope = run_folder.read_file(folder / "waves/envelope.h5")[1]
    height = numpy.interp(measured[:, 0], envelope["/x"], envelope["/wave_height"])
    level = numpy.interp(measured[:, 0], envelope["/x"], envelope["/mean_surface"])
    for x, h, h0, z, z0 in zip(measured[:, 0], height, measured[:, 1], level, measured[:, 2]):
        print(f"    x = {x:6.3f}: H {h:.4f} ({h0:.4f}) m, level {1e3 * z:+.1f} ({1e3 * z0:+.1f}) mm")
    check_below("rms height difference", numpy.sqrt(numpy.mean((height - measured[:, 1]) ** 2)) / 0.0686, 0.12, "H at the toe",
                "required")
    check_below("rms set-up difference", 1e3 * numpy.sqrt(numpy.mean((level - measured[:, 2]) ** 2)), 1.5, "mm", "required")
    check_between("breaks at", figures["breaking"]["most_offshore"], 7.0, 8.6, "m", "highest wave measured at 8.2 m; breaking begins ahead of it")


def run_up_scene(height, slope, spacing, friction=0.0):
    toe = 1.0 / slope
    crest = toe + numpy.sqrt(4.0 / (3.0 * height)) * numpy.arccosh(numpy.sqrt(20.0))
    top = 1.3 if friction == 0.0 else 1.0
    return f"""
[time]
end = {(crest + 12.0 / slope) / numpy.sqrt(9.81)}
window = 10.0
[flume]
bed = [[{-crest - 25.0}, -1.0], [{-toe}, -1.0], [{top / slope}, {top}]]
[waves]
kind = "solitary"
height = {height}
position = {-crest}
[boussinesq]
spacing = {spacing}
friction = {friction}
output_interval = 1.0
"""


@test
def run_up_of_solitary_waves_that_do_not_break(folder):
    # Synolakis (1987): R/d = 2.831 sqrt(cot b) (H/d)^(5/4), valid until H/d = 0.818 (cot b)^(-10/9).
    for height, cotangent in ((0.005, 19.85), (0.01, 19.85), (0.0185, 19.85), (0.05, 5.67)):
        figures = run_scene(folder, run_up_scene(height, 1.0 / cotangent, 0.05))
        law = 2.831 * numpy.sqrt(cotangent) * height ** 1.25
        check_below(f"H/d = {height}, 1:{cotangent}: run-up {figures['run_up']['level']:.4f} d over the law", figures["run_up"]["level"] / law - 1, 0.10, "",
                    "required: 10 %")


@test
def run_up_of_breaking_solitary_waves(folder):
    # Synolakis (1987), breaking: R/d = 1.109 (H/d)^0.582. Rough to 20 %: a thin film over a smooth bed; c = 0.005 as for smooth plates.
    for height in (0.1, 0.2, 0.3, 0.4):
        figures = run_scene(folder, run_up_scene(height, 1.0 / 19.85, 0.1, friction=0.005))
        law = 1.109 * height ** 0.582
        check_below(f"H/d = {height}: run-up {figures['run_up']['level']:.3f} d over the law", figures["run_up"]["level"] / law - 1, 0.20, "",
                    "scatter of the measurements behind the law")


main()
