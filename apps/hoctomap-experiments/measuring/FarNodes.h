// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/config/Settings.h"
#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// A hierarchy with `nodes` nodes besides the root that no scan near the world's origin sees: tables of nine
/// objects each, 100 m and more away.
[[nodiscard]] MapHierarchy makeFarNodes(const Settings& settings, std::size_t nodes);

}  // namespace hoctomap
