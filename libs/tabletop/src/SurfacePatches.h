// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "InverseDepth.h"

namespace hoctomap {

/// The scales of the patches; all follow from the sensor's noise and its angle between two pixels.
struct PatchScales {
  PatchScales(const InverseDepthImage& image, double range_noise);

  double scatter;  ///< 1/m: what a smooth surface departs from the plane of a patch
  double jump;     ///< 1/m: the step that parts two surfaces
  int cell;        ///< pixels, edge of a patch
  double ridge;    ///< px^2, see PatchMoments::plane
  int bridge;      ///< pixels without a return that a surface is followed over
};

/// An image taken apart into small, connected, nearly plane pieces.
struct SurfacePatches {
  static constexpr std::int32_t kNone = -1;

  std::vector<std::int32_t> label;  ///< of every pixel; kNone where there is no object
  std::vector<PatchMoments> moments;
  std::vector<PatchPlane> planes;

  [[nodiscard]] std::size_t size() const { return moments.size(); }
};

/// Cuts the object pixels into square cells, and lets each pixel go over to the patch nearby that explains it
/// best, a few times, so that the borders between patches come to lie on creases and steps.
[[nodiscard]] SurfacePatches surfacePatches(const InverseDepthImage& image, const PatchScales& scales);

}  // namespace hoctomap
