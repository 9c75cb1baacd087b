"""Only the effects a scene calls for: (a) wrong without, (b) the same with auto as with on where none is needed, (c) what it saves
is measured by the benchmark; and what auto left out is switched on when it turns out to be needed."""
import numpy

from harness import *


def run_scene(folder, text, name, *options):
    scene = write_scene(folder, text, name + ".toml")
    run("boussinesq", "run", scene, "--out", folder / name, "--quiet", *options).expect_done()
    check_invariants(folder / name)
    return run_folder.read_run(folder / name)


def flume(bed, waves, end, more="spacing = 0.05", gauges=""):
    return f"[time]\nend = {end}\nwindow = 5.0\n[flume]\nbed = {bed}\n[waves]\n{waves}\n[boussinesq]\n{more}\n[gauges]\n{gauges}\n"


def elevation(folder, name):
    return run_folder.read_series(folder / name, "/surface_elevation")[1]


def effect(record, name):
    return record["effects"][name]["on"]


LEVEL = "[[0.0, -0.8], [40.0, -0.8]]"
SHORT_WAVES = 'kind = "regular"\nheight = 0.05\nperiod = 1.65'
BEACH = "[[0.0, -0.4], [14.0, -0.4], [32.0, 0.2]]"
BEACH_WAVES = 'kind = "regular"\nheight = 0.1\nperiod = 1.8'


@test
def dispersion(folder):
    text = flume(LEVEL, SHORT_WAVES, 40.0, gauges="g = 25.0")
    check(effect(run_scene(folder, text, "auto"), "dispersion"), "auto leaves dispersion out at kh = 1.35")
    run_scene(folder, text, "off", "--set", "effects.dispersion=off")
    time, with_it = run_folder.gauge(folder / "auto", "g")
    _, without = run_folder.gauge(folder / "off", "g")
    last = time > 30
    wrong = numpy.sqrt(numpy.mean((with_it - without)[last] ** 2)) / 0.05
    check_between("kh = 1.35, without dispersion: rms difference", wrong, 0.2, 1.0, "H", "out of phase by a period after 2.6 periods' worth of flume")

    long_waves = flume("[[0.0, -0.2], [60.0, -0.2]]", 'kind = "regular"\nheight = 0.00001\nperiod = 12.0', 40.0, "spacing = 0.2", "g = 40.0")
    check(not effect(run_scene(folder, long_waves, "long"), "dispersion"), "auto takes dispersion in at kh = 0.08")
    run_scene(folder, long_waves, "long_on", "--set", "effects.dispersion=on")
    difference = abs(run_folder.gauge(folder / "long", "g")[1] - run_folder.gauge(folder / "long_on", "g")[1]).max() / 0.00001
    check_below("kh = 0.08: auto and on differ by", difference, 0.07, "H", "phase within the tolerance of 0.02 periods: 2 pi 0.02 / 2 = 0.063 at most")


@test
def breaking(folder):
    text = flume(BEACH, BEACH_WAVES, 60.0)
    check(effect(run_scene(folder, text, "auto"), "breaking"), "auto leaves breaking out on a beach")
    run_scene(folder, text, "off", "--set", "effects.breaking=off")
    heights = [run_folder.read_file(folder / name / "envelope.h5")[1] for name in ("auto", "off")]
    surf = (heights[0]["/x"] > 23) & (heights[0]["/x"] < 25.5)
    ratio = heights[1]["/wave_height"][surf].mean() / heights[0]["/wave_height"][surf].mean()
    check_between("surf zone: height without over height with", ratio, 1.15, 3.0, "", "the energy that breaking takes out")

    text = flume(LEVEL, SHORT_WAVES, 30.0)
    check(not effect(run_scene(folder, text, "low"), "breaking"), "auto takes breaking in at H/h = 0.06")
    run_scene(folder, text, "low_on", "--set", "effects.breaking=on")
    check_below("H/h = 0.06: auto and on differ by", abs(elevation(folder, "low") - elevation(folder, "low_on")).max(), 0.0, "m", "no front reaches the threshold: the same bits")


@test
def shoreline(folder):
    text = flume(BEACH, BEACH_WAVES, 20.0)
    check(effect(run_scene(folder, text, "auto"), "shoreline"), "auto leaves the shoreline out on a beach")
    scene = write_scene(folder, text, "off.toml")
    run("boussinesq", "run", scene, "--out", folder / "off", "--quiet", "--set", "effects.shoreline=off").expect_error(2, "shoreline", "off")
    # Without it there is no answer on a beach, so it is refused; what a user can run instead ends at a wall in shallow water.
    low = 'kind = "regular"\nheight = 0.02\nperiod = 1.8'
    reflection = {}
    for name, bed, more in (("beach", BEACH, ""), ("cut", "[[0.0, -0.4], [14.0, -0.4], [23.0, -0.1]]", '\nshoreward = "wall"\n[effects]\nshoreline = "off"')):
        record = run_scene(folder, f"[gauges]\ng = 10.0\n" + flume(bed, low, 80.0, more="spacing = 0.05" + more).replace("[gauges]\n", ""), name)
        check(effect(record, "shoreline") == (name == "beach"), f"{name}: shoreline is {record['effects']['shoreline']}")
        reflection[name] = record["figures"]["gauges"]["g"]["reflection_coefficient"]
    check_below("beach: reflection", reflection["beach"], 0.25, "", "surf similarity 0.53: 0.1 * 0.53^2 = 0.03 (Battjes 1974), and the gauges' method")
    check_between("cut off by a wall at 0.1 m: reflection", reflection["cut"], 0.6, 1.1, "", "waves of a fifth of that depth do not break before the wall")

    text = flume(LEVEL, SHORT_WAVES, 30.0, more="spacing = 0.05\ncourant = 0.5")
    check(not effect(run_scene(folder, text, "deep"), "shoreline"), "auto takes the shoreline in where the bed stays wet")
    run_scene(folder, text, "deep_on", "--set", "effects.shoreline=on")
    check_below("deep water: auto and on differ by", abs(elevation(folder, "deep") - elevation(folder, "deep_on")).max(), 1e-6, "m", "float32 of rounding")


@test
def friction(folder):
    text = flume(LEVEL, SHORT_WAVES, 40.0, gauges="g = 25.0")
    check(not effect(run_scene(folder, text, "auto"), "friction"), "auto takes friction in without a coefficient")
    # Long waves, quadratic friction, level bed: d(E cg)/dx = -c (4 / 3 pi) U^3 with U = a w / (k h), so that a falls as
    # 1 / (1 + B a x), B = c (4 / 3 pi) (w / k h)^3 / (g cg); T = 5 s in 0.4 m: k h = 0.2565, cg = 1.918 m/s (Airy).
    rough_text = flume("[[0.0, -0.4], [90.0, -0.4]]", 'kind = "regular"\nheight = 0.01\nperiod = 5.0', 120.0, "spacing = 0.1\nfriction = 1.0", gauges="a = 25.0\nb = 40.0")
    amplitude = {}
    for name, more in (("rough", ""), ("off", '[effects]\nfriction = "off"\n')):
        record = run_scene(folder, rough_text + more, name)
        check(effect(record, "friction") == (name == "rough"), f"{name}: friction is {record['effects']['friction']}")
        amplitude[name] = [0.5 * record["figures"]["gauges"][gauge]["mean_height"] for gauge in "ab"]
    decay = 4 / (3 * numpy.pi) * (2 * numpy.pi / 5.0 / 0.2565) ** 3 / (9.81 * 1.918)
    theory = 1 / (1 + decay * amplitude["rough"][0] * 15.0)
    print(f"    theory: {theory:.4f}")
    check_below("coefficient of 1: height at 40 m over that at 25 m, against theory", amplitude["rough"][1] / amplitude["rough"][0] - theory, 0.02, "",
                "H/h = 2.5 % enters, and friction takes 1 + (kh)^2 / 3 of the work of the mean velocity")
    check_between("without friction: height at 40 m too high by", amplitude["off"][1] / amplitude["rough"][1] - 1, 0.1, 1.5, "", "what friction takes out of 40 m")
    run_scene(folder, text, "zero", "--set", "boussinesq.friction=0.0")
    check_below("no coefficient: auto and a coefficient of zero differ by", abs(elevation(folder, "auto") - elevation(folder, "zero")).max(), 0.0, "m", "the term is not there")


@test
def friction_decays_a_uniform_flow_exactly(folder):
    # h u_t = -c u^2 over a level bed without waves: u = u0 / (1 + c u0 t / h), away from the ends.
    x = numpy.linspace(0, 200, 401)
    (folder / "flow.csv").write_text("x,eta,u\n" + "\n".join(f"{a:.3f},0.0,0.5" for a in x) + "\n")
    text = '[time]\nend = 20.0\nwindow = 5.0\n[flume]\nbed = [[0.0, -0.4], [200.0, -0.4]]\n[initial]\nfile = "flow.csv"\n[boussinesq]\nspacing = 0.5\nfriction = 0.05\n'
    run_scene(folder, text, "flow")
    velocity = run_folder.read_series(folder / "flow", "/velocity")[1][-1]
    exact = 0.5 / (1 + 0.05 * 0.5 * 20.0 / 0.4)
    check_below("speed after 20 s over the exact one", velocity[200] / exact - 1, 0.01, "", "first order in time: c u dt / 2h = 0.4 %")


@test
def breaking_left_out_is_switched_on_when_a_front_steepens(folder):
    x = numpy.linspace(0, 40, 4001)
    hump = 0.3 * numpy.exp(-((x - 20) / 0.4) ** 2)
    (folder / "hump.csv").write_text("x,eta\n" + "\n".join(f"{a:.3f},{b:.9f}" for a, b in zip(x, hump)) + "\n")
    text = '[time]\nend = 5.0\nwindow = 1.0\n[flume]\nbed = [[0.0, -0.8], [40.0, -0.8]]\n[initial]\nfile = "hump.csv"\n[boussinesq]\nspacing = 0.05\nbreaking_start = 0.1\n'
    record = run_scene(folder, text, "watched")
    check(effect(record, "breaking") and "switched on while running" in record["effects"]["breaking"]["reason"], "run.json does not say that breaking was switched on while running")
    note = " ".join(record["notes"].get("effect_watch", {}).values())
    print(f"    {note}")
    check("breaking switched on" in note, "the run did not say that it switched breaking on")


@test
def shoreline_left_out_is_switched_on_when_the_bed_dries(folder):
    x = numpy.linspace(0, 40, 4001)
    apart = 4.0 * numpy.tanh((x - 20) / 1.0) * numpy.exp(-((x - 20) / 6) ** 2)
    (folder / "apart.csv").write_text("x,eta,u\n" + "\n".join(f"{a:.3f},0.0,{b:.9f}" for a, b in zip(x, apart)) + "\n")
    text = '[time]\nend = 5.0\nwindow = 1.0\n[flume]\nbed = [[0.0, -0.1], [40.0, -0.1]]\n[initial]\nfile = "apart.csv"\n[boussinesq]\nspacing = 0.05\n'
    record = run_scene(folder, text, "watched")
    check(effect(record, "shoreline") and "switched on while running" in record["effects"]["shoreline"]["reason"], "run.json does not say that the shoreline was switched on while running")
    note = " ".join(record["notes"].get("effect_watch", {}).values())
    print(f"    {note}")
    check("shoreline switched on" in note, "the run did not say that it switched the shoreline on")
    # The same, interrupted and taken up again after the switch: the same bytes.
    scene = folder / "watched.toml"
    run("boussinesq", "run", scene, "--out", folder / "parts", "--quiet", "--set", "time.window=0.25").expect_done()
    process = start("boussinesq", "run", scene, "--out", folder / "again", "--quiet", "--set", "time.window=0.25")
    wait_for(lambda: len(run_folder.window_paths(folder / "again")) > 4, 60, "windows")
    process.kill()
    process.wait()
    run("boussinesq", "run", scene, "--out", folder / "again", "--quiet", "--resume", "--set", "time.window=0.25").expect_done()
    check_same_bytes(folder / "parts", folder / "again")
    records = [run_folder.read_run(folder / name) for name in ("parts", "again")]
    said = [record["notes"].get("effect_watch", {}) for record in records]
    check(said[0] and said[0] == said[1], f"run.json forgot what was said before the interruption: {said}")
    check(records[0]["effects"]["shoreline"]["reason"] == records[1]["effects"]["shoreline"]["reason"], "run.json forgot that the shoreline was switched on")


main()
