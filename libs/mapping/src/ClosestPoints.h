// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "RegistrationSurface.h"
#include "hoctomap/mapping/Registration.h"

namespace hoctomap {

enum class Freedom { yaw_and_shift, rigid };

/// Trimmed iterated closest points (Chetverikov et al. 2002) between the surface of a known object and one
/// that may show it. Motions take the model, about its origin, onto what is seen, about the origin of that.
///
/// Distances along the normals (Chen and Medioni 1992) let planes slide, so outlines hold them: where the one
/// object ends, the other one should.
class ClosestPoints {
 public:
  ClosestPoints(const RegistrationSurface& model, const RegistrationSurface& seen,
                const RegistrationSight& sight);

  /// No motion in the world.
  [[nodiscard]] Eigen::Isometry3f atRest() const;
  /// A turn about the vertical, the centroids aligned; radians.
  [[nodiscard]] Eigen::Isometry3f turned(float yaw) const;

  /// Brings a rough motion nearer by yaw and shift: `steps` steps with about `samples` seen points, whose
  /// partners are within `radius` at first and within `least_radius` at last, m.
  void approach(Eigen::Isometry3f& motion, int steps, float radius, float least_radius,
                std::size_t samples) const;
  /// Mean distance of about `samples` seen points from the model, each counted up to `radius`; m.
  [[nodiscard]] float meanDistance(const Eigen::Isometry3f& motion, float radius, std::size_t samples) const;

  /// Brings a motion that is right to a centimetre or two to its end; partners within `near` m at last.
  [[nodiscard]] Eigen::Isometry3f refined(Eigen::Isometry3f motion, int steps, float near, Freedom freedom,
                                          std::size_t samples) const;

  /// How far the outlines are apart where they are within `radius`: root mean square, m; less if few
  /// of them meet, 0 if none do.
  [[nodiscard]] double outlineError(const Eigen::Isometry3f& motion, float radius) const;

 private:
  struct Pair {
    std::size_t model;
    std::size_t seen;
    float squared_error;  ///< m^2; the largest are not believed
    bool asked_seen;      ///< the model's point is the nearest to the seen one, not the other way round
  };
  using Pairs = std::vector<Pair>;

  static bool trim(Pairs& pairs);
  /// The nearest point of the other surface. An end of a side is compared with that side: where a side goes
  /// on beyond it, the nearest point is of the side that meets it there.
  [[nodiscard]] std::optional<SurfacePoints::Neighbour> modelFor(std::size_t seen,
                                                                 const Eigen::Isometry3f& back,
                                                                 float radius) const;
  [[nodiscard]] std::optional<SurfacePoints::Neighbour> seenFor(std::size_t model,
                                                                const Eigen::Isometry3f& motion,
                                                                float radius) const;
  [[nodiscard]] Pairs pairsOf(const Eigen::Isometry3f& motion, float radius, std::size_t samples) const;
  /// The edge at which a pair should meet: its direction, along which the distance counts.
  [[nodiscard]] std::optional<Eigen::Vector3f> edgeOf(const Pair& pair,
                                                      const Eigen::Isometry3f& motion) const;
  [[nodiscard]] bool isHidden(const Eigen::Vector3f& p) const;

  const RegistrationSurface& model_;
  const RegistrationSurface& seen_;
  const RegistrationSight& sight_;
  std::vector<std::uint8_t> model_ends_;  ///< by point: the object itself ends here, not only its view
  std::vector<std::uint8_t> seen_ends_;
};

}  // namespace hoctomap
