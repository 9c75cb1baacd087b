"""`check` says what a run will take: cells exactly, steps and work (cells times steps) closely. Wall time is not judged here, it is
work times a cost that `check` measures on the machine; `make -C workflows cost` compares it with real runs."""
import re

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


main()
