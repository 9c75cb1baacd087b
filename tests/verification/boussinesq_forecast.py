"""`check` says what a run will take: cells exactly, steps and work (cells times steps) closely. Wall time is not judged here, it is
work times a cost that `check` measures on the machine; `make -C workflows cost` compares it with real runs."""
import re

import numpy

from harness import *


def flume(bed, waves, end, more=""):
    return f"[time]\nend = {end}\nwindow = {end}\n[flume]\nbed = {bed}\n[waves]\n{waves}\n[boussinesq]\noutput_interval = 1.0\n{more}\n"


LEVEL = "[[0.0, -0.8], [50.0, -0.8]]"
SCENES = {
    "low waves": (flume(LEVEL, 'kind = "regular"\nheight = 0.05\nperiod = 1.65', 30.0), 0.05),
    "steep waves": (flume(LEVEL, 'kind = "regular"\nheight = 0.3\nperiod = 1.65', 30.0), 0.10),
    "irregular waves": (flume("[[0.0, -0.8], [15.0, -0.8], [23.0, -0.4], [50.0, -0.4]]", 'kind = "jonswap"\nheight = 0.12\nperiod = 1.8', 30.0), 0.10),
    "beach": (flume("[[0.0, -0.4], [14.0, -0.4], [32.0, 0.2]]", 'kind = "regular"\nheight = 0.1\nperiod = 1.8', 30.0), 0.10),
    "structure": (flume("[[0.0, -0.8], [15.0, -0.8], [23.0, -0.4], [39.0, -0.4], [40.2, 0.4], [42.0, 0.4]]", 'kind = "regular"\nheight = 0.168\nperiod = 1.65', 30.0), 0.10),
    # The crest leaves deep water half way: the steps of the start are taken for the whole.
    "solitary wave": (flume("[[0.0, -1.0], [40.0, -1.0], [100.0, 2.0]]", 'kind = "solitary"\nheight = 0.4\nposition = 15.0', 40.0), 0.60),
}


@test
def cells_steps_and_work(folder):
    for name, (text, bound) in SCENES.items():
        scene = write_scene(folder, text)
        told = run("boussinesq", "check", scene).expect_done().stdout
        cells, steps = (float(re.search(rf"^\s*{word}\s+(?:about )?([\d.e+]+)", told, re.MULTILINE)[1]) for word in ("cells", "steps"))
        run("boussinesq", "run", scene, "--out", folder / name.replace(" ", "_"), "--quiet").expect_done()
        figures = run_folder.read_run(folder / name.replace(" ", "_"))["figures"]
        check(cells == figures["cells"], f"{name}: {cells} cells told, {figures['cells']} used")
        check_below(f"{name}: steps told {steps:.0f}, taken {figures['steps']:.0f}: difference", steps / figures["steps"] - 1, bound, "",
                    "a factor of 2 in time is required; the rest of it is left to the cost of a step")


ERROR_SCENES = {  # bed, waves, end, gauges, wave length
    "level": (LEVEL, 'kind = "regular"\nheight = 0.02\nperiod = 1.65', 50.0, (15.0, 25.0, 35.0), 3.7),
    "gentle slope": ("[[0.0, -0.8], [12.0, -0.8], [42.0, -0.2], [60.0, -0.2]]", 'kind = "regular"\nheight = 0.02\nperiod = 1.65', 60.0, (25.0, 35.0, 45.0), 3.7),
    "shelf": ("[[0.0, -0.8], [20.0, -0.8], [23.0, -0.25], [50.0, -0.25]]", 'kind = "regular"\nheight = 0.05\nperiod = 1.8', 60.0, (20.0, 25.0, 30.0, 35.0), 4.1),
    "bar": ("[[-10.0, -0.4], [6.0, -0.4], [12.0, -0.1], [14.0, -0.1], [17.0, -0.4], [36.0, -0.4]]", 'kind = "regular"\nheight = 0.02\nperiod = 2.02', 50.0, (12.5, 14.5, 17.3, 21.0), 3.74),
    "solitary": ("[[0.0, -1.0], [150.0, -1.0]]", 'kind = "solitary"\nheight = 0.2\nposition = 25.0', 30.0, (80.0, 100.0), 5.7),
    "solitary over a slope": ("[[0.0, -1.0], [40.0, -1.0], [80.0, -0.6], [120.0, -0.6]]", 'kind = "solitary"\nheight = 0.1\nposition = 20.0', 28.0, (60.0, 80.0, 95.0), 7.4),
}


@test
def error_against_cells_four_times_smaller(folder):
    for name, (bed, waves, end, gauges, length) in ERROR_SCENES.items():
        records, told = {}, None
        for cells in (60, 240):
            more = f"spacing = {length / cells}\n[gauges]\n" + "\n".join(f'"g{x:g}" = {{x = {x}, interval = 0.02}}' for x in gauges)
            scene = write_scene(folder, flume(bed, waves, end, more))
            if told is None:
                told = float(re.search(r"^\s*error\s+about ([\d.e+-]+)", run("boussinesq", "check", scene).expect_done().stdout, re.MULTILINE)[1])
            run("boussinesq", "run", scene, "--out", folder / f"waves{cells}", "--quiet").expect_done()
            records[cells] = [run_folder.gauge(folder / f"waves{cells}", f"g{x:g}")[1] for x in gauges]
        last = numpy.arange(len(records[60][0])) > (0 if "solitary" in name else len(records[60][0]) - 500)
        difference = (lambda e: abs(e).max()) if "solitary" in name else (lambda e: numpy.sqrt(numpy.mean(e ** 2)))
        real = numpy.mean([difference(coarse[last] - fine[last]) / numpy.ptp(fine[last]) for coarse, fine in zip(records[60], records[240])])
        check_between(f"{name}: error told {told:.1g}, found {real:.1g}: ratio", told / real, 0.2, 5.0, "", "one figure for a scene, fitted to others within a factor of 3")


main()
