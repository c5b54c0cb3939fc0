#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The workflow over 40 logs, one of them damaged: on one core, on two, and as jobs of Slurm on this machine; a job is killed in
# each of the last two. Checks that all maps are the same and prints times (docs/scaling.md). Takes some minutes.
#   scripts/workflow_test.sh [BUILD] [OPTIONS of tests/workflows/run_workflow.py]
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/release
[[ ${1:-} != "" && ${1:-} != --* ]] && { build=$1; shift; }
shared=${HOCTOMAP_SHARED:-../shared}
exec /usr/bin/python3 tests/workflows/run_workflow.py "$build/apps/hoctomap/hoctomap" "$build/apps/hoctomap-mrpt/hoctomap-mrpt" . \
  --logs 40 --shared "$shared" --slurm --speed "$@"
