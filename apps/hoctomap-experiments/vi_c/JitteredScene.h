// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "hoctomap/simulation/Scene.h"

namespace hoctomap {

/// The scene with every object moved by up to 4 cm and turned by up to 20 degrees on what it stands on, drawn
/// by the seed; objects stay 1.5 cm apart from each other and 3 cm from the edge of their table. An object
/// for which no such place is drawn stays where it was.
[[nodiscard]] Scene jittered(Scene scene, std::uint64_t seed);

}  // namespace hoctomap
