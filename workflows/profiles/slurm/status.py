#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tells Snakemake how a Slurm job is: running, success or failed. By scontrol, which needs no accounting database but forgets
jobs some minutes after their end (MinJobAge); then by sacct."""
import re, subprocess, sys

GOING = {'PENDING', 'CONFIGURING', 'RUNNING', 'COMPLETING', 'SUSPENDED', 'REQUEUED', 'REQUEUE_FED', 'REQUEUE_HOLD', 'RESIZING', 'SIGNALING', 'STAGE_OUT', 'STOPPED'}


def run(*command):
    return subprocess.run(command, capture_output=True, text=True)


def state(job):
    """As Slurm calls it; None if Slurm knows no such job. A controller that does not answer knows nothing of its end."""
    asked = run('scontrol', '-o', 'show', 'job', job)
    found = re.search(r'\bJobState=(\w+)', asked.stdout)
    if found:
        return found[1]
    if 'Invalid job id' not in asked.stderr:
        return 'RUNNING'
    words = run('sacct', '-n', '-X', '-P', '-o', 'State', '-j', job).stdout.split()
    return words[0] if words else None


now = state(sys.argv[1])
print('running' if now in GOING else 'success' if now == 'COMPLETED' else 'failed')
