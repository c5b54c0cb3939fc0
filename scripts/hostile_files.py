#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How long the program takes, and how much memory, to refuse files made to do harm (those of tests/cli/hostile_files_test.cpp).

usage: hostile_files.py HOCTOMAP LOG
Prints a table; LOG is one that can be mapped, compressed as all are. Fails where an exit code is not the documented one, or 2 s or 200 MB are exceeded."""
import gzip
import hashlib
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time

SECONDS, BYTES = 2, 200 << 20
failed = []


def refuse(what, exit_code, *arguments):
    start = time.monotonic()
    process = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall, cpu, memory = time.monotonic() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024
    process.returncode = code = os.waitstatus_to_exitcode(status)
    fine = code == exit_code and wall <= SECONDS and memory <= BYTES
    print(f"| {what} | `{arguments[0]}` | {code} | {wall:.2f} s | {cpu:.2f} s | {memory / 1e6:.0f} MB |" + ("" if fine else " **not as promised** |"))
    if not fine:
        failed.append(what)


def forge(map, kind, change):
    """Puts other bytes into the last node's file, with a manifest that vouches for them."""
    manifest = map / "hierarchy.yaml"
    text = manifest.read_text()
    entry = list(re.finditer(rf'{kind}: {{path: "([^"]+)", bytes: \d+, sha256: "[0-9a-f]+"}}', text))[-1]
    file = map / entry[1]
    bytes = change(file.read_bytes())
    file.write_bytes(bytes)
    forged = f'{kind}: {{path: "{entry[1]}", bytes: {len(bytes)}, sha256: "{hashlib.sha256(bytes).hexdigest()}"}}'
    text = text.replace(entry[0], forged)
    manifest.write_text(re.sub(r"\A# sha256: .*\n", "", text))


def chain(_):
    return b"# Octomap OcTree binary file\nid OcTree\nsize 100000\nres 0.002\ndata\n" + b"\x03\x00" * 100_000


def not_a_number(bytes):
    at = bytes.index(b"data\n") + 5
    return bytes[:at] + struct.pack("<f", float("nan")) + bytes[at + 4:]


def maps(work, log):
    whole = work / "map"
    subprocess.run([PROGRAM, "build", "-q", "-i", log, "-o", whole, "--max-scans", "2"], check=True, stdout=subprocess.DEVNULL)
    for what, kind, change in [("chain of 100,000 nested nodes, `.bt` of 200 KB", "bt", chain), ("`.ot` cut by 7 bytes", "ot", lambda b: b[:-7]),
                               ("`.ot` that announces 4e9 nodes", "ot", lambda b: b"# Octomap OcTree file\nid OcTree\nsize 4000000000\nres 0.002\ndata\n"),
                               ("`.ot` with log-odds that are NaN", "ot", not_a_number)]:
        bad = work / "bad"
        shutil.copytree(whole, bad)
        forge(bad, kind, change)
        refuse(what, 4, "verify", bad)
        if kind == "ot":  # `.bt` is made for others
            refuse(what, 4, "diff", bad, bad)
        shutil.rmtree(bad)


def logs(work):
    with gzip.open(work / "bomb.rawlog", "wb") as bomb:
        for _ in range(100):
            bomb.write(bytes(1_000_000))
    (work / "null.rawlog").write_bytes(b"\x87nullptr\x88")
    (work / "clouds").mkdir()
    (work / "clouds/1.0.pcd").write_text("VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\n"
                                         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\nDATA ascii\n" + "7.5 7.5 7.5\n" * 3)
    (work / "clouds/poses.txt").write_text("1.0 0 0 0 0 0 0 1\n")
    subprocess.run([PROGRAM, "import", "pcd", work / "clouds", "-o", work / "cloud.rawlog", "-q"], check=True, stdout=subprocess.DEVNULL)
    plain = gzip.decompress((work / "cloud.rawlog").read_bytes())
    count = plain.index(struct.pack("<f", 7.5)) - 4
    (work / "count.rawlog").write_bytes(plain[:count] + b"\xff" * 4 + plain[count + 4:])
    for what, code, name in [("gz bomb, 100 MB in 100 KB", 6, "bomb"), ("the bytes `\\x87nullptr\\x88`", 3, "null"),
                             ("a count of points of 0xFFFFFFFF", 6, "count")]:
        refuse(what, code, "build", "-q", "-i", work / f"{name}.rawlog", "-o", work / "out")


def main():
    print("| file | command | exit code | clock | CPU | memory |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        maps(work, pathlib.Path(sys.argv[2]))
        logs(work)
    sys.exit(f"not as promised: {', '.join(failed)}" if failed else 0)


PROGRAM = sys.argv[1]
main()
