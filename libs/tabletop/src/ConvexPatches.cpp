// SPDX-License-Identifier: BSD-3-Clause
#include "ConvexPatches.h"

#include "Containers.h"
#include "ConvexMerging.h"
#include "PatchGraph.h"
#include "SurfacePatches.h"

namespace hoctomap {
namespace {

constexpr double kFragment = 200.0 / 64;  // cells: a smaller region has too little border to be judged by
constexpr double kLeastInside = 40.0 / 64;

}  // namespace

std::vector<std::int32_t> convexThings(const InverseDepthImage& image, double range_noise) {
  const PatchScales scales(image, range_noise);
  const double cell = scales.cell * scales.cell;
  const SurfacePatches patches = surfacePatches(image, scales);
  const PatchGraph graph = patchGraph(image, patches, scales);
  PatchRegions regions = mergeConvex(graph, kFragment * cell);
  joinContainers(graph, kLeastInside * cell, regions);

  std::vector<std::int32_t> thing(patches.label);
  for (auto& t : thing) {
    if (t >= 0) t = regions.of_patch[static_cast<std::size_t>(t)];
  }
  return thing;
}

}  // namespace hoctomap
