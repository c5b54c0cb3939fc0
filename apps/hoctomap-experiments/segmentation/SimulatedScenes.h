// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "Score.h"
#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/simulation/Simulation.h"

namespace hoctomap {

/// What stands on the table of a generated scene, and from how far it is seen.
enum class SceneKind {
  piled,  ///< 8 to 16 boxes, tins, mugs and bowls, dropped onto each other and beside each other
  thin,   ///< plates, books, phones, pens, cutlery of 3 to 13 mm beside thicker things, on a warped table
  far,    ///< a few things that stand apart, 1.5 to 3 m away
  bare    ///< nothing but a warped table
};
[[nodiscard]] std::string toString(SceneKind kind);

/// A random scene with one view of it; the same seed, the same scene.
[[nodiscard]] Simulation makeSegmentationScene(SceneKind kind, std::uint64_t seed);

/// The view, and the truth in the way of labelled scenes (see `joinedTruth`): 1 no object, 20, 30, ...
/// objects.
struct SimulatedView {
  Measurement z;
  GreyImage truth;
};
[[nodiscard]] SimulatedView look(const Simulation& scene);

}  // namespace hoctomap
