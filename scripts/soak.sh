#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The long versions of the tests of docs/reliability.md. Needs a build (BUILD, default build/dev).
#   scripts/soak.sh kills N      kills a run over and over until N kills are reached; every map ends with the same bytes
#   scripts/soak.sh cycles N     N scans, each taken in by a process of its own; the bytes of one process over all
#   scripts/soak.sh logs N       N mutated logs through `hoctomap build`
#   scripts/soak.sh hostile N    N times files made to do harm: seconds and memory until they are refused
#   scripts/soak.sh stops N      N stop signals at random moments of a run over LOG (a scene without one), with OPTIONS of build
#   scripts/soak.sh reader N     N mutated logs through the log reader's fork server
#   scripts/soak.sh fuzz N       N executions of every fuzzer (preset `fuzz`, FUZZ, default build/fuzz), or of TARGETS
# `reader` and `fuzz` go on where they were stopped: what is done stands in build/soak.
# SEED (default 1) is that of the mutations, of the first portion where there are several.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build/dev}
hoctomap=$build/apps/hoctomap/hoctomap
export HOCTOMAP_MRPT=$build/apps/hoctomap-mrpt/hoctomap-mrpt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
what=${1:?kills, cycles, logs, hostile, stops, reader or fuzz}
count=${2:?how many}

# What has to be the same: all but the files that hold times of the run.
same() { diff -rq -x timing.csv -x log.txt -x .lock "$1" "$2"; }
go_on=("$hoctomap" build -q -i "$work/a.rawlog" --continue --set mapping.checkpoint_scans=1)
run() { "${go_on[@]}" -o "$1" "${@:2}" > /dev/null; }

kills() {
  "$hoctomap" simulate -q -c configs/scenes/demo.ini -o "$work/a.rawlog" > /dev/null
  local begin=${EPOCHREALTIME/./}
  run "$work/whole"
  local duration=$((${EPOCHREALTIME/./} - begin)) killed=0 maps=0
  while [ "$killed" -lt "$count" ]; do
    local map=$work/map
    rm -rf "$map"
    while true; do
      "${go_on[@]}" -o "$map" > /dev/null &  # a function would be killed instead of the program
      local pid=$! wait_us=$(((RANDOM * 32768 + RANDOM) % (duration * 6 / 5)))
      sleep "$(printf '%d.%06d' $((wait_us / 1000000)) $((wait_us % 1000000)))"
      kill -9 "$pid" 2> /dev/null || true
      local code=0
      wait "$pid" 2> /dev/null || code=$?
      [ ! -e "$map/hierarchy.yaml" ] || "$hoctomap" verify "$map" > "$work/verify.txt" || { cat "$work/verify.txt"; return 1; }
      [ "$code" -ne 137 ] && break
      killed=$((killed + 1))
    done
    [ "$code" -eq 0 ] || { echo "exit code $code"; return 1; }
    same "$work/whole" "$map"
    maps=$((maps + 1))
  done
  echo "$killed kills over $maps maps: all whole after every kill, all ended with the same bytes"
}

cycles() {
  "$hoctomap" simulate -q -c configs/scenes/demo.ini -o "$work/a.rawlog" --set "path.sweep.views=$count" > /dev/null
  run "$work/whole"
  local slowest=0
  for scans in $(seq 1 "$count"); do
    local TIMEFORMAT=%U
    local seconds
    seconds=$({ time run "$work/map" --max-scans "$scans"; } 2>&1 | tail -1)
    slowest=$(printf '%s\n%s\n' "$slowest" "$seconds" | sort -g | tail -1)
  done
  run "$work/map"
  same "$work/whole" "$work/map"
  echo "$count cycles on one map: the same bytes; the slowest took $slowest s of CPU time, start and scene included"
}

logs() {
  "$hoctomap" simulate -q -c configs/scenes/demo.ini -o "$work/a.rawlog" --set path.sweep.views=2 > /dev/null
  python3 scripts/mutated_logs.py "$hoctomap" "$work" "$count" "${SEED:-1}"
}

hostile() {
  "$hoctomap" simulate -q -c configs/scenes/demo.ini -o "$work/a.rawlog" > /dev/null
  for _ in $(seq "$count"); do python3 scripts/hostile_files.py "$hoctomap" "$work/a.rawlog"; done
}

stops() {
  [ -n "${LOG:-}" ] || "$hoctomap" simulate -q -c configs/scenes/demo.ini -o "$work/a.rawlog" --set path.sweep.views=100 > /dev/null
  python3 scripts/stop_times.py "$hoctomap" "${LOG:-$work/a.rawlog}" "$count" "${SEED:-1}" ${OPTIONS:-}
}

# Portions of a long run, each recorded in build/soak/NAME.txt when it is done: what was stopped goes on where it was.
#   portions NAME COUNT PORTION COMMAND: runs COMMAND SEED COUNT, whose output is the record
portions() {
  local record=build/soak/$1.txt left=$2 portion=$3 seed=${SEED:-1}
  mkdir -p build/soak
  touch "$record"
  while [ "$left" -gt 0 ]; do
    local size=$((left < portion ? left : portion))
    if ! grep -q "^seed $seed: $size " "$record"; then
      local output
      output=$("$4" "$seed" "$size" "${@:5}") || { echo "$1: seed $seed ended with exit code $?" >&2; return 1; }
      echo "seed $seed: $size executions, $(date +%F), $(echo $output)" >> "$record"
    fi
    left=$((left - size))
    seed=$((seed + 1))
  done
  tail -n 1 "$record"
}

reader_portion() {
  "$build/tests/fuzz/fuzz_logs" --rounds "$2" --seed "$1" --batch 50 --keep build/soak
}

reader() { portions reader "$count" 10000 reader_portion; }

fuzz_portion() {
  local target=$3 corpus=build/soak/corpus/$3
  mkdir -p "$corpus"
  "$build/tests/fuzz/fuzz_${target}_replay" --write-seeds "$corpus" > /dev/null
  cp tests/fuzz/corpus/$target/* "$corpus/"
  # The sanitizer remembers no call chains of allocations, which takes a quarter of the time of `manifest`: the replay program tells.
  export ASAN_OPTIONS=malloc_context_size=0:quarantine_size_mb=8
  # Its clock goes on while a run in the background waits: far more than an input takes.
  "$fuzz/tests/fuzz/fuzz_$target" -seed="$1" -runs="$2" -max_len=20000 -rss_limit_mb=2000 -timeout=300 \
    -artifact_prefix=build/soak/ "$corpus" > "$work/$target.txt" 2>&1 || { tail -30 "$work/$target.txt" >&2; return 1; }
  grep '^Done' "$work/$target.txt"
}

fuzz() {
  local fuzz=${FUZZ:-build/fuzz}
  for target in ${TARGETS:-ini poses manifest ot bt stream}; do
    portions "fuzz_$target" "$count" ${PORTION:-100000} fuzz_portion "$target"
  done
}

"$what"
