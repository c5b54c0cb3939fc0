# SPDX-License-Identifier: BSD-3-Clause
"""Runs what documents tell their readers to type: the lines of all blocks marked `sh`, in order, in a folder of their own with the
configurations, the demo log, and small inputs by the names the documents use. `sh long`: only with --long. `sh external`: needs data or programs
that a test does not have.
Usage: run_commands.py HOCTOMAP HELPER SOURCES [--long] [--dry] DOCUMENT ..."""
import os, pathlib, re, shlex, subprocess, sys, tempfile

import small_data

program, helper, sources = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
flags = {word for word in sys.argv[4:] if word.startswith('--')}
documents = [pathlib.Path(word).resolve() for word in sys.argv[4:] if not word.startswith('--')]


def blocks(document):
    """(info string, number of the first line, lines) of every fenced block."""
    lines = document.read_text().splitlines()
    at = 0
    while at < len(lines):
        fence = re.match(r'(\s*)```(.*)', lines[at])
        if fence:
            end = next(i for i in range(at + 1, len(lines)) if lines[i].strip() == '```')
            yield fence[2].strip(), at + 2, lines[at + 1:end]
            at = end
        at += 1


def prepare(folder):
    small_data.make(folder)
    for name in ('configs', 'rawlogs', 'scripts'):
        (folder / name).symlink_to(sources / name)
    commands = folder / 'bin'
    commands.mkdir()
    (commands / 'hoctomap').write_text(f'#!/bin/sh\nHOCTOMAP_MRPT={shlex.quote(str(helper))} exec {shlex.quote(str(program))} "$@"\n')
    (commands / 'hoctomap').chmod(0o755)
    environment = dict(os.environ, PATH=f'{commands}:{os.environ["PATH"]}')
    for day, seed in (('monday', 15), ('friday', 16)):
        subprocess.run(['hoctomap', 'simulate', '-q', '-c', 'configs/scenes/demo.ini', '-o', f'{day}.rawlog', '--set', f'simulation.seed={seed}'],
                       cwd=folder, env=environment, check=True, stdout=subprocess.DEVNULL)
    return environment


def check(document):
    failures, ran = [], 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        environment = prepare(folder)
        for info, first, lines in blocks(document):
            if info == '' and any(line.strip().startswith('hoctomap ') for line in lines) and '--dry' not in flags:
                failures.append(f'{document.name}:{first}: a block with commands is not marked `sh`')
            if info != 'sh' and not (info == 'sh long' and '--long' in flags):
                continue
            for number, line in enumerate(lines, first):
                if not line.strip():
                    continue
                done = subprocess.run(['bash', '-euo', 'pipefail', '-c', line.strip()], cwd=folder, env=environment, text=True,
                                      capture_output=True, stdin=subprocess.DEVNULL)
                ran += 1
                if done.returncode:
                    failures.append(f'{document.name}:{number}: exit {done.returncode}: {line.strip()}\n{done.stderr.strip()[-600:]}')
    print(f'{document.name}: {ran} commands')
    return failures


problems = [failure for document in documents for failure in check(document)]
print('\n'.join(problems))
sys.exit(1 if problems else 0)
