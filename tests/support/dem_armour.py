"""A small armour for tests of runs that go on from others: 3 rows of 4 blocks before a wall, a fixed row behind them."""

ROWS, COLUMNS = 3, 4


def small_armour(end, linked_row):
    """The scene to time `end` (s), in windows of 0.25 s, with one row linked along the breakwater."""
    return f"""
[time]
end = {end}
window = 0.25
[dem]
width = 0.2
planes = [{{ point = [1.0, 0.0, 0.0], normal = [-1.0, 0.0, 0.0] }}]
[dem.blocks]
shape = "beehive96"
rows = {ROWS}
columns = {COLUMNS}
origin = [0.925, 0.025]
pitch = [0.05, 0.05]
fixed_rows = 1
[dem.mound]
profile = [[0.6, -0.2], [1.0, -0.2]]
roughness = 0.008
[wires]
psi = 0.3
[[wires.along]]
rows = [{linked_row}]
"""
