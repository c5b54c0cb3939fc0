#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds optimised programs and measures: hoctomap beside stock OctoMap on the same input in the same run, then
# each stage by itself. Prints a table in Markdown, and writes everything as CSV.
#   scripts/benchmark.sh [LOG] [OPTION...]
#   scripts/insert_figures.sh docs/performance.md out/benchmark/performance.md     (afterwards: refreshes the page)
# LOG: a rawlog with poses; by default the kitchen sweep of ../shared/data if it is there, else a simulated set.
# OPTIONs go to `hoctomap-experiments performance` (--repeats N, --scans N, --quick).
set -euo pipefail
# LOG is relative to where the user is.
log=
if [ $# -gt 0 ] && [ "${1#-}" = "$1" ]; then
  log=$(realpath "$1")
  shift
fi
cd "$(dirname "$0")/.."
out=out/benchmark

scripts/install_dependencies.sh >&2
cmake --preset benchmark >/dev/null
cmake --build --preset benchmark --parallel "$(nproc)" --target hoctomap-experiments hoctomap-benchmarks >&2
programs=build/benchmark

kitchen=${HOCTOMAP_SHARED:-../shared}/data/redkitchen/table_sweep_a.rawlog
if [ -z "$log" ] && [ -f "$kitchen" ]; then log=$kitchen; fi
mkdir -p "$out"
if [ -n "$log" ]; then
  export HOCTOMAP_BENCHMARK_LOG=$log
  set -- --log "$log" "$@"
fi

echo "== hoctomap and stock OctoMap"
status=0
"$programs/apps/hoctomap-experiments/hoctomap-experiments" performance -o "$out" "$@" || status=$?
echo
echo "== each stage by itself"
"$programs/tests/benchmarks/hoctomap-benchmarks" --benchmark_out="$out/stages.json" --benchmark_out_format=json
echo
echo "written: $out/performance.md, performance.csv, measurements.csv, stages.json"
exit "$status"
