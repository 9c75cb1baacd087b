"""The short form of one study: it ends well, leaves its table and its picture, and agrees with what is published of it.

What pages cite of a study stands in results/studies (make -C workflows <family> RECORD=1). Of a stability map every setting
that the short form tries too must have the published verdict.

    short_form.py PROGRAMS STUDY.py [further words of the study]
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

VERDICTS = {"stability_boussinesq.csv": "verdict", "stability_cmps.csv": "verdict", "stability_dem.csv": "outcome"}
PUBLISHED = pathlib.Path(__file__).resolve().parents[2] / "results/studies"


def check_published(table, rows, column):
    """The same verdict as published for every setting, the first two columns, of the short form."""
    with (PUBLISHED / table).open(newline="") as file:
        published = {tuple(map(float, list(row.values())[:2])): row[column] for row in csv.DictReader(file)}
    agreeing = 0
    for row in rows:
        settings = tuple(map(float, list(row.values())[:2]))
        if settings not in published:
            continue
        if row[column] != published[settings]:
            sys.exit(f"{table}: {row} is published as {published[settings]}")
        agreeing += 1
    if not agreeing:
        sys.exit(f"{table}: no setting of the short form is among the published ones")
    print(f"{table}: {agreeing} verdicts are those published")


programs, study, *words = sys.argv[1:]
with tempfile.TemporaryDirectory(prefix="tsunagi_study_") as folder:
    ended = subprocess.run(["/usr/bin/python3", study, "--bin", programs, "--out", folder, "--smoke", *words], text=True,
                           stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    print(ended.stdout)
    if ended.returncode != 0:
        sys.exit(f"{study}: exit status {ended.returncode}")
    tables, pictures = (list(pathlib.Path(folder).glob(pattern)) for pattern in ("*.csv", "*.png"))
    if not tables or not pictures:
        sys.exit(f"{study}: left {len(tables)} tables and {len(pictures)} pictures")
    name = pathlib.Path(study).stem
    if not any(table.name.startswith(name) for table in tables):
        sys.exit(f"{study}: its tables do not begin with its name, by which RECORD=1 keeps them: {[table.name for table in tables]}")
    for table in tables:
        rows = list(csv.DictReader(table.open()))
        print(f"{table.name}: {len(rows)} rows of {', '.join(rows[0]) if rows else 'nothing'}")
        if not rows:
            sys.exit(f"{table.name}: has no rows")
        if table.name == "cost_scene.csv":
            # All three levels of all three stages, as a user's scene has them, and an error wherever something finer ran.
            levels = [(row["stage"], row["level"]) for row in rows]
            if levels != [(stage, level) for stage in ("boussinesq", "cmps", "dem") for level in ("draft", "standard", "fine")]:
                sys.exit(f"{table.name}: its rows are {levels}")
            for row in rows:
                if row["against"] != "nothing finer" and not 0 < float(row["error"]) < 0.1:  # m; the waves are 0.06 m high
                    sys.exit(f"{table.name}: {row['stage']} {row['level']} has the error {row['error']}")
        if table.name in VERDICTS and (PUBLISHED / table.name).exists():
            check_published(table.name, rows, VERDICTS[table.name])
    for picture in pictures:
        if picture.read_bytes()[:8] != b"\x89PNG\r\n\x1a\n":
            sys.exit(f"{picture.name}: is not a picture")
