"""`coupler run` and `coupler status` end with the answer: blocks moved, wires broken, largest tension."""
import re

from harness import *


@test
def the_answer_is_that_of_run_json(folder):
    ended = run("coupler", "run", SCENES / "small.toml", "--set", "time.end=4.0", "--out", folder / "chain").expect_done()
    status = run("coupler", "status", folder / "chain").expect_done()
    figures = run_folder.read_run(folder / "chain/blocks")["figures"]
    for text in (ended.stdout, status.stdout):
        answer = text.strip().splitlines()[-1]
        print(f"    {answer}")
        numbers = re.match(r"answer: of (\d+) free blocks (\d+) moved beyond 0.25 of their length, (\d+) beyond 0.5, (\d+) beyond 1 "
                           r"\(N_od ([\d.e-]+)\); (\d+) of (\d+) wires broke, largest tension ([\d.e-]+) N, ([\d.e-]+) of breaking$", answer)
        check(numbers is not None, f"the last line is no answer: {answer}")
        damage, wires = figures["damage"], figures["wires"]
        wanted = [damage["free_blocks"], damage["beyond_quarter_length"], damage["beyond_half_length"], damage["beyond_length"], damage["number"],
                  wires["broken"], wires["count"], wires["largest_tension"], wires["largest_share_of_breaking"]]
        for said, figure in zip(numbers.groups(), wanted):
            check(abs(float(said) - figure) <= 0.01 * abs(figure), f"said {said}, run.json has {figure}: {answer}")
    check(figures["damage"]["free_blocks"] == 12, "three rows of four; the row behind them is fixed")


main()
