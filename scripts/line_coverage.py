#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lines of our own code that the tests come to, in a build as it is (line tables, -g1 is enough; optimised code merges some lines).

  scripts/line_coverage.py begin BUILD FOLDER      addresses of all programs of BUILD into FOLDER, and the library that watches them
  LD_PRELOAD=FOLDER/line_hits.so LINE_HITS=FOLDER ctest --test-dir BUILD       or single tests, as often as wanted
  scripts/line_coverage.py report BUILD FOLDER     a table by library; FOLDER/missing.txt has every line that nothing came to

Breakpoints instead of an instrumented build (scripts/coverage.sh, which counts decisions as well): a build less, and tests that
are hardly slower; processes that are killed or confined count, too.
"""
import array
import collections
import os
import pathlib
import re
import subprocess
import sys

ROW = re.compile(r"\S+\s+(\d+)\s+0x([0-9a-f]+)(?:\s+\d+|\[\d+\])?\s+x$")


def programs(build):
    """Programs of the build with line tables, by name."""
    found = {}
    for folder in ("apps", "tests"):
        for path in sorted((build / folder).rglob("*")):
            if path.is_file() and os.access(path, os.X_OK) and path.open("rb").read(4) == b"\x7fELF":
                found[path.name] = path
    return found


def code_of(program):
    """Addresses of the program's code; line tables also hold what the linker has thrown away, around 0."""
    for row in subprocess.run(["objdump", "-h", program], stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines():
        words = row.split()
        if len(words) > 3 and words[1] == ".text":
            return range(int(words[3], 16), int(words[3], 16) + int(words[2], 16))
    return range(0)


def lines_of(program, build, root):
    """(address, file, line) of every statement of our own code in a program."""
    code = code_of(program)
    output = subprocess.Popen(["objdump", "--dwarf=decodedline", program], stdout=subprocess.PIPE, text=True, errors="replace")
    file = None
    for row in output.stdout:
        row = row.rstrip()
        if row.endswith((":", ":[++]")) and " " not in row.removeprefix("CU: "):
            path = row.removeprefix("CU: ").removesuffix("[++]").removesuffix(":")
            full = pathlib.Path(os.path.normpath(build / path))
            file = str(full.relative_to(root)) if full.is_relative_to(root) else None
            if file and not file.startswith(("libs/", "apps/")):
                file = None
        elif file and (match := ROW.match(row)) and int(match[2], 16) in code:
            yield int(match[2], 16), file, int(match[1])


def begin(build, folder, root):
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run(["g++", "-std=c++20", "-O2", "-fPIC", "-shared", "-o", folder / "line_hits.so", root / "scripts/line_hits.cpp"],
                   check=True)
    for name, program in programs(build).items():
        rows = sorted(set(lines_of(program, build, root)))
        addresses = sorted({address for address, _, _ in rows})
        array.array("Q", addresses).tofile((folder / f"{name}.addresses").open("wb"))
        (folder / f"{name}.hits").write_bytes(bytes(len(addresses)))
        (folder / f"{name}.lines").write_text("".join(f"{address} {file} {line}\n" for address, file, line in rows))


def report(folder):
    seen = collections.defaultdict(bool)  # (file, line) -> whether anything came to it
    for table in folder.glob("*.lines"):
        addresses = array.array("Q")
        addresses.frombytes(table.with_suffix(".addresses").read_bytes())
        hits = dict(zip(addresses, table.with_suffix(".hits").read_bytes()))
        for row in table.read_text().splitlines():
            address, file, line = row.split()
            seen[file, int(line)] |= hits[int(address)] != 0
    sums = collections.defaultdict(lambda: [0, 0])
    missing = []
    for (file, line), hit in sorted(seen.items()):
        for key in ("/".join(file.split("/")[:2]), "all"):
            sums[key][0] += 1
            sums[key][1] += hit
        if not hit:
            missing.append(f"{file}:{line}")
    (folder / "missing.txt").write_text("\n".join(missing) + "\n")
    for key, (lines, run) in sums.items():
        print(f"{key:28} {run:6} of {lines:6} lines {100 * run / lines:6.1f} %")


def main():
    verb, build, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).resolve()
    if verb == "begin":
        begin(build, folder, pathlib.Path(__file__).resolve().parent.parent)
    else:
        report(folder)


main()
