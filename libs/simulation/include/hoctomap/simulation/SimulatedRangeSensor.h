// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "hoctomap/simulation/RangeSensorModel.h"
#include "hoctomap/simulation/SceneRaycaster.h"

namespace hoctomap {

/// In `SolidImage`: a pixel without return, and one whose depth lies between two solids, on neither.
inline constexpr std::int32_t kNoSolid = -1;
inline constexpr std::int32_t kMixedSolids = -2;

/// `SolidId::value` of every pixel, row-major, or one of the two above.
using SolidImage = std::vector<std::int32_t>;

/// What a faultless camera without range limits would see.
struct Rendering {
  DepthImage image;
  SolidImage solids;
  std::vector<float> cos_incidence;  ///< between beam and surface normal; 0 without a hit
};

/// What the modelled camera reports.
struct SensedImage {
  DepthImage image;
  SolidImage solids;
};

/// One beam through the middle of each pixel. The same for any number of threads.
/// @param threads 0 = as many as the machine has.
[[nodiscard]] Rendering render(const SceneRaycaster& scene, const PinholeCamera& camera,
                               const Pose& world_T_sensor, int threads);

/// Adds the faults of the model. Every draw depends only on (seed, scan, pixel).
/// @throws ConfigError if the model makes no sense.
[[nodiscard]] SensedImage degrade(const Rendering& rendering, const RangeSensorModel& model,
                                  std::uint64_t seed, std::uint64_t scan, int threads);

/// A depth camera in a simulated scene.
class SimulatedRangeSensor {
 public:
  struct Reading {
    Rendering truth;
    SensedImage sensed;
  };

  /// @throws ConfigError if the model makes no sense.
  SimulatedRangeSensor(const RangeSensorModel& model, std::uint64_t seed, int threads = 0);

  [[nodiscard]] const RangeSensorModel& model() const { return model_; }

  /// Takes scan number `scan` of the scene as it is now.
  [[nodiscard]] Reading sense(const Scene& scene, const Pose& world_T_sensor, std::uint64_t scan);

 private:
  RangeSensorModel model_;
  std::uint64_t seed_;
  int threads_;
  SceneRaycaster raycaster_;
};

}  // namespace hoctomap
