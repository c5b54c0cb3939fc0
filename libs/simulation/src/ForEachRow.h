// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace hoctomap {

/// Calls `row(v)` for v in [0, rows), on `threads` threads. 0, and more than the machine has, mean all: asked
/// for more, TBB complains on stderr.
template <typename Row>
void forEachRow(int rows, int threads, const Row& row) {
  const int all = tbb::info::default_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, all) : all);
  arena.execute([&] { tbb::parallel_for(0, rows, row); });
}

}  // namespace hoctomap
