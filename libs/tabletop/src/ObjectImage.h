// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "InverseDepth.h"
#include "ObjectCandidates.h"

namespace hoctomap {

/// The picture of what is on and around one table, and where its points are in it.
struct ObjectImage {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  InverseDepthImage image;
  std::vector<std::uint32_t>
      pixel_of_point;  ///< of every point of the measurement; kNone: not in the picture
};

/// The picture of the candidates and what surrounds them: a part of the sensor's image, or, of an unorganised
/// cloud, what a pinhole camera in the sensor's place sees of its points, with pixels as far apart as these.
/// What such a camera cannot hold (75 degrees and more beside its axis) is left out. There are candidates.
[[nodiscard]] ObjectImage objectImage(const Measurement& z, std::span<const Candidate> candidates);

}  // namespace hoctomap
