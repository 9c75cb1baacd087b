"""The scene of Gotoh et al. (2009) at draft accuracy, with case1's wires: what a first honest run must show."""
import shutil

import numpy

from harness import (LAYOUTS, SCENES, check, check_below, check_between, check_invariants, main, run, run_folder, test)

import link_figures

DIAMETER = 0.008  # m, of an element
_chain = None


def chain(folder):
    """Run once for all tests of this file."""
    global _chain
    if _chain is None:
        _chain = folder.parent / (folder.name + "_chain")
        run("coupler", "run", SCENES / "gotoh2009.toml", "--set", "accuracy=draft", "--wires", LAYOUTS / "case1.toml",
            "--out", _chain, timeout=1100).expect_done()
    return _chain


def rotate(orientation, vectors):
    """Turns body-frame vectors (n, 3) by a quaternion (w, x, y, z)."""
    cross = numpy.cross(orientation[1:], vectors)
    return vectors + 2 * (orientation[0] * cross + numpy.cross(orientation[1:], cross))


def spheres_at(folder, instant):
    """Sphere centres of every block at the sample next to an instant: list of (n, 3) m."""
    geometry = run_folder.read_geometry(folder)
    time, position, orientation = run_folder.read_series(folder, "/blocks/position", "/blocks/orientation",
                                                         begin=instant - 1, end=instant + 1)
    sample = numpy.abs(time - instant).argmin()
    shapes = geometry["/blocks/shape"]
    return [position[sample, b] + rotate(orientation[sample, b], geometry[f"/shapes/{shapes[b]}/spheres"])
            for b in range(position.shape[1])]


def least_distance(points, others):
    return numpy.linalg.norm(points[:, None] - others[None], axis=2).min() if len(others) else numpy.inf


@test
def its_files_agree_and_invariants_hold(folder):
    verify = run("coupler", "verify", chain(folder)).expect_done()
    check(verify.stdout.count("sound") == 3, verify.stdout)
    for part in ("waves", "flow", "blocks"):
        check_invariants(chain(folder) / part)
    names = [name for name in run_folder.read_run(chain(folder) / "flow")["invariants"] if "mass" in name]
    check(names, "cmps reports no mass drift")
    check("energy_closure" in run_folder.read_run(chain(folder) / "blocks")["invariants"], "dem reports no energy closure")


@test
def memory_stays_small(folder):
    peak = sum(run_folder.read_run(chain(folder) / part)["peak_memory"] for part in ("waves", "flow", "blocks"))
    check_below("peak memory of the three stages together", peak / 2**30, 2, "GiB", "what was asked for")


@test
def cmps_continues_the_waves_of_boussinesq(folder):
    link = link_figures.compare(chain(folder))
    check_between("wave height at the link", link.height, 0.15, 0.19, "m", "0.172 m by linear theory, 10 % either way")
    strict, late = link.spans
    check_between("periods compared", strict.periods, 3.9, 4.1)
    check_below("RMS difference before any reflection, over height", strict.rms_over_height, 0.25, "", "what was asked for")
    check_below("RMS difference before that of half the height", late.rms_over_height, 0.25, "", "the same, stricter")


@test
def waves_at_the_gauges_are_periodic(folder):
    period = 1.65
    for gauge in ("H5-1", "H6-1", "H6-2"):
        time, elevation = run_folder.gauge(chain(folder) / "waves", gauge)
        last = [elevation[(time >= 40 - (n + 1) * period) & (time < 40 - n * period)] for n in range(3)]
        heights = [values.max() - values.min() for values in last]
        check_below(f"{gauge}: spread of the last three heights over their mean",
                    (max(heights) - min(heights)) / numpy.mean(heights), 0.05, "", "steady waves, still settling by some %")


@test
def no_block_is_inside_another_or_in_the_mound(folder):
    blocks = chain(folder) / "blocks"
    time, _ = run_folder.read_series(blocks, "/blocks/position")
    geometry = run_folder.read_geometry(blocks)
    mound, movable = geometry["/mound/spheres"], geometry["/blocks/fixed"] == 0
    for instant in (time[0], 0.5 * (time[0] + time[-1]), time[-1]):
        spheres = spheres_at(blocks, instant)
        centres = numpy.array([points.mean(axis=0) for points in spheres])
        least, in_mound = numpy.inf, numpy.inf
        for a, points in enumerate(spheres):
            for b in range(a + 1, len(spheres)):
                if numpy.linalg.norm(centres[a] - centres[b]) < 0.075:  # m, twice a block's radius
                    least = min(least, least_distance(points, spheres[b]))
            if not movable[a]:
                continue  # the fixed row is set into the mound
            low, high = points.min(axis=0) - DIAMETER, points.max(axis=0) + DIAMETER
            in_mound = min(in_mound, least_distance(points, mound[((mound > low) & (mound < high)).all(axis=1)]))
        check_between(f"t = {instant:.2f} s: least distance of two blocks' spheres", least / DIAMETER, 0.9, numpy.inf, "d",
                      "overlaps of a contact at draft step, far from one block inside another")
        check_between(f"t = {instant:.2f} s: least distance to a mound sphere", in_mound / DIAMETER, 0.9, numpy.inf, "d",
                      "the same")


@test
def blocks_move_and_wires_pull(folder):
    blocks = chain(folder) / "blocks"
    movable = run_folder.read_geometry(blocks)["/blocks/fixed"] == 0
    check(movable.sum() == 100, f"{movable.sum()} blocks that can move")
    _, position = run_folder.read_series(blocks, "/blocks/position")
    moved = numpy.linalg.norm(position[-1, movable] - position[0, movable], axis=1)
    check_between("largest displacement", moved.max(), 0.5 * DIAMETER, 1.0, "m", "more than half an element; within the flume")
    _, tension, intact = run_folder.read_series(blocks, "/wires/tension", "/wires/intact")
    check(numpy.isfinite(tension).all() and (tension >= 0).all(), "a tension is negative or not finite")
    check_between("largest tension", tension.max(), 0.01, 1000, "N", "a block weighs 0.68 N under water")
    check((numpy.diff(intact.astype(int), axis=0) <= 0).all(), "a broken wire came back")
    check((tension[intact == 0] == 0).all(), "a broken wire pulls")


try:
    main()
finally:
    if _chain is not None:
        shutil.rmtree(_chain, ignore_errors=True)
