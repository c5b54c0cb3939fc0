#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The parallel stages under ThreadSanitizer, without suppressions: tests of libraries, and the whole program.
#   scripts/tsan.sh [LIBRARY ... | program]      default: all libraries with parallel loops, and the program
# oneTBB hands work from thread to thread by means that the sanitizer does not see in the installed library, so that all
# that is handed over looks like a race. Its sources (the package that is installed) are built for the sanitizer as well.
# With clang, which compiles sanitized code in a third of GCC's time.
set -euo pipefail
cd "$(dirname "$0")/.."
what=("${@:-geometry octree mapping tabletop existence exploration simulation io program}")
tbb=$PWD/build/tsan-tbb
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

build_tbb() {
  mkdir -p "$tbb/apt/lists/partial" "$tbb/apt/sources"
  for list in /etc/apt/sources.list /etc/apt/sources.list.d/debian.sources; do
    [ ! -e "$list" ] || sed 's/^Types: deb$/Types: deb-src/; s/^deb /deb-src /' "$list" > "$tbb/apt/sources/${list##*/}"
  done
  local apt=(apt-get -qq -o "Dir::Etc::sourcelist=/dev/null" -o "Dir::Etc::sourceparts=$tbb/apt/sources"
    -o "Dir::State::lists=$tbb/apt/lists" -o "Dir::Cache=$tbb/apt")
  "${apt[@]}" update
  (cd "$tbb" && "${apt[@]}" source "onetbb=$(dpkg-query -W -f '${source:Version}' libtbb-dev)")
  CC=clang CXX=clang++ cmake -S "$tbb"/onetbb-*/ -B "$tbb/build-clang" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBB_STRICT=OFF > /dev/null
  cmake --build "$tbb/build-clang" --target tbb
  cp "$tbb"/build-clang/*/libtbb.so.12 "$tbb/"
}

build() { cmake --build --preset tsan --target "$@"; }

tests() {
  build "test_$1"
  LD_LIBRARY_PATH=$tbb "build/tsan/tests/$1/test_$1" --gtest_brief=1
}

run() {
  echo "hoctomap $*"
  LD_LIBRARY_PATH=$tbb build/tsan/apps/hoctomap/hoctomap "$@" > "$work/said.txt"
}

# Every command with parallel stages. The kitchen sweep is built if it is there.
program() {
  build hoctomap hoctomap-mrpt hoctomap-simulator
  export HOCTOMAP_MRPT=$PWD/build/tsan/apps/hoctomap-mrpt/hoctomap-mrpt
  local kitchen=${HOCTOMAP_SHARED:-../shared}/data/redkitchen/table_sweep_a.rawlog log=$work/demo.rawlog
  run simulate -q -c configs/scenes/demo.ini -o "$log" --threads 2
  run simulate -q -c configs/scenes/occlusion.ini -o "$work/occlusion.rawlog" --threads 4
  run build -q -i "$log" -o "$work/demo" --threads 2 --snapshot-every 5
  run build -q -i "$work/occlusion.rawlog" -o "$work/occlusion" --threads 4 --max-scans 6
  run build -q -i "$work/occlusion.rawlog" -o "$work/occlusion" --threads 3 --continue
  run build -q -i "$log" -o "$work/monolithic" --threads 4 --monolithic --max-scans 3
  run build -i "$log" -o "$work/nothing" --threads 2 --estimate
  [ ! -e "$kitchen" ] || run build -q -i "$kitchen" -o "$work/kitchen" --threads 2
  # Its picture is drawn by MRPT in a process of one thread, and MRPT takes two of its own locks now in one order, now in the other.
  TSAN_OPTIONS=detect_deadlocks=0 run explore -q -c configs/scenes/explore_table.ini -o "$work/explored" --threads 3 --set exploration.max_views=3
  run query "$work/demo" --ray 0,0,1.5,1,0,-0.7
  run query "$work/demo" --box 0.4,0,0.8,0.1,0.1,0.2,30 --json
  [ ! -e libs/report/web/node_modules ] || run report "$work/demo" -o "$work/demo.html"
  run diff "$work/demo" "$work/occlusion"
  run merge "$work/demo" "$work/occlusion" -o "$work/merged"
  run export "$work/demo" --format ply -o "$work/demo.ply"
  run verify "$work/merged"
}

[ -e "$tbb/libtbb.so.12" ] || build_tbb
cmake --preset tsan -DCMAKE_CXX_COMPILER=clang++ -DHOCTOMAP_PRECOMPILE=ON "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1 -DNDEBUG" > /dev/null
for part in ${what[@]}; do
  echo "== $part"
  if [ "$part" = program ]; then program; else tests "$part"; fi
done
