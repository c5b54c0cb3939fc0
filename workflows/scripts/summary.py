#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Sums up how the steps of all logs ended.
Usage: summary.py TABLE SUMMARY.csv SUMMARY.html COSTS.csv
       summary.py --failed SUMMARY.csv       prints a line about the logs that failed"""
import csv, html, json, pathlib, sys

import log_table

CHANGES = ['added', 'removed', 'moved', 'changed', 'unobservable']
COLUMNS = ['name', 'place', 'status', 'step', 'exit_code', 'error', 'scans', 'parts', 'nodes', 'tables', 'objects', 'occupied_voxels',
           'octree_bytes', 'since', *CHANGES]
COSTS = ['name', 'step', 'scans', 'points', 'wall_s', 'cpu_s', 'max_rss_mb', 'estimated_cpu_s', 'estimated_memory_mb', 'disk_bytes', 'estimated_disk_bytes']


def outcome(path):
    path = pathlib.Path(path)
    return json.loads(path.read_text()) if path.exists() else None


def parts_of(name):
    return sorted(pathlib.Path(name, 'parts').glob('*.json'), key=lambda path: int(path.stem))


def summary_row(visit, previous):
    tree, estimate = outcome(f'{visit.name}/tree.json'), outcome(f'{visit.name}/estimate.json')
    row = dict.fromkeys(COLUMNS, '')
    row.update(name=visit.name, place=visit.place, status='ok' if tree['exit_code'] == 0 else 'failed', since=previous or '')
    if tree['exit_code']:
        row.update(step=tree['step'], exit_code=tree['exit_code'], error=tree['error'])
    if 'result' in estimate:
        row['scans'] = estimate['result']['scans']
    if tree['exit_code'] == 0:
        nodes = tree['result']['nodes']
        labels = [node['label'] for node in nodes]
        row.update(parts=len(parts_of(visit.name)), nodes=len(nodes), tables=labels.count('table'), objects=labels.count('object'),
                   occupied_voxels=sum(node['occupied_voxels'] for node in nodes),
                   octree_bytes=sum(node['memory_bytes'] for node in nodes))
    changes = outcome(f'{visit.name}/changes.json') if previous else None
    if changes and changes['exit_code'] == 0:
        row.update({kind: changes['result']['counts'][kind] for kind in CHANGES})
    return row


def bytes_below(folder):
    return sum(path.stat().st_size for path in pathlib.Path(folder).rglob('*') if path.is_file() and not path.is_symlink())


def cost_rows(visit):
    estimated = (outcome(f'{visit.name}/estimate.json') or {}).get('result')
    parts = parts_of(visit.name)
    others = [f'{visit.name}/{step}.json' for step in ('import', 'estimate', 'map', 'verify', 'report', 'changes')]
    for path in [*parts, *map(pathlib.Path, others)]:
        done = outcome(path)
        if not done or not done['ran']:
            continue
        row = dict.fromkeys(COSTS, '')
        row.update(name=visit.name, step=done['step'], **{key: done[key] for key in ('wall_s', 'cpu_s', 'max_rss_mb')})
        if path in parts and estimated:
            row['disk_bytes'] = bytes_below(path.with_suffix(''))
            if len(parts) == 1:
                row.update(scans=estimated['scans'], points=estimated['points'], estimated_cpu_s=round(estimated['cpu_s'], 3),
                           estimated_memory_mb=round(estimated['peak_memory_bytes'] / 1e6, 1), estimated_disk_bytes=estimated['disk_bytes'])
        yield row


def write_csv(path, columns, rows):
    with open(path, 'w', newline='', encoding='utf-8') as file:
        writer = csv.DictWriter(file, columns, lineterminator='\n')
        writer.writeheader()
        writer.writerows(rows)


def link(name, file, text):
    """To a file in the folder of a log, if it is there."""
    text = html.escape(str(text))
    return f'<a href="{html.escape(name)}/{file}">{text}</a>' if pathlib.Path(name, file).exists() else text


STYLE = '''body { font: 15px/1.4 system-ui, sans-serif; margin: 2rem; color: #222; background: #fff }
table { border-collapse: collapse } th, td { padding: .25rem .7rem; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap }
th:nth-child(-n+3), td:nth-child(-n+3) { text-align: left } td.error { text-align: left; white-space: normal; color: #a00 } tr.failed td { background: #fff1ee }
caption { text-align: left; padding-bottom: .7rem }'''


def page(rows):
    failed = sum(row['status'] != 'ok' for row in rows)
    lines = ['<!DOCTYPE html>', '<html lang="en"><head><meta charset="utf-8"><title>Maps of logs</title>', f'<style>{STYLE}</style></head><body>',
             f'<h1>Maps of {len(rows)} logs</h1>', f'<table><caption>{len(rows) - failed} mapped, {failed} failed. Changes are those since the visit before of the same place.</caption>',
             '<tr><th>log</th><th>place</th><th>status</th><th>scans</th><th>nodes</th><th>tables</th><th>objects</th>'
             '<th>since</th>' + ''.join(f'<th>{kind}</th>' for kind in CHANGES) + '</tr>']
    for row in rows:
        cells = [link(row['name'], 'report.html', row['name']), html.escape(row['place']), row['status'], row['scans']]
        if row['status'] == 'ok':
            cells += [row['nodes'], row['tables'], row['objects'], link(row['name'], 'changes.html', row['since']), *(row[kind] for kind in CHANGES)]
            lines.append('<tr>' + ''.join(f'<td>{cell}</td>' for cell in cells) + '</tr>')
        else:
            text = html.escape(f'{row["step"]}, exit code {row["exit_code"]}: {row["error"]}')
            lines.append('<tr class="failed">' + ''.join(f'<td>{cell}</td>' for cell in cells) + f'<td class="error" colspan="{4 + len(CHANGES)}">{text}</td></tr>')
    return '\n'.join([*lines, '</table></body></html>', ''])


def print_failed(summary):
    with open(summary, newline='', encoding='utf-8') as file:
        rows = list(csv.DictReader(file))
    failed = [row['name'] for row in rows if row['status'] != 'ok']
    if failed:
        print(f'{len(failed)} of {len(rows)} logs failed: {", ".join(failed)}; why stands in {summary}', file=sys.stderr)


if sys.argv[1] == '--failed':
    print_failed(sys.argv[2])
else:
    table, summary_csv, summary_html, costs_csv = sys.argv[1:]
    visits = log_table.read(table)
    previous = log_table.previous_visits(visits)
    rows = [summary_row(visit, previous.get(visit.name)) for visit in visits.values()]
    write_csv(summary_csv, COLUMNS, rows)
    pathlib.Path(summary_html).write_text(page(rows), encoding='utf-8')
    write_csv(costs_csv, COSTS, [row for visit in visits.values() for row in cost_rows(visit)])
