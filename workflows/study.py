"""The command line that every study shares: what `make` gives it."""
import argparse
import os
import pathlib


def command_line(description, scene=None):
    """Parser with --bin, --out, --scene (default `scene`; studies of built-in cases take it and do not use it) and --smoke."""
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder of the programs")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for runs, tables and pictures")
    parser.add_argument("--scene", type=pathlib.Path, default=scene, help="the scene, where the study is of one")
    parser.add_argument("--smoke", action="store_true", help="the short form")
    return parser
