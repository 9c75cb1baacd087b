"""Mirror images and quarter turns of a scene give mirrored and turned results; `dem.skin` changes no bit of them.

Ten scenes of what blocks can meet: fixed spheres and their rims, other blocks, fixed blocks, planes, a mound and its edge, wires, water. The turned
scene adds the same numbers in another order, so that contacts amplify rounding: runs are of a few impacts.
"""
import itertools

import numpy as np

from harness import *

D = 0.008


def diagonal(*signs):
    return np.diag(np.array(signs, dtype=float))


def quarter_turn(axis, times=1):
    i, j = (axis + 1) % 3, (axis + 2) % 3
    turn = np.eye(3)
    turn[i, i] = turn[j, j] = 0
    turn[i, j], turn[j, i] = -1, 1
    return np.linalg.matrix_power(turn, times)


ABOUT_VERTICAL = [diagonal(-1, 1, 1), diagonal(1, -1, 1), quarter_turn(2), quarter_turn(2, 2), quarter_turn(2, 3)]
ALL = ABOUT_VERTICAL + [diagonal(1, 1, -1), quarter_turn(0), quarter_turn(0, 3), quarter_turn(1), quarter_turn(1, 3)]


def quaternion_of(turn):
    """w, x, y, z of a proper rotation by less than half a turn, or by half a turn about an axis of the frame."""
    w = np.sqrt(max(0.0, 1 + np.trace(turn))) / 2
    if w > 1e-6:
        return np.array([w, (turn[2, 1] - turn[1, 2]) / (4 * w), (turn[0, 2] - turn[2, 0]) / (4 * w), (turn[1, 0] - turn[0, 1]) / (4 * w)])
    return np.concatenate([[0.0], np.sqrt(np.maximum(0, (1 + np.diag(turn)) / 2))])


def rotation_of(quaternion):
    w, x, y, z = np.array(quaternion, dtype=float) / np.linalg.norm(quaternion)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Scene:
    """Blocks and what they meet; `image` gives the scene as `turn` (a mirror image or a rotation) makes it."""

    def __init__(self, end, blocks, gravity=(0, 0, 0), fixed=(), planes=(), mound="", rest="dry = true", current=(0, 0, 0), after="", turns=ALL):
        self.end, self.blocks, self.gravity, self.fixed, self.planes, self.mound = end, blocks, gravity, fixed, planes, mound
        self.rest, self.current, self.after, self.turns = rest, current, after, turns

    def image(self, turn, skin=0.15):
        def along(vector):
            return [float(v) for v in turn @ np.array(vector, dtype=float)]

        handedness = np.linalg.det(turn)
        lines = ["[time]", f"end = {self.end}", f"window = {self.end}", "[dem]", self.rest, f"skin = {skin}", "output_interval = 1e-3",
                 f"gravity = {along(self.gravity)}"]
        if any(self.current):
            lines.append(f"current = {along(self.current)}")
        if len(self.fixed):
            lines.append(f"fixed_spheres = {[along(centre) for centre in self.fixed]}")
        for point, normal in self.planes:
            lines += ["[[dem.planes]]", f"point = {along(point)}", f"normal = {along(normal)}"]
        lines.append(self.mound)
        for block in self.blocks:
            # Shapes here are their own mirror images in the planes of their axes: a mirrored block is a turned one.
            orientation = rotation_of(block.get("turn", [1, 0, 0, 0]))
            turned = turn @ orientation @ (turn.T if handedness < 0 else np.eye(3))
            if handedness > 0 and block["shape"] == "sphere":
                turned = np.eye(3)
            lines += ["[[dem.block]]", f"shape = \"{block['shape']}\"", f"position = {along(block['at'])}", f"velocity = {along(block.get('speed', [0, 0, 0]))}",
                      f"angular_velocity = {[float(v) for v in handedness * (turn @ np.array(block.get('spin', [0, 0, 0]), dtype=float))]}",
                      f"orientation = {[float(v) for v in quaternion_of(turned)]}", f"fixed = {str(block.get('fixed', False)).lower()}"]
        lines += ["[dem.packing]", 'method = "none"', self.after]
        return "\n".join(lines) + "\n"


def sphere(at, speed=(0, 0, 0), **more):
    return {"shape": "sphere", "at": at, "speed": speed, **more}


TURNED = [0.9, 0.2, -0.3, 0.1]
PLATE = [(i * D, j * D, 0.0) for i, j in itertools.product(range(-2, 3), range(-2, 3))]
WALL = [((0, 0, 0), (0, 0, 1)), ((0.05, 0, 0), (-1, 0, 0.2))]
FLAT_MOUND = "[dem.mound]\nprofile = [[-0.06, -0.2], [0.06, -0.2]]\ny = [-0.06, 0.06]\nroughness = 0.0\n"

SCENES = {
    "a sphere meets a fixed one head-on": Scene(0.03, [sphere((-0.0085, 0, 0), (0.1, 0, 0))], fixed=[(0, 0, 0)], rest="dry = true\nfriction = 0.0\ndamping_ratio = 0.0"),
    "grazing the rim of a plate of fixed spheres": Scene(0.05, [{"shape": "beehive24", "at": (-0.047, 0.002, 0.006), "speed": (0.3, 0.02, -0.05), "turn": TURNED}], fixed=PLATE),
    "a block falls over the corner of such a plate": Scene(0.08, [{"shape": "cube27", "at": (-0.019, -0.018, 0.019), "turn": TURNED}], gravity=(0, 0, -9.81), fixed=PLATE),
    "two blocks collide askew": Scene(0.03, [{"shape": "beehive96", "at": (-0.028, 0.004, 0), "speed": (0.4, 0, 0.05), "turn": TURNED},
                                             {"shape": "beehive24", "at": (0.028, -0.004, 0.003), "speed": (-0.4, 0.1, 0), "spin": (3, -2, 8)}]),
    "a row of spheres against a fixed block": Scene(0.05, [sphere((-0.040, 0.001, 0), (0.5, 0, 0)), sphere((-0.030, 0, 0.001)), {"shape": "ring96", "at": (0.005, 0, 0), "fixed": True}]),
    "a block slides and tumbles into a leaning wall": Scene(0.06, [{"shape": "cube27", "at": (0.015, 0.003, 0.013), "speed": (0.4, 0.05, 0), "spin": (0, 3, 1)}], gravity=(0, 0, -9.81), planes=WALL),
    "two spheres fly apart on a wire": Scene(0.1, [sphere((-0.01, 0, 0), (-0.1, 0.02, 0)), sphere((0.01, 0.001, 0.002), (0.1, 0, 0.01))], after="[[wires.link]]\nblocks = [1, 2]"),
    "a block at the edge of a mound": Scene(0.06, [{"shape": "beehive24", "at": (-0.055, -0.055, -0.178), "turn": [0.98, 0.1, -0.15, 0]}], gravity=(0, 0, -9.81), mound=FLAT_MOUND, turns=ABOUT_VERTICAL),
    "blocks in a current on the mound": Scene(0.06, [{"shape": "beehive24", "at": (-0.03, 0.0, -0.183)}, {"shape": "cube27", "at": (0.02, 0.01, -0.185)}], gravity=(0, 0, -9.81),
                                              mound=FLAT_MOUND, rest="", current=(1.1, 0.4, 0), turns=ABOUT_VERTICAL),
    "a sphere comes to a block at rest, which may sleep": Scene(0.25, [{"shape": "cube27", "at": (0, 0, 0.0119)}, sphere((-0.035, 0.0, 0.004), (0.2, 0, 0))], gravity=(0, 0, -9.81), planes=WALL[:1],
                                                                after="[dem.sleeping]\nrest_time = 0.01"),
}


def motion(folder, name, scene, turn, skin=0.15):
    out = folder / name
    run("dem", "run", write_scene(folder, scene.image(turn, skin), f"{name}.toml"), "--out", out, "--quiet").expect_done()
    return {dataset: run_folder.read_series(out, dataset)[1] for dataset in
            ("/blocks/position", "/blocks/velocity", "/blocks/angular_velocity", "/blocks/orientation", "/energy", "/blocks/asleep")}


@test
def mirrored_and_turned(folder):
    worst = 0.0
    for number, (title, scene) in enumerate(SCENES.items()):
        plain = motion(folder, f"s{number}", scene, np.eye(3))
        struck = np.abs(np.diff(plain["/blocks/velocity"], axis=0)).max()
        check(struck > 1e-3, f"{title}: nothing happens")
        off = []
        for k, turn in enumerate(scene.turns):
            image = motion(folder, f"s{number}_{k}", scene, turn)
            off.append(np.abs(image["/blocks/position"] - plain["/blocks/position"] @ turn.T).max() / D)
        print(f"    {title}: {max(off):.1e} d in {len(off)} images")
        worst = max(worst, *off)
    check_below("largest difference of places", worst, 1e-9, "d", "rounding, amplified by a few impacts")


@test
def rebounds_from_every_side(folder):
    scene = SCENES["a sphere meets a fixed one head-on"]
    for k, turn in enumerate([np.eye(3), *scene.turns]):
        velocity = motion(folder, f"r{k}", scene, turn)["/blocks/velocity"][-1, 0] @ turn
        check_below(f"speed after the elastic hit, image {k}, against -0.1", velocity[0] + 0.1, 2e-4, "m/s", "the step's error")


@test
def skin_changes_no_bit(folder):
    for number, (title, scene) in enumerate(SCENES.items()):
        plain = motion(folder, f"p{number}", scene, np.eye(3))
        for skin in (0.002, 0.03, 0.6, 2.0):
            other = motion(folder, f"p{number}_{skin}", scene, np.eye(3), skin)
            for dataset, values in plain.items():
                check(np.array_equal(values, other[dataset]), f"{title}: {dataset} differs with skin = {skin} d")


main()
