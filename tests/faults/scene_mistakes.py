"""Mistakes in a scene: each gets one clear line with file, line and key, exit status 2, and nothing is run or written."""
from harness import changed_scene, check, line_of, main, run, run_folder, SCENES, test

# (what is changed in the small scene, text that finds the line, the key, what the message must say)
MISTAKES = [
    (("end = 7.0", 'end = "7 s"'), 'end = "7 s"', "time.end", "expected a number above 0 and at most 1000000 in s, got text"),
    (("window = 0.5", "window = -0.5"), "window = -0.5", "time.window", "expected a number of at least 0.0001 in s, got -0.5"),
    (("height = 0.06", "height = 0.06\nheigth = 0.06"), "heigth", "waves.heigth", "did you mean 'height'"),
    (('kind = "regular"', 'kind = "regluar"'), "regluar", "waves.kind", "regular"),
    (("bed = [[0.0, -0.30], [15.0, -0.30]]", "bed = [[15.0, -0.30], [0.0, -0.30]]"), "bed =", "flume.bed", "increase"),
    (('"front" = 5.5', '"front" = true'), '"front"', "gauges.front", "got true"),
    (('"link" = 4.8', '"link" = 4.8\n"." = 5.5'), '"." =', "gauges..", "no name for a gauge"),
    (("crest_lowering = 0.04", "crest_lowering = 0.04\nparticle_spacing = 0"), "particle_spacing",
     "cmps.particle_spacing", "got 0"),
    (("x = [5.20, 6.00]", "x = [5.20]"), "x = [5.20]", "cmps.flow.x", "2 numbers"),
    (("rows = 3", "rows = 2.5"), "rows = 2.5", "dem.blocks.rows", "whole number"),
    (("poisson_ratio = 0.3", "poisson_ratio = 0.7"), "poisson_ratio", "dem.poisson_ratio", "got 0.7"),
    (('shape = "beehive96"', 'shape = "beehave96"'), "beehave96", "dem.blocks.shape", "beehave96"),
    (("psi = 0.3", "psi = [0.3]"), "psi =", "wires.psi", "got a list"),
]


def run_chain(scene, folder, *options):
    ended = run("coupler", "run", scene, "--out", folder / "chain", *options)
    check(not (folder / "chain").exists(), "an output folder was made")
    return ended


@test
def each_mistake_alone(folder):
    for change, text, key, message in MISTAKES:
        scene = changed_scene(folder, "small", change)
        ended = run_chain(scene, folder).expect_error(2, f"{scene}:{line_of(scene, text)}:", key, message)
        print(f"    {ended.stderr.strip().replace(str(folder) + '/', '')}")


@test
def all_mistakes_at_once(folder):
    scene = changed_scene(folder, "small", *(change for change, *_ in MISTAKES))
    ended = run_chain(scene, folder).expect_status(2)
    lines = ended.stderr.splitlines()
    for _, text, key, message in MISTAKES:
        place = f"{scene}:{line_of(scene, text)}:"
        found = [line for line in lines if place in line and key in line and message in line]
        check(len(found) == 1, f"{len(found)} lines for {key} at {place}:\n{ended.stderr}")
    check(len(lines) == len(MISTAKES), f"{len(lines)} lines for {len(MISTAKES)} mistakes:\n{ended.stderr}")


@test
def text_that_is_not_toml(folder):
    scene = changed_scene(folder, "small", ("[cmps]", "[cmps"))
    run_chain(scene, folder).expect_error(2, f"{scene}:{line_of(scene, '[cmps')}:")


@test
def an_unknown_section(folder):
    scene = changed_scene(folder, "small", ("[wires]", "[wire]"))
    run_chain(scene, folder).expect_error(2, f"{scene}:{line_of(scene, '[wire]')}:", "wire", "did you mean 'wires'")


@test
def a_required_key_that_is_missing(folder):
    scene = changed_scene(folder, "small", ("end = 7.0\n", ""))
    run_chain(scene, folder).expect_error(2, str(scene), "time.end", "required")


@test
def a_scene_that_is_not_there(folder):
    run_chain(folder / "absent.toml", folder).expect_error(2, f"{folder}/absent.toml")


@test
def overrides_are_judged_like_the_scene(folder):
    scene = changed_scene(folder, "small")
    run_chain(scene, folder, "--set", "waves.height=tall").expect_error(2, "--set waves.height=tall", "waves.height")
    run_chain(scene, folder, "--set", "waves.hight=0.1").expect_error(2, "waves.hight", "did you mean 'height'")
    run_chain(scene, folder, "--set", "waves.height").expect_error(2, "--set")


@test
def a_layout_that_is_wrong(folder):
    scene = changed_scene(folder, "small")
    run_chain(scene, folder, "--wires", folder / "absent.toml").expect_error(2, f"{folder}/absent.toml")
    layout = folder / "layout.toml"
    for text, message in [("[wires]\npsi = 0.3\n\n[[wires.link]]\nblocks = [1, 99]\n", "99"),
                          ("[wires]\npsi = 0.3\n\n[[wires.link]]\nblocks = [2, 2]\n", "itself"),
                          ("[wires]\npsi = -1\n", "psi")]:
        layout.write_text(text)
        run_chain(scene, folder, "--wires", layout).expect_error(2, f"{layout}:", message)


@test
def numbers_that_no_run_could_take(folder):
    """What `check` lets pass `run` can simulate: intervals below a microsecond and elements of 1e-308 m are refused by both."""
    for setting, program in (("boussinesq.output_interval=1e-9", "boussinesq"), ("cmps.flow.interval=1e-9", "cmps"),
                             ("cmps.particles_interval=1e-9", "cmps"), ("dem.output_interval=1e-9", "dem"),
                             ("dem.element_diameter=1e-308", "dem"), ("time.window=1e-9", "boussinesq")):
        key = setting.split("=")[0]
        run(program, "check", SCENES / "small.toml", "--set", setting).expect_error(2, key, "expected a number", setting)
    # No whole number of nanoseconds: the last samples of a run must not fall on one instant.
    run("boussinesq", "run", SCENES / "small.toml", "--set", "time.end=0.0101", "--set", f"boussinesq.output_interval={1e-4 / 3}",
        "--out", folder / "waves", "--quiet").expect_done()


@test
def names_of_gauges_are_kept_whole(folder):
    scene = changed_scene(folder, "small", ('"front" = 5.5', '"g10" = 1.0\n"g10.5" = 1.5'))
    run("boussinesq", "run", scene, "--set", "time.end=4.0", "--out", folder / "waves", "--quiet").expect_done()
    record = run_folder.read_run(folder / "waves")
    gauges = record["figures"]["gauges"]
    check(set(gauges) == {"link", "g10", "g10.5"}, f"gauges in run.json: {list(gauges)}")
    check(gauges["g10"].keys() == gauges["g10.5"].keys(), f"{gauges}")


@test
def usage_mistakes(folder):
    for program in ("coupler", "boussinesq", "cmps", "dem"):
        run(program).expect_error(2, program)
        run(program, "rnu", "scene.toml").expect_error(2, program)
    run("coupler", "run", "scene.toml").expect_error(2, "--out")
    run("coupler", "verify", folder).expect_error(2, str(folder))
    run("coupler", "status", folder).expect_error(2, str(folder))
    run("dem", "run", changed_scene(folder, "small"), "--out", folder / "blocks", "--threads", "0").expect_error(2, "threads")
    for program, upstream in (("cmps", "--waves"), ("dem", "--flow")):
        run(program, "run", changed_scene(folder, "small"), "--out", folder / "alone", "--follow").expect_error(2, "--follow", upstream)


main()
