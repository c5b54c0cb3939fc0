// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ConvexMerging.h"
#include "PatchGraph.h"
#include "SurfacePatches.h"

namespace hoctomap {

/// Cuts regions in which a face ends in a concave crease. Where two things stand flush, their common border
/// is a crease or step on one side and nothing on the other: averaged over the whole border it is too little
/// for mergeConvex. So what lies in front of the plane of the face is another thing, if enough of the border
/// that this plane makes is seen (after Schoeler, Papon and Woergoetter, Constrained Planar Cuts, CVPR 2015,
/// where the planes are drawn at random).
/// @param fragment  pixels, the least region
/// @param fixed     by region: not to be cut
void cutAtFaces(const PatchGraph& graph, const PatchScales& scales, double fragment,
                const std::vector<std::uint8_t>& fixed, PatchRegions& regions);

}  // namespace hoctomap
