#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the maps of all logs will take, before one is made.
Usage: estimates.py TABLE PART_SCANS > estimates.csv"""
import csv, json, pathlib, sys

import log_table

COLUMNS = ['name', 'scans', 'parts', 'points', 'cpu_s', 'peak_memory_bytes', 'disk_bytes']


def main(table, part_scans):
    out = csv.DictWriter(sys.stdout, COLUMNS, extrasaction='ignore', lineterminator='\n')
    out.writeheader()
    for name in log_table.read(table):
        estimate = json.loads(pathlib.Path(name, 'estimate.json').read_text()).get('result')
        out.writerow(dict(estimate or {}, name=name, parts=log_table.part_count(estimate, part_scans)))


main(*sys.argv[1:])
