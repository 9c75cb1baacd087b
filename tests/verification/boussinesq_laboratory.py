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
    offshore = max(25.0, 3.2 / numpy.sqrt(0.75 * height))  # the wave is 1 % of its height 3.0 / sqrt(0.75 H) off its crest
    top = 1.3 if friction == 0.0 else 1.0
    return f"""
[time]
end = {(crest + 12.0 / slope) / numpy.sqrt(9.81)}
window = 10.0
[flume]
bed = [[{-crest - offshore}, -1.0], [{-toe}, -1.0], [{top / slope}, {top}]]
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


def bessel(order, argument):
    """J_0 or J_1 by its integral, trapezoidal rule (exact to rounding: the integrand is periodic)."""
    angle = numpy.linspace(0.0, numpy.pi, 401)
    weight = numpy.full(401, numpy.pi / 400)
    weight[[0, -1]] *= 0.5
    return (weight * numpy.cos(order * angle - numpy.multiply.outer(argument, numpy.sin(angle)))).sum(-1) / numpy.pi


def linear_run_up_profile(height, cotangent, time, x):
    """Synolakis (1987), eq. (2.6): a solitary wave's elevation over a plane beach by linear long-wave theory. Lengths over the
    depth, time times sqrt(g / d), x offshore of the still shoreline and 0 < x < cotangent; the crest starts as in run_up_scene."""
    step, begin = 0.1, -200.0
    sampled = begin + step * numpy.arange(10000)
    way = numpy.sqrt(4.0 / (3.0 * height)) * numpy.arccosh(numpy.sqrt(20.0))
    incident = height / numpy.cosh(numpy.sqrt(0.75 * height) * (numpy.sqrt(1.0 + height) * sampled - way)) ** 2
    spectrum, w = numpy.fft.rfft(incident), 2 * numpy.pi * numpy.fft.rfftfreq(len(sampled), step)
    spectrum, w = spectrum[w < 3.0], w[w < 3.0]
    at_toe = bessel(0, 2 * w * cotangent) + 1j * bessel(1, 2 * w * cotangent)
    profile = []
    for place in x:
        lines = spectrum * 2.0 / at_toe * bessel(0, 2 * w * numpy.sqrt(place * cotangent)) * numpy.exp(1j * w * (time - begin))
        profile.append((2.0 * lines.real.sum() - lines[0].real) / len(sampled))
    return numpy.array(profile)


def run_up_profiles(folder, height, times, friction):
    """x offshore of the shoreline and the elevation at each time (sqrt(d / g)), d = 1 m."""
    text = run_up_scene(height, 1.0 / 19.85, 0.05, friction).replace("output_interval = 1.0", f"output_interval = {10.0 / numpy.sqrt(9.81)}")
    run_scene(folder, text)
    time, elevation = run_folder.read_series(folder / "waves", "/surface_elevation")
    x = -run_folder.static(folder / "waves", "/x")[::-1]
    return x, [elevation[abs(time * numpy.sqrt(9.81) - t).argmin()][::-1] for t in times]


@test
def run_up_profiles_follow_linear_theory(folder):
    # A wave so low that linear theory holds off the shoreline; and the measured wave, whose profile departs by its own height over depth.
    for height, bound, why in ((0.002, 0.01, "nothing but dispersion and H/d over 30 depths of way departs from theory"), (0.0185, 0.06, "H/d = 2 % times the way")):
        x, profiles = run_up_profiles(folder, height, (30.0, 40.0), 0.0)
        places = numpy.linspace(3.0, 19.0, 17)
        for t, profile in zip((30.0, 40.0), profiles):
            theory = linear_run_up_profile(height, 19.85, t, places)
            error = numpy.sqrt(numpy.mean((numpy.interp(places, x, profile) - theory) ** 2)) / height
            check_below(f"H/d = {height}, t = {t:.0f}: rms difference to theory", error, bound, "H", why)


@test
def run_up_profiles_of_a_wave_that_does_not_break(folder):
    # Synolakis (1987), H/d = 0.0185 on 1:19.85: every eighth of the digitised points, (x / d, elevation / d) by t sqrt(g / d).
    measured = {
        30: ((0.22, 0.0000), (0.80, 0.0000), (1.38, 0.0003), (2.04, 0.0011), (2.91, 0.0027), (5.09, 0.0126), (9.02, 0.0223), (16.00, 0.0069)),
        40: ((0.29, 0.0093), (1.38, 0.0209), (2.62, 0.0286), (4.58, 0.0288), (7.93, 0.0143), (15.71, 0.0036)),
        50: ((-0.66, 0.0531), (0.36, 0.0392), (1.60, 0.0320), (2.62, 0.0246), (3.64, 0.0176), (6.47, 0.0106), (14.04, 0.0020), (19.78, 0.0020)),
        60: ((-0.66, 0.0519), (-0.22, 0.0386), (0.14, 0.0372), (0.66, 0.0279), (1.46, 0.0205), (2.40, 0.0152), (3.64, 0.0117), (6.54, 0.0059), (14.04, 0.0029), (19.78, 0.0027)),
        70: ((0.29, -0.0044), (0.92, -0.0060), (1.60, 0.0022), (2.69, 0.0101), (4.58, 0.0115), (7.93, 0.0088), (15.71, 0.0055)),
    }
    x, profiles = run_up_profiles(folder, 0.0185, measured, 0.005)
    errors = []
    for (t, points), profile in zip(measured.items(), profiles):
        place, level = numpy.array(points).T
        error = numpy.interp(place, x, profile) - level
        print(f"    t = {t}: rms {numpy.sqrt(numpy.mean(error ** 2)):.4f} d, mean {error.mean():+.4f} d")
        errors += list(error)
    check_below("rms difference of all", float(numpy.sqrt(numpy.mean(numpy.square(errors)))), 0.0035, "d",
                "the points scatter by 0.0004-0.003 d about a smooth curve and lie 0.0015-0.002 d below linear theory offshore")


main()
