"""The table and the picture of a stability map: one verdict for every pair of two settings."""
import csv


def write(rows, path, x, y, colours, xlabel, ylabel, title):
    """Writes path.csv with all of `rows` (dicts with a "verdict") and path.png over the columns `x` and `y`."""
    table, picture = path.with_suffix(".csv"), path.with_suffix(".png")
    with open(table, "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    figure, axis = pyplot.subplots(figsize=(5.5, 4))
    for verdict, colour in colours.items():
        shown = [row for row in rows if row["verdict"] == verdict]
        axis.loglog([row[x] for row in shown], [row[y] for row in shown], "s", color=colour, markersize=12, label=verdict)
    axis.set(xlabel=xlabel, ylabel=ylabel, title=title)
    axis.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(picture, dpi=130)
    print(picture)
