"""Waves known from a record: they come in once, when the record says, whatever stands before and after them."""
import math
import random

import numpy

from harness import *


def packet(t):
    """Twenty millimetres of waves of 2 s under a bell of some 8 s about t = 10 s."""
    return 0.01 * math.exp(-(((t - 10) / 4) ** 2)) * math.cos(math.pi * (t - 10))


def record(folder, begin, end, elevation, name, interval=0.1):
    rows = "".join(f"{begin + interval * i:.2f},{elevation(begin + interval * i):.6f}\n" for i in range(round((end - begin) / interval) + 1))
    (folder / name).write_text("t,eta\n" + rows)


def scene(name, end=60.0):
    return f"""
[time]
end = {end}
window = 10.0
[flume]
bed = [[0.0, -0.5], [40.0, -0.5]]
[waves]
kind = "series"
file = "{name}"
[boussinesq]
spacing = 0.1
[gauges]
"near" = 15.0
"""


def run_record(folder, name, end=60.0):
    """Time and elevation at 15 m."""
    path = write_scene(folder, scene(name, end), name.replace(".csv", ".toml"))
    out = folder / name.replace(".csv", "")
    run("boussinesq", "run", path, "--out", out, "--quiet").expect_done()
    check_invariants(out)
    return run_folder.gauge(out, "near")


@test
def a_record_comes_in_once_and_when_it_says(folder):
    record(folder, 0, 20, packet, "early.csv")
    record(folder, 30, 50, lambda t: packet(t - 30), "late.csv")
    record(folder, 0, 50, lambda t: packet(t - 30), "quiet_lead_in.csv")
    early_time, early = run_record(folder, "early.csv", 90.0)
    late_time, late = run_record(folder, "late.csv", 90.0)
    padded_time, padded = run_record(folder, "quiet_lead_in.csv", 90.0)
    packet_energy = numpy.sum(early[(early_time > 5) & (early_time < 35)] ** 2)
    check_below("energy of the record's repetition", numpy.sum(early[early_time >= 35] ** 2) / packet_energy, 1e-3, "",
                "of the packet's; what the sponge sends back: a twentieth of its height at most")
    check_below("elevation before the late record", abs(late[late_time < 30]).max(), 1e-6, "m", "nothing comes in; its ripples are those of rounding to 1e-6 m")
    shifted = numpy.interp(late_time[late_time > 30] - 30, early_time, early)
    check_below("the same packet 30 s later", abs(late[late_time > 30] - shifted).max(), 2e-5, "m", "a thousandth of its height")
    check_below("the same after a quiet lead-in", abs(late - numpy.interp(late_time, padded_time, padded)).max(), 2e-5, "m", "a thousandth of its height")


@test
def quiet_parts_do_not_make_the_period(folder):
    """The period sizes zone, cells and sponge: that of the waves, not of the noise before them, nor the length of a pulse."""
    noise = random.Random(1)
    record(folder, 0, 60, lambda t: packet(t - 30) + noise.gauss(0, 1e-5), "noisy.csv")
    record(folder, 0, 60, lambda t: 0.02 * math.exp(-(((t - 30) / 0.8) ** 2)), "pulse.csv")
    for name, low, high, why in (("noisy.csv", 1.9, 2.1, "waves of 2 s"),
                                 ("pulse.csv", 3.2, 8.0, "a crest over a hundredth of its height for 3.4 s, half a wave")):
        path = write_scene(folder, scene(name), name.replace(".csv", ".toml"))
        told = run("boussinesq", "check", path).expect_done().stdout
        period = float(told.split("waves of ")[1].split(" s")[0])
        check_between(f"{name}: period", period, low, high, "s", why)


@test
def what_the_equations_do_not_carry_is_told(folder):
    """Ripples of 0.45 s in 0.5 m of water are kh = 10; 2 s are 1.0."""
    record(folder, 0, 40, lambda t: 0.01 * math.cos(math.pi * t) + 0.003 * math.cos(2 * math.pi / 0.45 * t), "rippled.csv", interval=0.05)
    told = run("boussinesq", "check", write_scene(folder, scene("rippled.csv"))).expect_done().stdout
    share = float(told.split(" % of the variance")[0].split()[-1])
    check_between("variance left out", share, 7.0, 9.5, "%", "0.003^2 / (0.01^2 + 0.003^2) = 8.3 %")


main()
