// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/octree/UpdateMemory.h"

#include "BeamDensity.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

UpdateMemory estimateUpdateMemory(const octomap::OcTree& tree, const Beams& beams) {
  const engine::VoxelGrid grid(tree.getResolution());
  const engine::ScanBeams scan(grid, beams);
  if (scan.box().empty() || (beams.hits.empty() && beams.passing.empty())) return {};
  const engine::BeamDensity density(scan, scan.box(), beams.hits, beams.passing, 1 << 20);
  constexpr double kPageBytes = engine::kPageWords * sizeof(engine::BlockBits);
  const double pages =
      std::min(density.pages(), engine::kMaxPagesAPart) + static_cast<double>(engine::kBlockPages);
  return {static_cast<std::size_t>(density.treeBytes()), static_cast<std::size_t>(1.3 * pages * kPageBytes)};
}

void requireUpdateMemory(const octomap::OcTree& tree, const Beams& beams, std::size_t max_bytes,
                         const std::string& what) {
  const std::size_t now = tree.memoryUsage();
  const UpdateMemory more = estimateUpdateMemory(tree, beams);
  if (now + more.total() <= max_bytes) return;
  const auto megabytes = [](std::size_t bytes) {
    return std::to_string((bytes + 999'999) / 1'000'000) + " MB";
  };
  throw LimitError(what + ": the update would take the map from " + megabytes(now) + " to about " +
                   megabytes(now + more.total()) + ", more than the limit of " + megabytes(max_bytes));
}

}  // namespace hoctomap
