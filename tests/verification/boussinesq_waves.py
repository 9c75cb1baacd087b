"""Waves made, carried, reflected and taken in, through the program: the height asked for is the height that arrives."""
import json

import numpy

from figures import error_figure
from harness import *


def flume(depth=0.8, length=60.0, end=120.0, waves="", gauges=(15, 20, 25, 30, 35, 40), more=""):
    names = "\n".join(f'"g{x}" = {x}' for x in gauges)
    return f"""
[time]
end = {end}
window = 10.0
[flume]
bed = [[0.0, {-depth}], [{length}, {-depth}]]
[waves]
{waves}
[gauges]
{names}
[boussinesq]
{more}
"""


def run_flume(folder, text, *options, name="waves"):
    scene = write_scene(folder, text, name + ".toml")
    run("boussinesq", "run", scene, "--out", folder / name, "--quiet", *options).expect_done()
    check_invariants(folder / name)
    return run_folder.read_run(folder / name)["figures"]


def gauge_figures(figures, key):
    return numpy.array([gauge[key] for gauge in figures["gauges"].values()])


@test
def height_asked_for_is_the_height_that_arrives(folder):
    means, spreads = [], []
    for height, period in ((0.01, 1.65), (0.168, 1.65), (0.3, 1.65), (0.15, 3.0), (0.05, 1.1)):
        figures = run_flume(folder, flume(waves=f'kind = "regular"\nheight = {height}\nperiod = {period}'), name=f"h{height}")
        heights = gauge_figures(figures, "mean_height") / height
        means.append(heights.mean() - 1), spreads.append(heights.max() - heights.min())
    which = "height of regular waves; H 0.01 to 0.3 m in 0.8 m; T 1.1 to 3 s: "
    check_figure(error_figure("boussinesq", which + "largest mean difference", max(means, key=abs), "H"))
    check_figure(error_figure("boussinesq", which + "largest spread along the flume", max(spreads), "H"))
    check_below("largest spread along the flume", max(spreads), 0.02, "H", "what the sponge sends back, and nothing more")


@test
def steep_wave_keeps_its_form(folder):
    figures = run_flume(folder, flume(waves='kind = "regular"\nheight = 0.3\nperiod = 1.65'))
    crest = gauge_figures(figures, "highest") / gauge_figures(figures, "mean_height")
    check_figure(error_figure("boussinesq", "crest over height of waves of 0.3 m in 0.8 m along seven lengths: spread", crest.max() - crest.min()))
    check_between("crest over height", crest.mean(), 0.55, 0.62, "", "Stokes and cnoidal theory: 0.58 at this steepness")


@test
def sponge_takes_waves_in(folder):
    for period in (1.1, 1.65, 2.5):
        figures = run_flume(folder, flume(waves=f'kind = "regular"\nheight = 0.02\nperiod = {period}'), name=f"t{period}")
        reflection = gauge_figures(figures, "reflection_coefficient").mean()
        check_figure(error_figure("boussinesq", f"reflection of the sponge at T = {period} s", reflection))


@test
def reflected_waves_do_not_come_back(folder):
    # A wall at the end: a full standing wave, whose incident part must stay what was asked for.
    waves = 'kind = "regular"\nheight = 0.02\nperiod = 1.65'
    figures = run_flume(folder, flume(waves=waves, more='shoreward = "wall"', end=150.0))
    check_figure(error_figure("boussinesq", "incident height in front of a wall after 90 periods: difference",
                              gauge_figures(figures, "incident_height").mean() / 0.02 - 1, "H"))
    check_figure(error_figure("boussinesq", "reflection of a wall", gauge_figures(figures, "reflection_coefficient").mean(), reference=1.0))


@test
def irregular_waves_have_the_height_of_their_spectrum(folder):
    for kind in ("jonswap", "bretschneider"):
        waves = f'kind = "{kind}"\nheight = 0.05\nperiod = 2.0\nseed = 3'
        figures = run_flume(folder, flume(waves=waves, end=400.0, gauges=(20, 30)), name=kind)
        check_below(f"{kind}: 4 sigma over the height asked for", gauge_figures(figures, "spectral_height").mean() / 0.05 - 1, 0.07, "",
                    "150 waves scatter by 1 / sqrt(2 * 150) = 6 %")
        ratio = gauge_figures(figures, "significant_height").mean() / gauge_figures(figures, "spectral_height").mean()
        check_between(f"{kind}: H_1/3 over 4 sigma", ratio, 0.88, 1.02, "", "0.95 in Goda's field data")


@test
def incident_height_does_not_depend_on_the_length_of_the_record(folder):
    waves = 'kind = "jonswap"\nheight = 0.05\nperiod = 2.0\nseed = 3'
    for end, bound in ((120.0, 0.10), (800.0, 0.04)):
        open_flume = run_flume(folder, flume(waves=waves, end=end, gauges=(20, 25, 30)), name=f"sponge{end:.0f}")
        spectral, incident = gauge_figures(open_flume, "spectral_height"), gauge_figures(open_flume, "incident_height")
        check_below(f"{end:.0f} s, sponge: incident over spectral height", abs(incident / spectral - 1).max(), 0.03, "", "the sponge sends back a per cent; gauges a quarter length apart scatter by 2 %")
        walled = run_flume(folder, flume(waves=waves, end=end, gauges=(20, 25, 30), more='shoreward = "wall"'), name=f"wall{end:.0f}")
        check_below(f"{end:.0f} s, wall: incident height over that without the wall", gauge_figures(walled, "incident_height").mean() / incident.mean() - 1, bound, "",
                    "reflected waves arrive later: another part of the sea; a mean over half a length of standing waves")


@test
def similar_scenes_give_similar_waves(folder):
    # Froude similarity: the equations know no length of their own, so neither may the code. A beach with breaking waves.
    for breaking in ("viscous_bore", "hydrostatic"):
        found = {}
        for scale in (0.1, 1.0, 100.0):
            period = 1.65 * scale ** 0.5
            text = f"""
[time]
end = {12 * period!r}
window = {4 * period!r}
[flume]
bed = [[0, {-0.8 * scale!r}], [{18 * scale!r}, {-0.8 * scale!r}], [{38 * scale!r}, {0.2 * scale!r}]]
[waves]
kind = "regular"
height = {0.12 * scale!r}
period = {period!r}
[boussinesq]
breaking = "{breaking}"
output_interval = {period!r}
[gauges]
toe = {{x = {15 * scale!r}, interval = {period / 60!r}}}
surf = {{x = {31 * scale!r}, interval = {period / 60!r}}}
"""
            figures = run_flume(folder, text, name=f"{breaking}{scale}")
            found[scale] = numpy.array([figures["gauges"][name][key] / scale for name in ("toe", "surf") for key in ("mean_height", "set_up", "highest")]
                                       + [figures["run_up"]["level"] / scale, figures.get("breaking", {"most_offshore": 0.0})["most_offshore"] / scale])
        for scale in (0.1, 100.0):
            check_below(f"{breaking}: scale {scale} against 1", abs(found[scale] - found[1.0]).max(), 1e-6, "m at scale 1", "rounding, which breaking multiplies")


def low_passed(values, interval, highest):
    """Frequencies up to `highest` (Hz) but the mean."""
    spectrum, frequency = numpy.fft.fft(values), abs(numpy.fft.fftfreq(len(values), interval))
    return numpy.fft.ifft(numpy.where((frequency < highest) & (frequency > 0), spectrum, 0)).real


@test
def groups_carry_their_long_wave(folder):
    # Longuet-Higgins and Stewart (1962): under groups of amplitude A(t) the level is -g (2 cg / c - 1/2) A^2 / 2 / (g d - cg^2).
    # Seven gauges on 24 m; A from the gauge's own record. Made without, the same long wave comes with a free one that cancels it
    # at the generator and runs away from it.
    period, depth, gauges = 2.0, 0.8, (12, 16, 20, 24, 28, 32, 36)
    w = 2 * numpy.pi / period
    k = w * w / 9.81
    for _ in range(100):
        k = 0.5 * (k + w * w / 9.81 / numpy.tanh(k * depth))
    group = 0.5 * w / k * (1 + 2 * k * depth / numpy.sinh(2 * k * depth))
    share = -9.81 * (2 * group / (w / k) - 0.5) / (9.81 * depth - group ** 2) / 2
    slope, set_up = {}, {}
    for bound in ("second_order", "none"):
        waves = f'kind = "jonswap"\nheight = 0.05\nperiod = {period}\npeak_enhancement = 20.0\nseed = 7\nbound_waves = "{bound}"'
        figures = run_flume(folder, flume(waves=waves, end=420.0, gauges=gauges), name=bound)
        set_up[bound] = abs(gauge_figures(figures, "set_up")).max() * 1e3
        slopes = []
        for x in gauges:
            time, elevation = run_folder.gauge(folder / bound, f"g{x}")
            elevation, interval = elevation[time > 40], time[1] - time[0]
            spectrum, frequency = numpy.fft.fft(elevation), numpy.fft.fftfreq(len(elevation), interval)
            envelope = abs(numpy.fft.ifft(numpy.where((frequency > 0.5 / period) & (frequency < 1.6 / period), 2 * spectrum, 0)))
            theory, level = (low_passed(values, interval, 0.35 / period) for values in (share * envelope ** 2, elevation))
            slopes.append(theory @ level / (theory @ theory))
        slope[bound] = numpy.mean(slopes)
        print(f"    {bound}: level over theory by regression " + ", ".join(f"{value:.2f}" for value in slopes) + f"; largest mean level {set_up[bound]:.3f} mm")
    check_figure(error_figure("boussinesq", "long wave under groups over that of Longuet-Higgins and Stewart; mean of seven gauges", slope["second_order"], reference=1.0))
    check_between("second order: level over theory", slope["second_order"], 0.85, 1.25, "", "theory of narrow bands; long waves that the sponge sends back scatter it by a tenth")
    check_below("linear: level over theory", slope["none"], 0.6, "", "the free wave takes most of it away")
    check_below("second order: largest mean level", set_up["second_order"], 0.05, "mm", "no mean flux; linear waves pile up water")


@test
def a_record_comes_out_where_it_was_taken(folder):
    # Waves of one run, recorded at x = 15, drive a second one; both must agree farther on.
    waves = 'kind = "regular"\nheight = 0.02\nperiod = 1.65'
    run_flume(folder, flume(waves=waves, end=40.0), name="first")
    time, elevation = run_folder.gauge(folder / "first", "g15")
    (folder / "record.csv").write_text("t,eta\n" + "\n".join(f"{t:.6f},{e:.9f}" for t, e in zip(time, elevation)) + "\n")
    run_flume(folder, flume(waves='kind = "series"\nfile = "record.csv"\nposition = 15.0', end=40.0), name="second")
    for x in (20, 25):
        time, first = run_folder.gauge(folder / "first", f"g{x}")
        other_time, other = run_folder.gauge(folder / "second", f"g{x}")
        settled = (time > 22) & (time < 34)
        second = numpy.interp(time[settled], other_time, other)
        error = numpy.sqrt(numpy.mean((second - first[settled]) ** 2)) / 0.02
        check_below(f"difference at x = {x} m", error, 0.04, "H", "the wave is linear at 2 % of the depth; H/d enters squared")


@test
def a_hump_parts_into_two_equal_waves(folder):
    x = numpy.linspace(0.0, 40.0, 2001)
    hump = 0.05 * numpy.exp(-((x - 20.0) / 1.5) ** 2)
    (folder / "hump.csv").write_text("x,eta\n" + "\n".join(f"{a:.4f},{b:.9f}" for a, b in zip(x, hump)) + "\n")
    text = """
[time]
end = 4.0
window = 1.0
[flume]
bed = [[0.0, -0.8], [40.0, -0.8]]
[initial]
file = "hump.csv"
[boussinesq]
spacing = 0.05
[gauges]
left = 12.025
right = {x = 27.975, interval = 0.01}
"""
    run_flume(folder, text)
    _, left = run_folder.gauge(folder / "waves", "left")
    time, right = run_folder.gauge(folder / "waves", "right")
    check(len(time) > 350, f"the gauge with its own interval of 0.01 s holds {len(time)} samples in 4 s")
    elevation = run_folder.read_series(folder / "waves", "/surface_elevation")[1]
    check_below("left and right differ by", abs(elevation - elevation[:, ::-1]).max(), 1e-7, "m", "float32 of 0.05 m")
    check_between("height of each half", right.max() / 0.05, 0.42, 0.52, "", "half, spread by dispersion")
    check_between("height of the other", left.max() / 0.05, 0.42, 0.52, "", "half, spread by dispersion")


@test
def windows_do_not_touch_the_waves(folder):
    waves = 'kind = "regular"\nheight = 0.1\nperiod = 1.65'
    records = []
    for window in (0.05, 0.77, 5.0):
        run_flume(folder, flume(waves=waves, end=10.0), "--set", f"time.window={window}", name=f"w{window}")
        time, elevation = run_folder.gauge(folder / f"w{window}", "g15")
        records.append(dict(zip(numpy.round(time, 9), elevation)))
    common = set(records[0]) & set(records[1]) & set(records[2])
    check(len(common) > 300, f"only {len(common)} common samples")
    worst = max(abs(records[0][t] - record[t]) for t in common for record in records[1:])
    check_below("difference between windows of 0.05, 0.77 and 5 s", worst, 1e-15, "m", "the steps do not know of windows")


@test
def a_killed_run_goes_on_to_the_same_bytes_and_figures(folder):
    # A beach, so that breaking, shoreline, run-up and envelope are all under way when the run is killed.
    text = """
[time]
end = 24.0
window = 0.2
[flume]
bed = [[0.0, -0.4], [10.0, -0.4], [22.0, 0.2]]
[waves]
kind = "regular"
height = 0.1
period = 1.8
[gauges]
toe = 9.0
surf = {x = 16.0, interval = 0.01}
"""
    scene = write_scene(folder, text)
    run("boussinesq", "run", scene, "--out", folder / "whole", "--quiet").expect_done()
    for windows in (5, 30, 60, 110):
        process = start("boussinesq", "run", scene, "--out", folder / "parts", "--quiet", "--resume")
        wait_for(lambda: len(run_folder.window_paths(folder / "parts")) >= windows, 120, f"{windows} windows")
        process.kill()
        process.wait()
    run("boussinesq", "run", scene, "--out", folder / "parts", "--quiet", "--resume").expect_done()
    check_same_bytes(folder / "whole", folder / "parts")
    check((folder / "whole/envelope.h5").read_bytes() == (folder / "parts/envelope.h5").read_bytes(), "the envelopes differ")
    whole, parts = (run_folder.read_run(folder / name)["figures"] for name in ("whole", "parts"))
    for key in ("gauges", "run_up", "run_down", "breaking", "water", "energy", "steps"):
        check(whole[key] == parts[key], f"{key} differ: {whole[key]} and {parts[key]}")


main()
