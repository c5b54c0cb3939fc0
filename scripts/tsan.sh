#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The tests of the parallel stages under ThreadSanitizer, without suppressions.
#   scripts/tsan.sh [LIBRARY ...]      tests of these libraries (default: all with parallel loops)
# oneTBB hands work from thread to thread by means that the sanitizer does not see in the installed library, so that all
# that is handed over looks like a race. Its sources (the package that is installed) are built for the sanitizer as well.
set -euo pipefail
cd "$(dirname "$0")/.."
libraries=("${@:-geometry octree mapping tabletop existence exploration simulation io}")
tbb=$PWD/build/tsan-tbb

build_tbb() {
  mkdir -p "$tbb/apt/lists/partial" "$tbb/apt/sources"
  for list in /etc/apt/sources.list /etc/apt/sources.list.d/debian.sources; do
    [ ! -e "$list" ] || sed 's/^Types: deb$/Types: deb-src/; s/^deb /deb-src /' "$list" > "$tbb/apt/sources/${list##*/}"
  done
  local apt=(apt-get -qq -o "Dir::Etc::sourcelist=/dev/null" -o "Dir::Etc::sourceparts=$tbb/apt/sources"
    -o "Dir::State::lists=$tbb/apt/lists" -o "Dir::Cache=$tbb/apt")
  "${apt[@]}" update
  (cd "$tbb" && "${apt[@]}" source "onetbb=$(dpkg-query -W -f '${source:Version}' libtbb-dev)")
  cmake -S "$tbb"/onetbb-*/ -B "$tbb/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_SANITIZE=thread \
    -DTBB_TEST=OFF -DTBB_STRICT=OFF -DCMAKE_CXX_FLAGS=-Wno-tsan > /dev/null
  cmake --build "$tbb/build" --target tbb
  cp "$tbb"/build/*/libtbb.so.12 "$tbb/"
}

[ -e "$tbb/libtbb.so.12" ] || build_tbb
cmake --preset tsan > /dev/null
cmake --build --preset tsan --target $(printf 'test_%s ' ${libraries[@]})
for library in ${libraries[@]}; do
  echo "== $library"
  LD_LIBRARY_PATH=$tbb "build/tsan/tests/$library/test_$library" --gtest_brief=1
done
