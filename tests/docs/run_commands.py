# SPDX-License-Identifier: BSD-3-Clause
"""Runs what a document tells its readers to type: the lines of all blocks marked `sh` and `sh small` (documents.py), in order, in a folder with the
configurations, the demo log, and small inputs by the names the documents use.
Usage: run_commands.py HOCTOMAP HELPER HOCTOMAP_EXPERIMENTS SOURCES DOCUMENT"""
import os, pathlib, shlex, shutil, subprocess, sys, tempfile

import small_data
from documents import blocks, small

program, helper, experiments, sources, document = (pathlib.Path(path).resolve() for path in sys.argv[1:6])


def prepare(top):
    """@returns the folder, which looks like a clone beside `shared`, and the environment of a reader."""
    folder = top / 'clone'
    folder.mkdir()
    for name in ('configs', 'rawlogs', 'scripts', 'tests', 'workflows'):
        (folder / name).symlink_to(sources / name)
    shutil.copytree(sources / 'docs', folder / 'docs')  # scripts/insert_figures.sh changes pages
    commands = top / 'bin'
    commands.mkdir()
    for name, path in (('hoctomap', program), ('hoctomap-experiments', experiments)):
        (commands / name).write_text(f'#!/bin/sh\nHOCTOMAP_MRPT={shlex.quote(str(helper))} exec {shlex.quote(str(path))} "$@"\n')
        (commands / name).chmod(0o755)
    environment = dict(os.environ, PATH=f'{commands}:{os.environ["PATH"]}')

    def hoctomap(*arguments):
        subprocess.run(['hoctomap', *arguments], cwd=folder, env=environment, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    small_data.make(folder)
    text = document.read_text()
    if 'monday' in text:
        for day, seed in (('monday', 15), ('friday', 16)):
            hoctomap('simulate', '-q', '-c', 'configs/scenes/demo.ini', '-o', f'{day}.rawlog', '--set', f'simulation.seed={seed}')
    if '../shared' in text:
        small_data.make_shared(top / 'shared/data', hoctomap)
    return folder, environment


if not shutil.which('snakemake') and any(line.startswith('snakemake ') for info, _, lines in blocks(document) if info == 'sh' for line in lines):
    print('skipped: snakemake is not installed (scripts/install_dependencies.sh --workflows)')
    sys.exit(77)
failures, ran = [], 0
with tempfile.TemporaryDirectory() as name:
    folder, environment = prepare(pathlib.Path(name))
    for info, first, lines in blocks(document):
        if info.startswith('yaml '):
            (folder / info.split()[1]).write_text('\n'.join(lines) + '\n')  # a file that commands below want
        if info not in ('sh', 'sh small'):
            continue
        for number, line in enumerate(lines, first):
            if not line.strip():
                continue
            command = small(line.strip()) if info == 'sh small' else line.strip()
            done = subprocess.run(['bash', '-euo', 'pipefail', '-c', command], cwd=folder, env=environment, text=True, capture_output=True,
                                  stdin=subprocess.DEVNULL)
            ran += 1
            if done.returncode:
                failures.append(f'{document.name}:{number}: exit {done.returncode}: {command}\n{done.stderr.strip()[-600:]}')
print(f'{document.name}: {ran} commands')
print('\n'.join(failures))
sys.exit(1 if failures or not ran else 0)
