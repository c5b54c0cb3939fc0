// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexPatches.h"

#include "Containers.h"
#include "ConvexMerging.h"
#include "PatchGraph.h"
#include "PlanarCuts.h"
#include "SurfacePatches.h"

namespace hoctomap {
namespace {

constexpr double kFragment = 200.0 / 64;  // cells: a smaller region has too little border to be judged by
constexpr double kLeastInside = 40.0 / 64;

/// Regions that several went into.
std::vector<std::uint8_t> joined(const PatchRegions& before, const PatchRegions& after) {
  std::vector<std::uint8_t> result(static_cast<std::size_t>(after.count), 0);
  std::vector<std::int32_t> first(result.size(), -1);
  for (std::size_t k = 0; k < after.of_patch.size(); ++k) {
    const auto region = static_cast<std::size_t>(after.of_patch[k]);
    if (first[region] < 0) first[region] = before.of_patch[k];
    if (first[region] != before.of_patch[k]) result[region] = 1;
  }
  return result;
}

}  // namespace

std::vector<std::int32_t> convexThings(const InverseDepthImage& image, double range_noise) {
  const PatchScales scales(image, range_noise);
  const double cell = scales.cell * scales.cell;
  const SurfacePatches patches = surfacePatches(image, scales);
  const PatchGraph graph = patchGraph(image, patches, scales);
  PatchRegions regions = mergeConvex(graph, kFragment * cell);
  const PatchRegions solids = regions;
  joinContainers(graph, kLeastInside * cell, regions);
  cutAtFaces(graph, scales, kFragment * cell, joined(solids, regions), regions);  // a container is concave

  std::vector<std::int32_t> thing(patches.label);
  for (auto& t : thing) {
    if (t >= 0) t = regions.of_patch[static_cast<std::size_t>(t)];
  }
  return thing;
}

}  // namespace hoctomap
