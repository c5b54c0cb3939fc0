#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Coverage of our own code by tests: lines, and decisions with both outcomes. Needs gcovr (Debian package of that name).
#   scripts/coverage.sh io          by the tests of libs/io, of libs/io; likewise for any other library
#   scripts/coverage.sh all         by all tests, of everything
# Lines that are missing: build/coverage/coverage.txt; decisions: build/coverage/decisions.txt.
set -euo pipefail
cd "$(dirname "$0")/.."
what=${1:?a library, or all}
build=build/coverage
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DHOCTOMAP_PRECOMPILE=ON -DBUILD_TESTING=ON \
  -DCMAKE_CXX_FLAGS="--coverage -O0 -g0" > /dev/null
target=(--target "test_$what")
filter=(--filter "libs/$what/")
if [ "$what" = all ]; then
  target=()
  filter=(--filter libs/ --filter apps/)
fi
cmake --build "$build" "${target[@]}"
find "$build" -name '*.gcda' -delete
if [ "$what" = all ]; then
  ctest --test-dir "$build"
else
  "$build/tests/$what/test_$what"
fi
# Of branches, only decisions count (if, loops, switch): gcov's own number is mostly clean-up after exceptions.
gcovr -r . --object-directory "$build" "$build/libs" "$build/apps" "${filter[@]}" --decisions --json "$build/coverage.json"
gcovr -r . --add-tracefile "$build/coverage.json" -o "$build/coverage.txt"
python3 scripts/coverage_table.py "$build/coverage.json" > "$build/decisions.txt"
sed '/^$/q' "$build/decisions.txt"
