"""Every mistake in a scene gets its one clear line, with file, line and key, exit 2, before anything runs."""
import json
import math

from harness import *

GOOD = """[time]
end = 5.0
window = 1.0
[flume]
bed = [[0.0, -0.8], [15.0, -0.8], [23.0, -0.4], [50.0, -0.4]]
[waves]
kind = "regular"
height = 0.1
period = 1.65
[gauges]
"H5-1" = 30.0
[boussinesq]
shoreward = "absorbing"
[effects]
breaking = "auto"
"""

SERIES = 'kind = "series"\nfile = "record.csv"'


def refuse(folder, old, new, *fragments, files=(), text=GOOD):
    """The scene with `old` changed to `new` is refused in one line that names the scene and holds `fragments`."""
    check(old in text, f"the scene does not hold {old}")
    good = text
    for name, text in files:
        (folder / name).write_text(text)
    scene = write_scene(folder, good.replace(old, new))
    for verb in (("check", scene), ("run", scene, "--out", folder / "waves")):
        result = run("boussinesq", *verb)
        result.expect_error(2, "scene.toml", *fragments)
    check(not (folder / "waves").exists(), "something was written")
    print(f"    {result.stderr.strip()[-150:]}")


@test
def bed(folder):
    refuse(folder, "[15.0, -0.8]", "[25.0, -0.8]", "flume.bed", "increase")
    refuse(folder, "[[0.0, -0.8], [15.0, -0.8], [23.0, -0.4], [50.0, -0.4]]", "[[0.0, -0.8]]", "flume.bed", "two points")
    refuse(folder, "[[0.0, -0.8], [15.0", "[[0.0, 0.1], [15.0", "flume.bed", "below still water")
    refuse(folder, "[15.0, -0.8]", "[3.0, -0.3]", "flume.bed", "level where waves are made")
    refuse(folder, "period = 1.65", "period = 9.0", "flume.bed", "too short")


@test
def waves(folder):
    refuse(folder, "height = 0.1", "height = 0.6", "waves.height", "higher than a wave", "at most")
    refuse(folder, "height = 0.1", "height = -0.1", "waves.height")
    refuse(folder, "period = 1.65", "period = 0.5", "waves.period", "kh")
    refuse(folder, 'kind = "regular"', 'kind = "regulat"', "waves.kind", "regular")
    refuse(folder, 'kind = "regular"\nheight = 0.1\nperiod = 1.65', 'kind = "solitary"\nheight = 0.75', "waves.height", "solitary", "at most")
    refuse(folder, "period = 1.65", "period = 1.65\nramps = 3.0", "waves.ramps", "ramp")


@test
def gauges_and_effects(folder):
    refuse(folder, '"H5-1" = 30.0', '"H5-1" = 60.0', "gauges.H5-1", "outside the flume")
    refuse(folder, '"H5-1" = 30.0', '"H5-1" = {x = 30.0, interval = 0.0}', "H5-1", "interval")
    refuse(folder, 'breaking = "auto"', 'breaking = "maybe"', "breaking")
    refuse(folder, 'breaking = "auto"', 'friction = "on"', "friction", "no coefficient")
    refuse(folder, 'breaking = "auto"', 'braking = "on"', "braking", "breaking")


@test
def numerics(folder):
    refuse(folder, 'shoreward = "absorbing"', "courant = 1.5", "boussinesq.courant")
    refuse(folder, 'shoreward = "absorbing"', "spacing = 20.0", "boussinesq.spacing", "cells")
    refuse(folder, 'shoreward = "absorbing"', "spacing = -0.1", "boussinesq.spacing")
    refuse(folder, 'shoreward = "absorbing"', 'offshore = "wall"', "boussinesq.offshore", "absorbing")
    refuse(folder, 'shoreward = "absorbing"', "alpha = 0.5", "boussinesq.alpha")


@test
def records(folder):
    regular = 'kind = "regular"\nheight = 0.1\nperiod = 1.65'
    rows = "".join(f"{0.1 * i:.1f},{0.01 * (-1) ** (i // 8)}\n" for i in range(100))
    refuse(folder, regular, SERIES, "waves.file", "record.csv")
    refuse(folder, regular, SERIES, "waves.file", "record.csv:42", "gap", files=[("record.csv", "t,eta\n" + "".join(
        f"{0.1 * i + (1.0 if i > 39 else 0.0):.1f},0.01\n" for i in range(100)))])
    refuse(folder, regular, SERIES, "waves.file", "record.csv:5", "increase", files=[("record.csv", "t,eta\n0,0\n1,0\n2,0\n1.5,0\n4,0\n")])
    refuse(folder, regular, SERIES, "waves.file", "record.csv:3", "nan", files=[("record.csv", "t,eta\n0,0\n1,nan\n2,0\n3,0\n4,0\n")])
    refuse(folder, regular, SERIES, "waves.file", "'t'", "'eta'", files=[("record.csv", "time_of_day,level\n" + rows)])
    refuse(folder, regular, SERIES, "waves.file", "record.csv:4", "3 values", files=[("record.csv", "t,eta\n0,0\n1,0\n2,0,0\n3,0\n4,0\n")])
    refuse(folder, regular, 'kind = "none"\n[initial]\nfile = "state.csv"', "initial.file", "covers", files=[("state.csv", "x,eta\n0,0\n10,0\n20,0\n30,0\n")])


@test
def waves_that_cannot_be(folder):
    regular = 'kind = "regular"\nheight = 0.1\nperiod = 1.65'
    refuse(folder, "height = 0.1", "height = inf", "waves.height", "above 0")
    refuse(folder, "height = 0.1", "height = 1e-12", "waves.height", "millionth of the depth")
    refuse(folder, "[waves]\n" + regular, "", "waves.kind", "missing")
    refuse(folder, "period = 1.65", "period = 1e6", "flume.bed", "too short")
    refuse(folder, "period = 1.65", "period = 1e-6", "waves.period", "kh")
    refuse(folder, regular, 'kind = "solitary"\nheight = 0.1\nposition = 500.0', "waves.position", "outside the flume")
    refuse(folder, regular, 'kind = "solitary"\nheight = 0.1\nposition = 20.0', "waves.position", "uneven bed")
    refuse(folder, regular, 'kind = "jonswap"\nheight = 0.4\nperiod = 2.0', "waves.height", "sea state", "at most")
    refuse(folder, regular, 'kind = "jonswap"\nheight = 0.05\nperiod = 2.0\ncomponents = 3', "waves.components", "10 to 5000")


def record(*values, interval=0.1):
    return [("record.csv", "t,eta\n" + "".join(f"{interval * i:.2f},{value}\n" for i, value in enumerate(values)))]


@test
def records_that_cannot_be(folder):
    regular = 'kind = "regular"\nheight = 0.1\nperiod = 1.65'
    waves = [0.01 * (-1) ** (i // 8) for i in range(100)]
    refuse(folder, regular, SERIES + "\nheight = 0.1", "waves.height", "from the record", files=record(*waves))
    refuse(folder, regular, SERIES + "\nperiod = 2.0", "waves.period", "from the record", files=record(*waves))
    refuse(folder, regular, SERIES + "\nposition = 5000.0", "waves.position", "outside the flume", files=record(*waves))
    refuse(folder, regular, SERIES + "\nposition = 30.0", "waves.position", "level bed", files=record(*waves))
    refuse(folder, regular, SERIES, "record.csv", "never changes", files=record(*[0.0] * 100))
    refuse(folder, regular, SERIES, "record.csv", "is it in metres?", files=record(*[5000 * value for value in waves]))
    refuse(folder, regular, SERIES, "record.csv", "kh", files=record(*[0.01 * (-1) ** i for i in range(100)]))
    refuse(folder, regular, SERIES, "record.csv", "header", files=[("record.csv", "")])
    refuse(folder, regular, SERIES, "record.csv:3", "abc", files=[("record.csv", "t,eta\n0,0\n1,abc\n2,0\n3,0\n4,0\n")])


@test
def records_that_would_harm(folder):
    regular = 'kind = "regular"\nheight = 0.1\nperiod = 1.65'
    sine = [0.02 * math.sin(2 * math.pi * 0.1 * i / 1.6) for i in range(200)]
    refuse(folder, regular, SERIES, "record.csv", "mean of 0.003", "take the mean off", files=record(*[value + 0.003 for value in sine]))
    refuse(folder, regular, SERIES, "record.csv", "at least 8 samples a wave", files=record(*[0.02 * (-1) ** (i // 3) for i in range(100)], interval=0.25))
    refuse(folder, regular, SERIES, "record.csv", "too steep", files=record(*[12 * value for value in sine], interval=0.07))
    refuse(folder, regular, SERIES, "record.csv:1", "two columns are named 'eta'", files=[("record.csv", "t,eta,eta\n" + "".join(f"{0.1 * i:.1f},{e},{e}\n" for i, e in enumerate(sine)))])
    refuse(folder, regular, SERIES, "record.csv", "'eta' and 'eta_m' are both eta", files=[("record.csv", "t,eta,eta_m\n" + "".join(f"{0.1 * i:.1f},{e},{e}\n" for i, e in enumerate(sine)))])
    refuse(folder, regular, SERIES, "record.csv:2", "outruns no wave", files=[("record.csv", "t,eta,u\n" + "".join(f"{0.1 * i:.1f},{e},40\n" for i, e in enumerate(sine)))])


@test
def solitary_waves_cut_off_by_an_end(folder):
    regular = 'kind = "regular"\nheight = 0.1\nperiod = 1.65'
    level = GOOD.replace("[15.0, -0.8], [23.0, -0.4], [50.0, -0.4]", "[50.0, -0.8]")
    for position in (0.0, 50.0):
        refuse(folder, regular, f'kind = "solitary"\nheight = 0.1\nposition = {position}', "waves.position", "cuts off", "to both sides", text=level)
    refuse(folder, regular, 'kind = "solitary"\nheight = 0.001', "waves.position", "of flume", text=level.replace("[50.0, -0.8]", "[40.0, -0.8]"))
    run("boussinesq", "check", write_scene(folder, level.replace(regular, 'kind = "solitary"\nheight = 0.3'))).expect_done()


@test
def initial_states_that_cannot_be(folder):
    waves = '[waves]\nkind = "regular"\nheight = 0.1\nperiod = 1.65'
    initial = '[initial]\nfile = "state.csv"'
    refuse(folder, waves, initial, "state.csv", "no water", files=[("state.csv", "x,eta\n0,-3\n20,-3\n30,-3\n60,-3\n")])
    refuse(folder, waves, initial, "state.csv:3", "1000", files=[("state.csv", "x,eta\n0,0\n20,1000\n30,0\n60,0\n")])
    refuse(folder, waves, initial, "state.csv:2", "100000 m/s", files=[("state.csv", "x,eta,u\n0,0,1e5\n20,0,0\n30,0,0\n60,0,0\n")])
    refuse(folder, waves, waves + "\n" + initial, "waves.kind", "not both", files=[("state.csv", "x,eta\n0,0\n20,0\n30,0\n60,0\n")])


@test
def more_than_a_machine_holds(folder):
    refuse(folder, "window = 1.0", "window = 1e-9", "time.window", "at least 0.0001")
    refuse(folder, 'shoreward = "absorbing"', "output_interval = 1e-6", "boussinesq.output_interval", "GB")
    refuse(folder, "window = 1.0", "window = 0.001\n", "boussinesq.output_interval", "GB on disk", text=GOOD.replace('shoreward = "absorbing"', "output_interval = 1e-6").replace("end = 5", "end = 500"))
    refuse(folder, 'shoreward = "absorbing"', "spacing = 1e-9", "boussinesq.spacing", "cells")
    refuse(folder, '"H5-1" = 30.0', '"H5-1" = {x = 30.0, interval = 1e-9}', "gauges.H5-1", "at least 1e-06")


@test
def samples_that_miss_the_waves(folder):
    key, near_field = 'shoreward = "absorbing"', "\n[cmps]\noffshore = 25.0"
    refuse(folder, key, "output_interval = 0.6875" + near_field, "boussinesq.output_interval", "2.4 samples a wave", "2 % of this accuracy", "at most")
    scene = write_scene(folder, GOOD.replace(key, key + "\noutput_interval = 0.2" + near_field))
    note = next(line for line in run("boussinesq", "check", scene).expect_status(0).stdout.splitlines() if "output_interval" in line)
    check("8.2 samples a wave" in note, note)
    result = run("boussinesq", "run", scene, "--out", folder / "told").expect_status(0)
    check(result.stderr.count("output_interval of 0.2 s") == 1, result.stderr)
    check("8.2 samples a wave" in json.loads((folder / "told" / "run.json").read_text())["notes"]["output_interval"], "run.json does not keep it")
    # what is offered is taken without a word; and so are coarse windows, with one, where nothing follows them
    offered = note.split("at most ")[1].split(" s")[0]
    result = run("boussinesq", "check", scene, "--set", f"boussinesq.output_interval={offered}").expect_status(0)
    check("output_interval" not in result.stdout, result.stdout)
    scene = write_scene(folder, GOOD.replace(key, "output_interval = 0.6875"))
    check("2.4 samples a wave" in run("boussinesq", "check", scene).expect_status(0).stdout, "not told")


@test
def heights_are_told_for_what_they_are(folder):
    sea = GOOD.replace('kind = "regular"', 'kind = "jonswap"')
    for text, words in ((GOOD, "wave height H in"), (sea, "significant wave height H_s = H_m0")):
        scene = write_scene(folder, text)
        check(words in run("boussinesq", "check", scene, "--all").expect_status(0).stdout, f"check --all does not say '{words}'")
    check("H_s = H_m0 = 0.1 m" in run("boussinesq", "check", scene).expect_status(0).stdout, "check does not say that the height is H_s")


@test
def constants_that_cannot_be(folder):
    key = 'shoreward = "absorbing"'
    refuse(folder, key, "dry_depth = 2.0", "boussinesq.dry_depth", "at most")
    refuse(folder, key, "friction = 1e9", "boussinesq.friction", "0 to 10")
    refuse(folder, key, "friction = -1", "boussinesq.friction", "0 to 10")
    refuse(folder, key, "breaking_start = 0.2\nbreaking_end = 0.5", "boussinesq.breaking_end", "breaking_start")
    refuse(folder, key, "generation_length = 0.001", "boussinesq.generation_length", "half a length")
    refuse(folder, key, "shoreward_sponge = 49.0", "flume.bed", "too short")
    refuse(folder, '"H5-1" = 30.0', '"" = 30.0', "gauges", "name")
    refuse(folder, "[time]", 'accuracy = "ultra"\n[time]', "accuracy", "draft")


@test
def all_mistakes_at_once_a_line_each(folder):
    text = GOOD.replace("height = 0.1", "height = 0.9").replace("= 30.0", "= 99.0").replace("end = 5.0", "end = -1.0").replace('"absorbing"', '"absorbng"')
    result = run("boussinesq", "check", write_scene(folder, text)).expect_status(2)
    lines = [line for line in result.stderr.splitlines() if line.strip()]
    for key in ("waves.height", "gauges.H5-1", "time.end", "boussinesq.shoreward"):
        check(sum(key in line for line in lines) == 1, f"{key} is not named once:\n{result.stderr}")


main()
