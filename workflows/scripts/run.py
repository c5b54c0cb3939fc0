#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs one step of a log and writes down how it ended, as JSON: what it was, exit code, the error in one line, what it took.

What is wrong with a log (exit codes 2, 3, 4, 6 of hoctomap) is a result: the step is done, and the steps after it are not
run. Anything else (a file system that is full, a job that is killed) is the business of the workflow engine: this program
ends with the same exit code and writes nothing.

Usage: run.py OUTCOME [--after OUTCOME ...] [--result] [--continue-in MAP] -- COMMAND ...
  --after        outcomes that this step needs; where one of them failed, it is not run, and ends as that one did
  --result       standard output is JSON, and belongs to the outcome
  --continue-in  the map in this folder is continued if there is one, and made anew if it is of other inputs or settings
"""
import argparse, json, pathlib, resource, subprocess, sys, time

OF_THE_LOG = (2, 3, 4, 6)


def run(command):
    """(exit code, standard output, standard error); a signal is 128 + its number."""
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors='replace')
    sys.stderr.write(done.stderr)
    return (done.returncode if done.returncode >= 0 else 128 - done.returncode), done.stdout, done.stderr


def continue_or_renew(command, folder):
    if not (folder / 'hierarchy.yaml').exists():
        return run(command + ['--overwrite'])  # a run may have ended before its first commit
    ended = run(command + ['--continue'])
    return run(command + ['--overwrite']) if ended[0] in (2, 3) else ended


def error_line(exit_code, stderr):
    if exit_code == 0:
        return ''
    lines = [line for line in stderr.splitlines() if line.strip()]
    own = [line for line in lines if line.startswith('hoctomap: ')]
    return (own or lines or [f'exit code {exit_code}'])[-1].removeprefix('hoctomap: ')


def failed_before(outcomes):
    for path in outcomes:
        before = json.loads(path.read_text())
        if before['exit_code'] != 0:
            return before
    return None


def step_of(outcome):
    return f'part {outcome.stem}' if outcome.parent.name == 'parts' else outcome.stem


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('outcome', type=pathlib.Path)
    parser.add_argument('--after', type=pathlib.Path, nargs='*', default=[])
    parser.add_argument('--result', action='store_true')
    parser.add_argument('--continue-in', type=pathlib.Path)
    split = sys.argv.index('--')
    options, command = parser.parse_args(sys.argv[1:split]), sys.argv[split + 1:]

    before = failed_before(options.after)
    if before:
        outcome = dict(before, ran=False)
    else:
        start = time.monotonic()
        code, stdout, stderr = continue_or_renew(command, options.continue_in) if options.continue_in else run(command)
        if code != 0 and code not in OF_THE_LOG:
            sys.exit(code)
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        outcome = dict(step=step_of(options.outcome), command=command, exit_code=code, error=error_line(code, stderr), ran=True,
                       wall_s=round(time.monotonic() - start, 3), cpu_s=round(used.ru_utime + used.ru_stime, 3),
                       max_rss_mb=round(used.ru_maxrss / 1000, 1))
        if options.result and code == 0:
            outcome['result'] = json.loads(stdout)
    options.outcome.parent.mkdir(parents=True, exist_ok=True)
    options.outcome.write_text(json.dumps(outcome, indent=1) + '\n')


main()
