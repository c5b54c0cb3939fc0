#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lines, and outcomes of conditions, by library from gcovr's JSON; below, every line of which one outcome was not seen."""
import collections
import json
import sys


def outcomes(line):
    """Outcomes of the conditions of a line, and how many of them were seen; nothing where no decision stands.

    gcov's branches come in pairs, one a condition. Pairs of which one way is an exception are calls; gcovr's own counts of decisions are
    wrong where `if` and what follows share a line."""
    if not line.get("gcovr/decision"):
        return 0, 0
    pairs = list(zip(line["branches"], line["branches"][1:]))
    number = seen = index = 0
    while index < len(pairs):
        one, other = pairs[index]
        if one["fallthrough"] == other["fallthrough"]:
            index += 1
            continue
        if not one["throw"] and not other["throw"]:
            number += 2
            seen += (one["count"] > 0) + (other["count"] > 0)
        index += 2
    return number, seen


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
            all_of_them, seen = outcomes(line)
            total[2] += all_of_them
            total[3] += seen
            if seen < all_of_them:
                missing.append(f"{name}:{line['line_number']}: {seen} of {all_of_them} outcomes")
    sums["all"] = [sum(column) for column in zip(*sums.values())]
    for name, (lines, run, decisions, seen) in sums.items():
        print(f"{name:24} lines {run:6} of {lines:6} {100 * run / max(lines, 1):6.1f} %   "
              f"outcomes {seen:5} of {decisions:5} {100 * seen / max(decisions, 1):6.1f} %")
    print()
    print("\n".join(missing))


main()
