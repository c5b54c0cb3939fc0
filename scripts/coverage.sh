#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Line and branch coverage of our own code by tests. Needs gcovr (Debian package of that name).
#   scripts/coverage.sh io          by the tests of libs/io, of libs/io; likewise for any other library
#   scripts/coverage.sh all         by all tests, of everything
# The full report is build/coverage/coverage.txt.
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
# Branches of exceptions that the compiler adds to every call are none of ours.
gcovr -r . --object-directory "$build" --exclude-throw-branches "${filter[@]}" -o "$build/coverage.txt"
gcovr -r . --object-directory "$build" --exclude-throw-branches --branches "${filter[@]}" > "$build/branches.txt"
tail -n 4 "$build/coverage.txt" "$build/branches.txt"
