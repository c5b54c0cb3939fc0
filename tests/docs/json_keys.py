# SPDX-License-Identifier: BSD-3-Clause
"""Compares what --json prints with docs/json.md, key by key. Usage: json_keys.py HOCTOMAP HELPER SOURCES"""
import json, os, pathlib, re, subprocess, sys, tempfile

program, helper, sources = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
environment = dict(os.environ, HOCTOMAP_MRPT=str(helper))
problems = []


def run(*arguments):
    done = subprocess.run([program, *map(str, arguments)], env=environment, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f'{arguments}: exit {done.returncode}: {done.stderr}')
    return done.stdout


def documented():
    """Keys by the first column of the page's tables, in their order; those in a clause that says when are optional."""
    keys = {}
    for line in (sources / 'docs/json.md').read_text().splitlines():
        cells = [cell.strip() for cell in line.strip().strip('|').split('|')]
        if line.startswith('| `') and len(cells) == 2:
            keys[re.sub(r'`', '', cells[0])] = re.findall(r'`([a-z0-9_]+)`', re.sub(r'\(.*?\)', '', cells[1]))
    return keys


page = documented()


def compare(what, entry, optional=()):
    expected = page[what]
    order = [key for key in expected if key in entry]
    if [key for key in entry if key in expected] != order:
        problems.append(f'{what}: the keys come as {list(entry)}')
    for key in entry:
        if key not in expected:
            problems.append(f'{what}: `{key}` is not in docs/json.md')
    for key in expected:
        if key not in entry and key not in optional:
            problems.append(f'{what}: `{key}` is missing')


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    log, scene, before = folder / 'a.rawlog', folder / 'scene', folder / 'before'
    run('simulate', '-q', '-c', sources / 'configs/scenes/occlusion.ini', '-o', log)
    run('build', '-q', '-i', log, '-o', scene)
    run('build', '-q', '-i', log, '-o', before, '--max-scans', '4')
    info = json.loads(run('info', log, '--json'))
    compare('info LOG', info)
    for sensor in info['sensors']:
        compare('sensors', sensor, optional=('width', 'height'))
    for source in info['pose_sources']:
        compare('pose_sources', source)
    compare('build --estimate', json.loads(run('build', '--estimate', '--json', '-i', log)))
    compare('info DIR', json.loads(run('info', scene, '--json')))
    compare('verify DIR', json.loads(run('verify', scene, '--json')))
    life = json.loads(run('explain', scene, 2, '--json'))
    compare('explain DIR NODE', life)
    compare('events of explain', life['events'][0])
    compare('evidence of explain', life['evidence'][0])
    if 'removed_scan' in json.loads(run('explain', scene, 1, '--json')):
        problems.append('explain: a living node was removed')
    changes = json.loads(run('diff', before, scene, '--json'))
    compare('diff A B', changes)
    compare('a, b of diff', changes['a'])
    compare('counts of diff', changes['counts'])
    if changes['counts']['added'] != 1 or changes['counts']['removed'] != 1:
        problems.append(f'diff: {changes["counts"]}')
    for change in changes['changes']:
        compare('changes of diff', change, optional=('motion', 'motion_matrix', 'carried', 'detail'))
    answer = json.loads(run('query', scene, '--point', '0,0,0.8', '--json'))
    if list(answer)[:2] != ['question', 'numbers']:
        problems.append(f'query: {list(answer)}')
print('\n'.join(problems))
sys.exit(1 if problems else 0)
