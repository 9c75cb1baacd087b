"""What studies share: the command line that `make` gives them, and intervals of means."""
import argparse
import os
import pathlib

import numpy
from scipy import stats


def command_line(description, scene=None):
    """Parser with --bin, --out, --smoke and, for the studies of a scene, --scene (default `scene`)."""
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the programs")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for runs, tables and pictures")
    if scene is not None:
        parser.add_argument("--scene", type=pathlib.Path, default=scene, help=f"the scene (default {scene.name})")
    parser.add_argument("--smoke", action="store_true", help="the short form")
    return parser


def half_width(values):
    """Half width of the 95 % confidence interval of a mean, Student's t for as many values as there are; nan for one."""
    values = numpy.asarray(values, float)
    if len(values) < 2:
        return float("nan")
    return float(stats.t.ppf(0.975, len(values) - 1) * values.std(ddof=1) / numpy.sqrt(len(values)))
