#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From nothing to a map: installs what is missing, builds, makes a log of a simulated table, maps it, draws it.
# Argument: where the results go (default: out/demo).
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-out/demo}

scripts/install_dependencies.sh
cmake --preset release >/dev/null
cmake --build --preset release --parallel "$(nproc)" --target hoctomap hoctomap-simulator hoctomap-mrpt hoctomap-cloud
hoctomap=build/release/apps/hoctomap/hoctomap

rm -rf "$out"
mkdir -p "$out"
echo "== a log of a simulated scene"
"$hoctomap" simulate -q -c configs/scenes/demo.ini -o "$out/demo.rawlog"
echo "== the map of this log"
"$hoctomap" build -q -i "$out/demo.rawlog" -o "$out/map"
"$hoctomap" render "$out/map" -o "$out/map.png"
echo "picture    $out/map.png"
"$hoctomap" report "$out/map" -o "$out/map.html"
