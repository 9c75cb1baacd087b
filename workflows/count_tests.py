"""Adds up CTest's reports and prints the closing line of workflows/test."""
import argparse
import xml.etree.ElementTree

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("reports", nargs="+", help="JUnit files written by ctest --output-junit")
parser.add_argument("--format", choices=["passed", "failed"], required=True, help="result of the clang-format check")
arguments = parser.parse_args()

passed, failed, skipped = (1, 0, 0) if arguments.format == "passed" else (0, 1, 0)
names = [] if arguments.format == "passed" else ["clang-format"]
for report in arguments.reports:
    for case in xml.etree.ElementTree.parse(report).getroot().iter("testcase"):
        if case.find("failure") is not None or case.get("status") == "fail":
            failed += 1
            names.append(case.get("name"))
        elif case.find("skipped") is not None:
            skipped += 1
        else:
            passed += 1
for name in names:
    print(f"failed: {name}")
print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
