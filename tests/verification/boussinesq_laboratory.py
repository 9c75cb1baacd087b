"""Measured waves: a submerged bar, a plane beach, run-up. Figures are published measurements with their citation."""
import numpy

from figures import error_figure
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


# Luth, Klopman and Kitou (1994), case A: elevation (mm) over time (s; one time base, its zero arbitrary) by x (m); every
# third of the digitised points.
BAR = {
    2: ((0.03, -9.4), (0.45, -6.1), (0.75, 2.3), (1.03, 9.9), (1.48, 7.0), (1.77, -2.1), (2.15, -10.1), (2.60, -3.0), (2.94, 7.7), (3.41, 9.5), (3.72, -0.3),
         (4.06, -9.0)),
    4: ((0.02, 9.2), (0.37, 10.1), (0.66, 2.1), (0.97, -7.0), (1.39, -9.4), (1.68, -2.2), (1.92, 5.9), (2.24, 11.7), (2.61, 4.6), (2.89, -4.1), (3.23, -10.2),
         (3.63, -4.9), (3.89, 4.3), (4.19, 11.2)),
    10.5: ((0.02, 14.4), (0.40, 7.3), (0.77, -4.1), (1.20, -11.2), (1.58, -4.5), (1.84, 7.6), (2.23, 12.7), (2.60, 1.4), (3.03, -8.9), (3.55, -6.7), (3.83, 6.1),
         (4.11, 14.7)),
    12.5: ((0.02, 7.3), (0.51, -0.8), (1.10, -10.4), (1.55, -6.2), (1.74, 15.0), (2.01, 9.0), (2.39, 1.9), (2.93, -6.7), (3.48, -9.8), (3.70, 9.0), (3.93, 15.6)),
    13.5: ((0.03, -7.3), (0.51, -8.2), (0.68, 8.6), (0.83, 25.8), (0.97, 8.6), (1.25, -1.4), (1.60, -0.1), (2.02, -6.8), (2.43, -9.8), (2.68, 4.2), (2.78, 21.6),
         (2.94, 15.8), (3.11, -1.0), (3.51, 2.6), (3.89, -5.8)),
    14.5: ((0.01, 2.7), (0.29, -6.6), (0.51, 3.2), (0.85, -3.7), (1.24, -7.9), (1.59, 0.1), (1.74, 13.6), (1.93, 18.6), (2.03, 4.1), (2.17, -9.7), (2.39, -0.7),
         (2.65, 1.6), (3.00, -7.3), (3.35, -6.9), (3.63, 2.7), (3.76, 16.2), (3.93, 19.6), (4.03, 5.0), (4.15, -8.3)),
    15.7: ((0.02, -12.2), (0.23, -8.1), (0.36, 3.1), (0.61, 8.5), (0.88, 12.9), (1.03, 2.6), (1.17, -10.0), (1.44, -6.7), (1.61, 3.2), (1.88, 0.1), (2.04, -11.7),
         (2.27, -5.9), (2.42, 5.4), (2.74, 11.1), (2.98, 7.1), (3.11, -4.5), (3.34, -12.2), (3.54, -1.0), (3.81, 5.1), (3.97, -6.5), (4.18, -12.5)),
    17.3: ((0.02, 3.5), (0.16, -11.9), (0.42, -7.9), (0.73, 0.2), (1.11, 0.0), (1.46, -3.9), (1.68, 5.5), (1.88, 19.8), (2.04, 3.6), (2.19, -12.6), (2.44, -7.8),
         (2.75, 0.7), (3.16, -0.7), (3.52, -2.9), (3.72, 8.6), (3.89, 19.5), (4.04, 5.9), (4.16, -9.1)),
    19: ((0.02, 11.2), (0.19, 6.7), (0.35, -3.7), (0.60, -0.3), (0.76, 10.0), (0.99, 7.0), (1.13, -4.4), (1.41, -8.0), (1.76, -8.9), (1.92, 2.2), (2.08, 12.2),
         (2.27, 2.1), (2.48, -5.0), (2.67, 3.0), (2.82, 11.8), (3.00, 7.4), (3.10, -2.1), (3.34, -9.2), (3.75, -8.5), (3.91, 0.8), (4.06, 11.1)),
    21: ((0.02, 5.5), (0.28, -0.2), (0.68, -6.8), (0.98, -10.7), (1.17, 3.3), (1.32, 14.9), (1.52, 9.9), (1.69, -4.7), (1.94, -0.1), (2.19, 3.3), (2.51, -0.2),
         (2.79, -11.7), (3.06, -6.3), (3.22, 6.9), (3.39, 17.7), (3.58, 5.2), (3.79, -7.3), (4.00, 3.0)),
}


@test
def regular_waves_over_a_submerged_bar(folder):
    # The bar of Beji and Battjes at twice the scale: T = 2.02 s, H = 0.020 m in 0.40 m.
    period, end = 2.02, 60.0
    gauges = "\n".join(f'"g{x:g}" = {{x = {x}, interval = 0.02}}' for x in BAR)
    run_scene(folder, f"""
[time]
end = {end}
window = 10.0
[flume]
bed = [[-10.0, -0.4], [6.0, -0.4], [12.0, -0.1], [14.0, -0.1], [17.0, -0.4], [40.0, -0.4]]
[waves]
kind = "regular"
height = 0.02
period = {period}
[boussinesq]
spacing = 0.05
output_interval = 1.0
[gauges]
{gauges}
""")
    records = {x: run_folder.gauge(folder / "waves", f"g{x:g}") for x in BAR}

    def differences(x, shift):
        time, level = numpy.array(BAR[x]).T
        computed = 1e3 * numpy.interp(end - 3 * period + (time + shift) % period, *records[x])
        return computed - level

    # The first gauge gives the time base.
    shift = min(numpy.linspace(0, period, 1000), key=lambda s: numpy.square(differences(2, s)).sum())
    errors = []
    for x, points in BAR.items():
        errors.append(numpy.sqrt(numpy.mean(differences(x, shift) ** 2)) / numpy.ptp([level for _, level in points]))
        time, elevation = records[x]
        last = time > end - 5 * period
        print(f"    x = {x}: {100 * errors[-1]:.1f} % of the range; harmonics "
              + ", ".join(f"{1e3 * a:.1f}" for a in harmonics(time[last], elevation[last], period)) + " mm")
    check_figure(error_figure("boussinesq", "submerged bar; Luth et al. (1994): mean over the gauges of the rms difference", numpy.mean(errors), "of the range"))
    check_below("mean over the gauges of the rms difference", numpy.mean(errors), 0.06, "of the range", "required")
    # Behind the bar free harmonics travel at their own speeds; amplitudes (mm) of the records.
    measured = {12.5: (11.1, 5.6, 3.2), 13.5: (9.0, 6.3, 5.8), 14.5: (6.7, 8.2, 5.8), 15.7: (6.0, 9.7, 4.0),
                17.3: (5.4, 8.8, 5.0), 19.0: (6.1, 7.2, 5.2), 21.0: (5.7, 8.5, 4.9)}
    off = []
    for x, amplitudes in measured.items():
        time, elevation = records[x]
        last = time > end - 5 * period
        off += [1e3 * c - m for c, m in zip(harmonics(time[last], elevation[last], period), amplitudes)]
    check_figure(error_figure("boussinesq", "submerged bar; Luth et al. (1994): rms difference of the harmonics", float(numpy.sqrt(numpy.mean(numpy.square(off)))), "mm"))
    check_below("rms difference of the harmonics", float(numpy.sqrt(numpy.mean(numpy.square(off)))), 1.2, "mm", "6 % of the height asked for")


@test
def regular_waves_breaking_on_a_plane_beach(folder):
    # Hansen and Svendsen (1979), no. 061071: T = 1.667 s, depth 0.36 m, slope 1:34.26 from x = 0.
    # x (m), height (m), mean level (m).
    measured = numpy.array([(0.010, 0.0686, -0.0001), (0.158, 0.0703, 0.0001), (0.404, 0.0686, -0.0001), (0.726, 0.0691, 0.0000),
                            (0.997, 0.0691, -0.0004), (1.339, 0.0679, -0.0003), (1.637, 0.0696, -0.0003), (1.932, 0.0725, -0.0002),
                            (2.253, 0.0695, -0.0002), (2.548, 0.0695, -0.0004), (2.842, 0.0724, -0.0004), (3.140, 0.0729, -0.0003),
                            (3.435, 0.0717, -0.0005), (3.705, 0.0711, -0.0005), (4.027, 0.0746, -0.0004), (4.322, 0.0751, -0.0008),
                            (4.616, 0.0727, -0.0008), (4.914, 0.0739, -0.0009), (5.209, 0.0761, -0.0010), (5.455, 0.0767, -0.0010),
                            (5.702, 0.0767, -0.0013), (5.973, 0.0784, -0.0011), (6.219, 0.0784, -0.0013), (6.442, 0.0812, -0.0014),
                            (6.736, 0.0829, -0.0013), (6.959, 0.0835, -0.0012), (7.178, 0.0852, -0.0013), (7.476, 0.0892, -0.0014),
                            (7.747, 0.0956, -0.0014), (7.942, 0.0996, -0.0015), (8.216, 0.1036, -0.0016), (8.486, 0.1001, -0.0014),
                            (8.733, 0.0850, -0.0015), (8.979, 0.0746, -0.0009), (9.226, 0.0624, -0.0010), (9.469, 0.0490, -0.0002),
                            (9.716, 0.0501, 0.0014), (9.815, 0.0449, 0.0015), (9.938, 0.0397, 0.0021), (10.209, 0.0373, 0.0032),
                            (10.455, 0.0350, 0.0045)])
    period = 1.667
    figures = run_scene(folder, f"""
[time]
end = 80.0
window = 10.0
[flume]
bed = [[-18.0, -0.36], [0.0, -0.36], [16.3336, 0.116754]]
[waves]
kind = "regular"
height = 0.0686
period = {period}
[boussinesq]
spacing = 0.025
output_interval = {period / 60}
""")
    x, time, elevation = (run_folder.static(folder / "waves", "/x"), *run_folder.read_series(folder / "waves", "/surface_elevation"))
    waves = elevation[-600:].reshape(10, 60, -1)  # the last ten, one by one
    envelope = run_folder.read_file(folder / "waves/envelope.h5")[1]
    for name, computed in (("mean of ten waves", numpy.ptp(waves, axis=1).mean(0)), ("envelope of ten waves", envelope["/wave_height"])):
        height = numpy.interp(measured[:, 0], x, computed)
        check_figure(error_figure("boussinesq", f"spilling breakers; Hansen and Svendsen (1979): rms height difference by the {name}",
                                  numpy.sqrt(numpy.mean((height - measured[:, 1]) ** 2)) / 0.0686, "H at the toe"))
        check_below(f"rms height difference, {name}", numpy.sqrt(numpy.mean((height - measured[:, 1]) ** 2)) / 0.0686, 0.12, "H at the toe", "required")
    level = numpy.interp(measured[:, 0], envelope["/x"], envelope["/mean_surface"])
    for place, h, h0, z, z0 in zip(measured[::4, 0], height[::4], measured[::4, 1], level[::4], measured[::4, 2]):
        print(f"    x = {place:6.3f}: H {h:.4f} ({h0:.4f}) m, level {1e3 * z:+.1f} ({1e3 * z0:+.1f}) mm")
    inner = measured[:, 0] > 9.2
    check_figure(error_figure("boussinesq", "spilling breakers; Hansen and Svendsen (1979): inner surf zone: computed over measured height by the envelope",
                              (height / measured[:, 1])[inner].mean(), reference=1.0))
    check_between("inner surf zone: computed over measured height", (height / measured[:, 1])[inner].mean(), 0.8, 1.2, "",
                  "saw-toothed bores that keep a constant share of the depth")
    check_figure(error_figure("boussinesq", "spilling breakers; Hansen and Svendsen (1979): rms set-up difference",
                              1e3 * numpy.sqrt(numpy.mean((level - measured[:, 2]) ** 2)), "mm"))
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
    ratios = []
    for height, cotangent in ((0.005, 19.85), (0.01, 19.85), (0.0185, 19.85), (0.05, 5.67)):
        figures = run_scene(folder, run_up_scene(height, 1.0 / cotangent, 0.05))
        law = 2.831 * numpy.sqrt(cotangent) * height ** 1.25
        ratios.append(figures["run_up"]["level"] / law - 1)
        print(f"    H/d = {height}, 1:{cotangent}: run-up {ratios[-1]:+.1%} of the law")
    check_figure(error_figure("boussinesq", "run-up of four solitary waves that do not break over Synolakis' law (1987): largest difference", max(ratios, key=abs)))
    check_below("run-up over the law", max(ratios, key=abs), 0.10, "", "required: 10 %")


@test
def run_up_of_breaking_solitary_waves(folder):
    # Synolakis (1987), breaking: R/d = 1.109 (H/d)^0.582. Rough to 20 %: a thin film over a smooth bed; c = 0.005 as for smooth plates.
    ratios = []
    for height in (0.1, 0.2, 0.3, 0.4):
        figures = run_scene(folder, run_up_scene(height, 1.0 / 19.85, 0.1, friction=0.005))
        law = 1.109 * height ** 0.582
        ratios.append(figures["run_up"]["level"] / law - 1)
        print(f"    H/d = {height}: run-up {ratios[-1]:+.1%} of the law")
    check_figure(error_figure("boussinesq", "run-up of four breaking solitary waves with friction 0.005 over 1.109 (H/d)^0.582: largest difference", max(ratios, key=abs)))
    check_below("run-up over the law", max(ratios, key=abs), 0.20, "", "scatter of the measurements behind the law")


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
        errors = []
        x, profiles = run_up_profiles(folder, height, (30.0, 40.0), 0.0)
        places = numpy.linspace(3.0, 19.0, 17)
        for t, profile in zip((30.0, 40.0), profiles):
            theory = linear_run_up_profile(height, 19.85, t, places)
            error = numpy.sqrt(numpy.mean((numpy.interp(places, x, profile) - theory) ** 2)) / height
            errors.append(error)
        check_figure(error_figure("boussinesq", f"profiles of run-up at H/d = {height} over Synolakis' linear solution; t = 30 and 40: larger rms difference", max(errors), "H"))
        check_below(f"H/d = {height}: rms difference to theory", max(errors), bound, "H", why)


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
    check_figure(error_figure("boussinesq", "profiles of run-up at H/d = 0.0185; Synolakis (1987): rms difference of all points", float(numpy.sqrt(numpy.mean(numpy.square(errors)))), "d"))
    check_below("rms difference of all", float(numpy.sqrt(numpy.mean(numpy.square(errors)))), 0.0035, "d",
                "the points scatter by 0.0004-0.003 d about a smooth curve and lie 0.0015-0.002 d below linear theory offshore")


main()
