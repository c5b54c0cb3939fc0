# SPDX-License-Identifier: BSD-3-Clause
"""Every command in every document is run by a test (run_commands.py) or on the short list of what runs elsewhere (documents.py), and commands named in
prose exist, with their options. Usage: check_marks.py HOCTOMAP HOCTOMAP_EXPERIMENTS SOURCES"""
import functools, json, pathlib, re, subprocess, sys

from documents import COMMAND, ELSEWHERE, all_documents, blocks, without_comment

programs = {'hoctomap': pathlib.Path(sys.argv[1]).resolve(), 'hoctomap-experiments': pathlib.Path(sys.argv[2]).resolve()}
sources = pathlib.Path(sys.argv[3]).resolve()
presets = {preset['name'] for preset in json.loads((sources / 'CMakePresets.json').read_text())['configurePresets']}
RUN = {'sh', 'sh small'}
problems, used = [], set()


@functools.cache
def help_of(program, command):
    """Of a command, by its full name; None if there is none."""
    done = subprocess.run([programs[program], command, '--help'], capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else None


def elsewhere(where, line):
    fits = next((pattern for pattern in ELSEWHERE if re.fullmatch(pattern, line)), None)
    if fits is None:
        problems.append(f'{where}: `{line}` is not on the list of what runs elsewhere (tests/docs/documents.py)')
        return
    used.add(fits)
    for script in re.findall(r'scripts/\w+\.sh', line):
        if subprocess.run(['bash', '-n', sources / script]).returncode:
            problems.append(f'{where}: {script} is missing or no script')
    for preset in re.findall(r'--preset ([\w-]+)', line):
        if preset not in presets:
            problems.append(f'{where}: there is no preset {preset}')


def prose(where, text):
    """`hoctomap COMMAND --option` in the text."""
    for span in re.findall(r'`([^`\n]+)`', text):
        found = re.match(r'(hoctomap(?:-experiments)?) ([a-z][a-z-]+)\b(.*)', span)
        if not found:
            continue
        program, command, rest = found.groups()
        known = help_of(program, command)
        if known is None:
            problems.append(f'{where}: `{span}`: there is no {program} {command}')
            continue
        for option in re.findall(r'(?<!\S)--[a-z][a-z-]*', rest):
            if not re.search(rf'{option}\b', known):
                problems.append(f'{where}: `{span}`: {command} has no {option}')


for document in all_documents(sources):
    name = document.relative_to(sources)
    if str(name).startswith(('docs/decisions', 'CHANGELOG')):
        continue  # what was so on that day
    in_block = set()
    for info, first, lines in blocks(document):
        in_block.update(range(first - 1, first + len(lines) + 1))
        commands = [(number, line) for number, line in enumerate(lines, first) if COMMAND.match(line)]
        if info == '' and commands:
            problems.append(f'{name}:{commands[0][0]}: a block with commands is not marked: {", ".join(sorted(RUN))}, sh elsewhere')
        if info == 'sh elsewhere':
            for number, line in enumerate(lines, first):
                elsewhere(f'{name}:{number}', without_comment(line))
        elif info.startswith('sh') and info not in RUN:
            problems.append(f'{name}:{first - 1}: what is `{info}`?')
    for number, line in enumerate(document.read_text().splitlines(), 1):
        if number not in in_block:
            prose(f'{name}:{number}', line)
problems += [f'documents.py: nothing is `{pattern}` any more' for pattern in ELSEWHERE if pattern not in used]
print('\n'.join(problems))
sys.exit(1 if problems else 0)
