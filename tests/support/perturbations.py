"""Which perturbations of the first state a test runs: those of an ordinary run, or others, which `./workflows/test --shake` asks for.

TSUNAGI_PERTURBATION=k in the environment moves every seed by 1000 k: a verdict that differs then hangs on chance.
"""
import os

FIRST = 1000 * int(os.environ.get("TSUNAGI_PERTURBATION", "0"))


def members(count):
    """Seeds of an ensemble of `count` runs."""
    return list(range(FIRST, FIRST + count))


def perturbed(seed=None):
    """Words of the command line that give a run its seed; without one, that of the first member."""
    seed = FIRST if seed is None else seed
    return ["--set", f"perturbation={seed}"] if seed else []
