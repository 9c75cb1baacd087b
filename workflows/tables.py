"""Writes the tables of published figures into the pages that show them.

    tables.py            rewrites every table between  <!-- figures: results/cmps.csv [words] -->  and  <!-- end of figures -->
    tables.py --check    status 1 when one of them is not what its results file says

Words, separated by "|", choose the rows whose names hold one of them; without words all rows stand in the table.
"""
import csv
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"(<!-- figures: (\S+\.csv) ?(.*?) ?-->\n)(.*?)(<!-- end of figures -->)", re.S)


def shown(row):
    """One row of the page: figure, and what the test holds it to."""
    value, unit = f"{float(row['value']):.3g}", f" {row['unit']}" if row["unit"] else ""
    reference = float(row["reference"])
    if row["kind"] == "limit":
        return f"below {value}{unit}", "the same"
    if row["kind"] == "ensemble":
        figure = f"{value} (spread {float(row['standard_deviation']):.2g}, n = {row['n']}){unit}"
        return figure + (f"; reference {reference:.4g}" if reference else ""), "one member: ± " + row["bound"]
    return f"{value}{unit}" + (f"; reference {reference:.4g}" if reference else ""), "± " + row["bound"]


def table(path, words):
    with (ROOT / path).open(newline="") as file:
        chosen = [row for row in csv.DictReader(file) if not words or any(word.strip() in row["name"] for word in words.split("|"))]
    if not chosen:
        sys.exit(f"{path}: no row holds {words}")
    lines = ["| figure | published | bound of its test |", "| --- | --- | --- |"]
    for row in chosen:
        figure, bound = shown(row)
        lines.append(f"| {row['name']}{' (' + row['why'] + ')' if row['why'] else ''} | {figure} | {bound} |")
    return "\n".join(lines) + "\n"


stale = []
for page in [*ROOT.glob("*.md"), *ROOT.glob("*/README.md"), *ROOT.glob("docs/**/*.md")]:
    text = page.read_text()
    new = BLOCK.sub(lambda block: block[1] + table(block[2], block[3]) + block[5], text)
    if new != text:
        stale.append(str(page.relative_to(ROOT)))
        if "--check" not in sys.argv[1:]:
            page.write_text(new)
if "--check" in sys.argv[1:] and stale:
    sys.exit("tables that are not what their results say (run workflows/tables.py): " + ", ".join(stale))
