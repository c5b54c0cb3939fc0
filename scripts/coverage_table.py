#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lines and decisions by library from gcovr's JSON; below, every decision of which one outcome was not seen."""
import collections
import json
import sys


def outcomes(decision):
    """Outcomes of a decision, and how many of them were seen."""
    if decision["type"] == "conditional":
        return 2, (decision["count_true"] > 0) + (decision["count_false"] > 0)
    if decision["type"] == "switch":
        return 1, int(decision["count"] > 0)
    return 0, 0  # several on a line: gcovr cannot tell them apart


def main():
    sums = collections.defaultdict(lambda: [0, 0, 0, 0])
    missing = []
    for file in json.load(open(sys.argv[1]))["files"]:
        name = file["file"]
        total = sums["/".join(name.split("/")[:2])]
        for line in file["lines"]:
            if line.get("gcovr/noncode"):
                continue
            total[0] += 1
            total[1] += line["count"] > 0
            decision = line.get("gcovr/decision")
            if not decision:
                continue
            all_of_them, seen = outcomes(decision)
            total[2] += all_of_them
            total[3] += seen
            if seen < all_of_them:
                missing.append(f"{name}:{line['line_number']}: {decision['type']}, {seen} of {all_of_them}")
    sums["all"] = [sum(column) for column in zip(*sums.values())]
    for name, (lines, run, decisions, seen) in sums.items():
        print(f"{name:24} lines {run:6} of {lines:6} {100 * run / max(lines, 1):6.1f} %   "
              f"decisions {seen:5} of {decisions:5} {100 * seen / max(decisions, 1):6.1f} %")
    print()
    print("\n".join(missing))


main()
