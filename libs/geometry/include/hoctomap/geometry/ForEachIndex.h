// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>

namespace hoctomap {

/// Calls `visit(i)` for i in [0, count), in parallel and in any order, and returns when all are done.
///
/// A loop of its own: if the caller runs inside another parallel loop that an error elsewhere cancels, TBB
/// would leave indices out without a word, and the caller would go on with results that are not there.
/// @throws what a call of `visit` throws; then others may not have been made
template <class Visit>
void forEachIndex(std::size_t count, const Visit& visit) {
  tbb::task_group_context own(tbb::task_group_context::isolated);
  tbb::parallel_for(std::size_t{0}, count, visit, own);
}

}  // namespace hoctomap
