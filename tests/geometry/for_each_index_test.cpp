// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap {
namespace {

TEST(ForEachIndex, VisitsEveryIndexOnce) {
  std::vector<std::atomic<int>> visits(1000);
  forEachIndex(visits.size(), [&](std::size_t i) { ++visits[i]; });
  for (const auto& visit : visits) EXPECT_EQ(visit, 1);
  forEachIndex(0, [](std::size_t) { FAIL(); });
}

TEST(ForEachIndex, AnErrorComesOut) {
  EXPECT_THROW(forEachIndex(100,
                            [](std::size_t i) {
                              if (i == 50) throw std::runtime_error("50");
                            }),
               std::runtime_error);
}

TEST(ForEachIndex, IsCompleteInsideALoopThatWasCancelled) {
  std::atomic<int> visits = 0;
  tbb::task_group_context outer;
  tbb::parallel_for(
      0, 1,
      [&](int) {
        outer.cancel_group_execution();  // as an error in another of its calls does
        forEachIndex(1000, [&](std::size_t) { ++visits; });
      },
      outer);
  EXPECT_EQ(visits, 1000);
}

}  // namespace
}  // namespace hoctomap
