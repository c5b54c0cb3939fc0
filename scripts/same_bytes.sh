#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The same input gives the same bytes in every build type: maps of one log by several builds, compared with that of the first.
#   scripts/same_bytes.sh BUILD BUILD [BUILD ...]     build folders, as build/dev build/release build/asan-ubsan
# LOG (default: the scene `demo`, simulated by the first build) is the log, SCANS (default 20) how many of its scans.
set -euo pipefail
cd "$(dirname "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=${LOG:-$work/a.rawlog}
[ -n "${LOG:-}" ] || "$1/apps/hoctomap/hoctomap" simulate -q -c configs/scenes/demo.ini -o "$log" > /dev/null
for build in "$@"; do
  map=$work/${build//\//_}
  HOCTOMAP_MRPT=$build/apps/hoctomap-mrpt/hoctomap-mrpt \
    "$build/apps/hoctomap/hoctomap" build -q -i "$log" -o "$map" --max-scans "${SCANS:-20}" > /dev/null
  # What has to be the same: all but the files that hold times of the run.
  diff -rq -x timing.csv -x log.txt -x .lock "$work/${1//\//_}" "$map"
done
echo "$# builds, the same bytes: $*"
