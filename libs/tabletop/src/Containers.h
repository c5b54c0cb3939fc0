// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ConvexMerging.h"

namespace hoctomap {

/// Joins the inside of cups, bowls and boxes to their outside. An inside is a region that is concave in
/// itself, which the surface of a solid thing never is on the whole; the rim between it and the outside is a
/// step. `least` is the smallest inside, pixels.
void joinContainers(const PatchGraph& graph, double least, PatchRegions& regions);

}  // namespace hoctomap
