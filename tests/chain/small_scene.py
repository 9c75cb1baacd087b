"""The whole chain on a small scene: it runs, its files agree, and neither windows nor threads change its results."""
import shutil
import subprocess

import numpy

from harness import (BIN, SCENES, SOURCE, check, check_below, check_between, check_invariants, check_same_bytes,
                     environment, main, run, run_folder, test)

SCENE = SCENES / "small.toml"
FOLDERS = ("waves", "flow", "blocks")
_whole = None


def whole_chain(folder):
    """The scene as it is, run once."""
    global _whole
    if _whole is None:
        _whole = folder.parent / (folder.name + "_whole")
        run("coupler", "run", SCENE, "--out", _whole).expect_done()
    return _whole


def series(chain):
    """What the stages hand on, joined over the windows: {name: values}."""
    joined = {}
    for part, names in (("waves", ("/surface_elevation", "/velocity")),
                        ("flow", ("/flow/velocity", "/flow/acceleration", "/flow/wet")),
                        ("blocks", ("/blocks/position", "/blocks/orientation", "/wires/tension"))):
        for name in names:
            joined[f"{part} time of {name}"], joined[f"{part} {name}"] = run_folder.read_series(chain / part, name)
    return joined


def check_same_results(chain, other):
    """Bit for bit: nothing a stage computes depends on where its windows end."""
    first, second = series(chain), series(other)
    for name in first:
        check(first[name].shape == second[name].shape, f"{name}: {first[name].shape} and {second[name].shape} values")
        check_below(f"largest difference of {name}", numpy.abs(first[name] - second[name]).max(), 0, "",
                    "the same steps, so the same bits")


@test
def runs_and_its_files_agree(folder):
    chain = whole_chain(folder)
    verify = run("coupler", "verify", chain).expect_done()
    check(verify.stdout.count("sound") == 3, verify.stdout)
    for part in FOLDERS:
        check_invariants(chain / part)


@test
def waves_reach_the_structure_and_move_the_water_there(folder):
    chain = whole_chain(folder)
    _, elevation = run_folder.gauge(chain / "flow", "front")
    # Incident 0.06 m; the caisson reflects, so that crests stand up to twice as high, and the ramp may not have ended.
    check_between("largest surface elevation in front", elevation.max(), 0.015, 0.12, "m")
    _, velocity = run_folder.read_series(chain / "flow", "/flow/velocity")
    check_between("largest water speed at the blocks", numpy.abs(velocity).max(), 0.05, 3.0, "m/s")


@test
def blocks_rest_on_the_mound_and_feel_the_waves(folder):
    chain = whole_chain(folder)
    _, position = run_folder.read_series(chain / "blocks", "/blocks/position")
    position = position[:, run_folder.read_geometry(chain / "blocks")["/blocks/fixed"] == 0]
    check(position.shape[1] == 12, f"{position.shape[1]} blocks that can move instead of 3 x 4")
    moved = numpy.linalg.norm(position[-1] - position[0], axis=1)
    check_between("largest displacement", moved.max(), 1e-7, 0.10, "m", "felt, yet a wave of 6 cm carries nothing away")
    profile_x, profile_z = [5.20, 5.54, 5.80, 6.00], [-0.30, -0.30, -0.17, -0.17]
    above = position[..., 2] - numpy.interp(position[..., 0], profile_x, profile_z)
    check_between("lowest centre above the mean mound", above.min(), 0.0, 0.05, "m", "half a block is 0.012 m")
    _, tension = run_folder.read_series(chain / "blocks", "/wires/tension")
    check(numpy.isfinite(tension).all() and (tension >= 0).all(), "a tension is negative or not finite")


@test
def window_length_does_not_matter(folder):
    for length in ("0.05", "5"):
        chain = folder / f"window_{length}"
        run("coupler", "run", SCENE, "--set", f"time.window={length}", "--out", chain).expect_done()
        windows = len(run_folder.window_paths(chain / "waves"))
        print(f"    windows of {length} s: {windows}")
        check_same_results(chain, whole_chain(folder))
        shutil.rmtree(chain)


@test
def stages_alone_give_the_bytes_of_the_chain(folder):
    chain = whole_chain(folder)
    run("boussinesq", "run", SCENE, "--out", folder / "waves").expect_done()
    run("cmps", "run", SCENE, "--waves", folder / "waves", "--out", folder / "flow").expect_done()
    run("dem", "run", SCENE, "--flow", folder / "flow", "--out", folder / "blocks").expect_done()
    for part in FOLDERS:
        check_same_bytes(folder / part, chain / part)


@test
def threads_do_not_matter(folder):
    run("coupler", "run", SCENE, "--threads", "2", "--out", folder / "chain").expect_done()
    for part in FOLDERS:
        check_same_bytes(folder / "chain" / part, whole_chain(folder) / part)


@test
def the_near_field_may_start_in_any_window(folder):
    """cmps.start inside a later window: the flow begins there, and goes on to the end."""
    chain = whole_chain(folder)
    for start in (2.25, 4.75):
        out = folder / f"flow_{start}"
        run("cmps", "run", SCENE, "--set", f"cmps.start={start}", "--waves", chain / "waves", "--out", out).expect_done()
        time, _ = run_folder.read_series(out, "/flow/wet")
        check_below("first instant of the flow minus the start asked for", time[0] - start, 1e-9, "s", "rounding")
        check_below("last instant of the flow minus the end", time[-1] - 7.0, 1e-9, "s", "rounding")
        run("dem", "run", SCENE, "--set", f"cmps.start={start}", "--flow", out, "--out", folder / f"blocks_{start}").expect_done()


@test
def pictures_are_drawn(folder):
    chain = whole_chain(folder)
    ended = subprocess.run(["make", "-s", "-C", SOURCE / "workflows", "plots", f"OUT={chain}", f"BIN={BIN}"],
                           capture_output=True, text=True, env=environment(MAKEFLAGS=""))
    check(ended.returncode == 0, ended.stderr)
    names = {path.stem for path in (chain / "pictures").glob("*.png") if path.stat().st_size > 10000}
    check(names == {"gauges", "link", "near_field", "blocks_plan", "blocks_displacement"}, names)


@test
def paths_may_hold_spaces(folder):
    """Those of programs, coupler, pictures and ParaView's files; make refuses them by name (commands.py)."""
    spaced = folder / "my runs"
    spaced.mkdir()
    scene = spaced / "short flume.toml"
    shutil.copy(SCENE, scene)
    run("coupler", "run", scene, "--set", "time.end=2.2", "--out", spaced / "the chain").expect_done()
    run("coupler", "verify", spaced / "the chain").expect_done()
    for words in (["plots/gauges.py", spaced / "the chain", spaced / "gauges.png"], ["paraview.py", spaced / "the chain"]):
        ended = subprocess.run(["/usr/bin/python3", SOURCE / "workflows" / words[0], *words[1:]], capture_output=True, text=True)
        check(ended.returncode == 0, ended.stderr)
    check((spaced / "gauges.png").exists() and (spaced / "the chain/paraview/blocks.pvd").exists(), "files are missing")


@test
def waves_without_blocks(folder):
    """A scene without [dem] is a chain of two stages."""
    text = SCENE.read_text()
    scene = folder / "scene.toml"
    scene.write_text(text[:text.index("[dem]")].replace("end = 7.0", "end = 5.0"))
    run("coupler", "run", scene, "--out", folder / "chain").expect_done()
    check(not (folder / "chain/blocks").exists(), "dem was started")
    run("coupler", "verify", folder / "chain").expect_done()


try:
    main()
finally:
    if _whole is not None:
        shutil.rmtree(_whole, ignore_errors=True)
