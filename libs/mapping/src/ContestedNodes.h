// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "MovedObjects.h"

namespace hoctomap {

/// Where the boxes of several segments of one scan meet that of one node (IV-C), only those that lie at its
/// surface join it, and always the one that does most: S has told them apart, and what stands close to an
/// object or has been put into its box is not a part of it. The others lose their `node`.
void releaseStrangers(const MapHierarchy& hierarchy, std::span<SegmentInQuestion> segments);

}  // namespace hoctomap
