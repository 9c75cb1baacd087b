"""Pictures fit any scene: prototype scale, gauges of any name, a near field or blocks alone, few or many blocks, no wires.

Plots are drawn as SVG with their words as text, so that units, gauges and times can be read back.
"""
import json
import os
import re
import shutil
import subprocess

import h5py
import numpy

from harness import BIN, SCENES, SOURCE, check, environment, main, run, run_folder, test, write_scene

import link_figures

_own = None


def own_breakwater(folder):
    """The chain on the scene at prototype scale, until the first waves stand at the gauges; run once."""
    global _own
    if _own is None:
        _own = folder.parent / (folder.name + "_own")
        run("coupler", "run", SCENES / "own_breakwater.toml", "--set", "time.end=62", "--out", _own).expect_done()
    return _own


def plots(out):
    """`make plots`; the names of the pictures."""
    ended = subprocess.run(["make", "-s", "-C", SOURCE / "workflows", "plots", f"OUT={out}", f"BIN={BIN}"], capture_output=True,
                           text=True, env=environment(MAKEFLAGS=""))
    check(ended.returncode == 0, ended.stderr)
    return {path.stem for path in (out / "pictures").glob("*.png") if path.stat().st_size > 10000}


def words_of(folder, plot, source):
    """Every text in a plot's picture, or None where it draws nothing."""
    (folder / "matplotlibrc").write_text("svg.fonttype: none\n")
    picture = folder / f"{plot}.svg"
    picture.unlink(missing_ok=True)
    ended = subprocess.run(["/usr/bin/python3", SOURCE / f"workflows/plots/{plot}.py", source, picture], capture_output=True,
                           text=True, env=environment(MATPLOTLIBRC=str(folder / "matplotlibrc")))
    check(ended.returncode == 0, ended.stderr)
    if not picture.exists():
        check("no picture" in ended.stdout, f"{plot} drew nothing and said: {ended.stdout}")
        return None
    return re.findall(r"<text[^>]*>([^<]*)</text>", picture.read_text())


def check_words(words, *wanted):
    for fragment in wanted:
        check(any(fragment in word for word in words), f"no '{fragment}' among {words}")


@test
def a_scene_at_prototype_scale_runs_and_reports(folder):
    chain = own_breakwater(folder)
    verify = run("coupler", "verify", chain).expect_done()
    check(verify.stdout.count("sound") == 3, verify.stdout)
    check(plots(chain) == {"gauges", "link", "near_field", "blocks_plan", "blocks_displacement"}, "pictures are missing")


@test
def pictures_have_the_scenes_own_units_clock_and_gauges(folder):
    chain = own_breakwater(folder)
    # Two gauges, neither called "link"; half a metre to a metre of water moves, and wires pull with newtons to kilonewtons.
    check_words(words_of(folder, "gauges", chain), "gauge toe, x = 650 m", "gauge front, x = 680 m", "elevation, ")
    check_words(words_of(folder, "link", chain), "gauge toe, x = 650 m", "RMS difference")
    words = words_of(folder, "near_field", chain)
    check_words(words, "pressure, kPa")
    time, _ = run_folder.read_series(chain / "flow", "/particles/time")
    shown = [float(word[4:-2]) for word in words if word.startswith("t = ")]
    check(len(shown) == 4 and time[0] <= min(shown) and max(shown) <= time[-1], shown)
    check(any(word == "700" for word in words), f"no tick at the structure: {words}")
    words = words_of(folder, "plan", chain / "blocks")
    check_words(words, "0 of 594 broken", "tension of a link")
    check({str(number) for number in range(1, 37)} <= set(words), "a block is not numbered")
    check_words(words_of(folder, "displacement", chain / "blocks"), "wired (36 blocks)", "t = 62.00 s")


@test
def units_follow_the_size_of_what_is_drawn(folder):
    ended = subprocess.run(["/usr/bin/python3", "-c", "import style\n"
                            "print([style.length_unit(size)[1] for size in (0.004, 0.17, 4.0)],"
                            " [style.force_unit(size)[1] for size in (0.2, 5e3, 2e6)])"], capture_output=True, text=True,
                           env=environment(PYTHONPATH=str(SOURCE / "workflows/plots")))
    check(ended.stdout.strip() == "['mm', 'cm', 'm'] ['N', 'kN', 'MN']", ended.stdout + ended.stderr)


@test
def waves_from_a_record_have_no_period_in_the_scene(folder):
    chain = folder / "chain"
    shutil.copytree(own_breakwater(folder), chain)
    expected = link_figures.compare(chain)
    record = json.loads((chain / "waves/run.json").read_text())
    del record["scene"]["values"]["waves"]["period"]
    record["figures"]["gauges"]["toe"]["significant_period"] = 11.0
    (chain / "waves/run.json").write_text(json.dumps(record))
    found = link_figures.compare(chain)
    check(found.gauge == "toe" and [span.end for span in found.spans] == [span.end for span in expected.spans], found.spans)


@test
def stages_without_a_gauge_in_common_are_told(folder):
    """Gauges outside the near field, or records of less than two periods, are no error: there is no picture of the link."""
    chain = folder / "chain"
    shutil.copytree(own_breakwater(folder), chain)
    for path in run_folder.window_paths(chain / "flow")[1:]:
        path.unlink()
    check(words_of(folder, "link", chain) is None, "a picture of half a wave period")
    with h5py.File(run_folder.window_paths(chain / "flow")[0], "a") as file:
        del file["gauges"]
    check(words_of(folder, "link", chain) is None, "a picture of no gauge")
    check_words(words_of(folder, "gauges", chain), "gauge toe")


@test
def a_near_field_alone_is_drawn(folder):
    run("cmps", "run", SCENES / "dam_break.toml", "--set", "cmps.particle_spacing=0.1", "--set", "time.end=0.5", "--out",
        folder / "flow").expect_done()
    check(plots(folder) == {"gauges", "near_field"}, "pictures of a near field alone")
    check_words(words_of(folder, "gauges", folder), "gauge impact", "pressure, ")
    words = words_of(folder, "near_field", folder)
    check_words(words, "pressure, kPa", "3.0")  # the tank is 3 m high, and all of it is in the picture


@test
def waves_without_a_gauge_have_no_picture_and_no_error(folder):
    scene = write_scene(folder, '[time]\nend = 2\n[flume]\nbed = [[0, -0.5], [10, -0.5]]\n'
                                '[waves]\nkind = "regular"\nheight = 0.02\nperiod = 1.5\n')
    run("boussinesq", "run", scene, "--out", folder / "waves").expect_done()
    check(plots(folder) == set() and words_of(folder, "gauges", folder) is None, "a picture of no gauge")


@test
def one_block_alone_is_drawn(folder):
    scene = write_scene(folder, '[time]\nend = 0.2\n[dem]\ndry = true\n'
                                'planes = [{ point = [0, 0, 0], normal = [0, 0, 1] }]\n[[dem.block]]\nposition = [0, 0, 0.012]\n')
    run("dem", "run", scene, "--out", folder / "blocks").expect_done()
    check(plots(folder) == {"blocks_plan", "blocks_displacement"}, "pictures of one block")
    check_words(words_of(folder, "displacement", folder / "blocks"), "unwired (1 blocks)", "displacement, mm")


def many_blocks(folder, rows, columns):
    """A run of dem as its files show it: blocks of one shape on a grid, each a little farther to the sea with time."""
    folder.mkdir()
    count = rows * columns
    shape = numpy.array([[x, y, 0.0] for x in (-0.5, 0.5) for y in (-0.5, 0.5)])
    with h5py.File(folder / "geometry.h5", "w") as file:
        for name, values in {"shapes/0/spheres": shape, "shapes/0/diameter": [1.0], "blocks/shape": numpy.zeros(count, int),
                             "blocks/fixed": numpy.zeros(count, int)}.items():
            file[name] = values
    start = numpy.array([[-2.2 * row, 2.2 * column, 0.0] for row in range(rows) for column in range(columns)])
    time = numpy.linspace(100, 110, 6)
    with h5py.File(folder / "window_000000.h5", "w") as file:
        file.attrs.update(t_begin=time[0], t_end=time[-1])
        file["time"] = time
        file["blocks/position"] = start[None] - [0.3, 0, 0] * (time - 100)[:, None, None]
        file["blocks/orientation"] = numpy.tile([1.0, 0, 0, 0], (len(time), count, 1))
    (folder / "run.json").write_text('{"figures": {}, "scene": {"values": {}}}')


@test
def a_thousand_blocks_and_one_row_of_them_are_drawn(folder):
    many_blocks(folder / "blocks_many", 25, 40)
    many_blocks(folder / "blocks_deep", 30, 2)
    check(plots(folder) == {f"blocks_{name}_{kind}" for name in ("many", "deep") for kind in ("plan", "displacement")}, "pictures")
    words = words_of(folder, "displacement", folder / "blocks_many")
    check_words(words, "unwired (1000 blocks)", "offshore displacement, m", "t = 110.00 s", "3.0")
    check_words(words_of(folder, "plan", folder / "blocks_deep"), "60")


@test
def a_folder_without_runs_is_told(folder):
    ended = subprocess.run(["make", "-s", "-C", SOURCE / "workflows", "plots", f"OUT={folder}"], capture_output=True, text=True,
                           env=environment(MAKEFLAGS=""))
    check(ended.returncode != 0 and str(folder) in ended.stderr and "no run" in ended.stderr, ended.stderr)


try:
    main()
finally:
    if _own is not None and not os.environ.get("KEEP"):
        shutil.rmtree(_own, ignore_errors=True)
