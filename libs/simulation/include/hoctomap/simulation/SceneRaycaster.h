// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>

#include "hoctomap/simulation/Scene.h"

namespace hoctomap {

/// Where a ray first meets a surface.
struct SceneHit {
  double t = 0.0;  ///< in lengths of the direction
  SolidId solid;
  double cos_incidence = 1.0;  ///< of the angle between ray and surface normal, in [0, 1]
};

/// First hits of rays with the surfaces that are present in a scene. Embree finds the triangle; the distance
/// is then computed in double from that triangle, so that it does not depend on the processor's vector unit.
///
/// `cast` may be called from many threads at once, `update` may not run beside it.
class SceneRaycaster {
 public:
  /// An empty scene. @throws LimitError if Embree has no memory.
  SceneRaycaster();
  explicit SceneRaycaster(const Scene& scene);
  SceneRaycaster(SceneRaycaster&&) noexcept;
  SceneRaycaster& operator=(SceneRaycaster&&) noexcept;
  ~SceneRaycaster();

  /// Takes over the state of `scene`. Surfaces seen before are not built again.
  void update(const Scene& scene);

  /// The direction need not have unit length.
  [[nodiscard]] std::optional<SceneHit> cast(const Eigen::Vector3d& world_origin,
                                             const Eigen::Vector3d& world_direction,
                                             double max_t = std::numeric_limits<double>::infinity()) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hoctomap
