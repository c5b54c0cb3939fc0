#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compares the update engine with the reference on many more random scenes than the tests do.
# Usage: scripts/engine_sweep.sh [factor, default 20] [path of test_octree]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
factor=${1:-20}
program=${2:-$root/build/dev/tests/octree/test_octree}
if ! [[ $factor =~ ^[1-9][0-9]*$ ]]; then
  echo "engine_sweep.sh: the factor must be a positive whole number, not '$factor'" >&2
  exit 2
fi
if [ ! -x "$program" ]; then
  echo "engine_sweep.sh: $program is not there: build it first (cmake --build build/dev --target test_octree)" >&2
  exit 5
fi
HOCTOMAP_SWEEP=$factor "$program" --gtest_filter='BlockScanUpdate.*Scans*:BlockScanUpdate.*Saturated*:RayBatch.*:MarkedReach.*'
