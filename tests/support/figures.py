"""Published figures: rows of results/<stage>.csv, written by the test of each claim and read by it ever after.

    holds, text = error_figure("boussinesq", "reflection of the sponge at T = 1.65 s", 0.0004)
    holds, text = ensemble_figure("cmps", "first peak at z = 3 mm", members, unit="rho g H")
    holds, text = limit_figure("dem", "creep of a stack of 4", 5e-17, 1e-15, unit="d", why="round-off of ...")

An ordinary run judges; with TSUNAGI_RECORD=1 (make -C workflows results) the same call writes the row and holds.
READMEs and pages show these rows and no others (workflows/tables.py).

- error: one number that does not scatter. It holds while it is no farther from `reference` (an exact answer, a measured
  value; 0 by default) than three times the published one.
- ensemble: what scatters. The mean of the test's members lies where a mean of so many is to be expected, given the published
  mean, standard deviation and n: Student's t, and a chance of a false alarm of 1e-5 for each figure.
- limit: what is to stay below a limit known beforehand (round-off, a conservation law); the limit is what is published.

Names hold no commas and no quotes.
"""
import csv
import fcntl
import math
import os
import pathlib

RESULTS = pathlib.Path(__file__).resolve().parents[2] / "results"
COLUMNS = ["name", "kind", "value", "unit", "reference", "n", "standard_deviation", "bound", "why"]
FALSE_ALARM = 1e-5  # of one ensemble figure
FACTOR = 3.0  # an error may grow to so many times the published one
RECORDING = os.environ.get("TSUNAGI_RECORD") == "1"


def rows(stage):
    """{name: row} of results/<stage>.csv."""
    path = RESULTS / f"{stage}.csv"
    if not path.exists():
        return {}
    with path.open(newline="") as file:
        return {row["name"]: row for row in csv.DictReader(file)}


def error_figure(stage, name, value, unit="", reference=0.0, why=""):
    if RECORDING:
        return _record(stage, name, "error", value, unit, reference, 1, 0.0, FACTOR * abs(value - reference), why)
    row = _published(stage, name, "error")
    if row is None:
        return False, f"{name}: results/{stage}.csv has no such row"
    bound = FACTOR * abs(float(row["value"]) - float(row["reference"]))
    holds = float(row["reference"]) == float(f"{reference:.6g}") and math.isfinite(value) and abs(value - reference) <= bound
    return holds, (f"{name}: {value:.6g} {unit}, published {row['value']}, reference {reference:.6g} "
                   f"(no farther from it than {bound:.3g})")


def ensemble_figure(stage, name, members, unit="", reference=0.0, why=""):
    members = [float(member) for member in members]
    count = len(members)
    mean = sum(members) / count
    if RECORDING:
        if count < 8:
            raise ValueError(f"{name}: {count} members do not tell a spread; record with 8 and more")
        spread = math.sqrt(sum((member - mean) ** 2 for member in members) / (count - 1))
        return _record(stage, name, "ensemble", mean, unit, reference, count, spread, _band(count, spread, 1), why)
    row = _published(stage, name, "ensemble")
    if row is None:
        return False, f"{name}: results/{stage}.csv has no such row"
    published, spread, n = float(row["value"]), float(row["standard_deviation"]), int(row["n"])
    band = _band(n, spread, count)
    holds = math.isfinite(mean) and abs(mean - published) <= band
    return holds, (f"{name}: {mean:.4g} {unit} in the mean of {count} ({', '.join(f'{member:.4g}' for member in members)}), "
                   f"published {published:.4g} (n = {n}, spread {spread:.2g}; within {band:.3g} but for one in {1 / FALSE_ALARM:.0e})")


def published_interval(stage, name):
    """Where the true mean of an ensemble figure lies, but for a chance of a false alarm: what a claim about it has to hold for."""
    row = _published(stage, name, "ensemble")
    if row is None:
        return -math.inf, math.inf
    half = _band(int(row["n"]), float(row["standard_deviation"]), math.inf)
    return float(row["value"]) - half, float(row["value"]) + half


def limit_figure(stage, name, value, limit, unit="", why=""):
    if RECORDING:
        return _record(stage, name, "limit", limit, unit, 0.0, 1, 0.0, limit, why)
    row = _published(stage, name, "limit")
    if row is None:
        return False, f"{name}: results/{stage}.csv has no such row"
    holds = float(row["value"]) == float(f"{limit:.6g}") and math.isfinite(value) and abs(value) <= limit
    return holds, f"{name}: {value:.3g} {unit} (published: below {row['value']})"


def _band(n, spread, count):
    """Half width about the published mean of n in which the mean of `count` further members lies."""
    from scipy.stats import t

    return float(t.ppf(1 - FALSE_ALARM / 2, n - 1)) * spread * math.sqrt(1 / n + 1 / count)


def _published(stage, name, kind):
    row = rows(stage).get(name)
    return row if row and row["kind"] == kind else None


def _record(stage, name, kind, value, unit, reference, n, spread, bound, why):
    if any(mark in name + unit + why for mark in ',"\n'):
        raise ValueError(f"{name}: a name, unit or reason holds a comma, a quote or a line break")
    RESULTS.mkdir(exist_ok=True)
    path = RESULTS / f"{stage}.csv"
    with (RESULTS / ".lock").open("w") as lock:  # tests record side by side
        fcntl.flock(lock, fcntl.LOCK_EX)
        table = rows(stage)
        table[name] = dict(zip(COLUMNS, [name, kind, f"{value:.6g}", unit, f"{reference:.6g}", n, f"{spread:.3g}", f"{bound:.3g}", why]))
        with path.open("w", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(table[key] for key in sorted(table))
    return True, f"{name}: {value:.6g} {unit} recorded (n = {n}, spread {spread:.3g})"
