// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ClosestPoints.h"
#include "hoctomap/mapping/Registration.h"

namespace hoctomap {

/// Says how well a motion takes the surface of a known object onto one that may show it: the shares of both
/// that overlap, what the scan contradicts, and the verdict.
class MotionJudge {
 public:
  /// All must outlive this object.
  MotionJudge(const RegistrationSurface& model, const RegistrationSurface& seen, const ClosestPoints& points,
              const RegistrationConfig& config, const RegistrationSight& sight)
      : config_(config),
        sight_(sight),
        near_(static_cast<float>(config.near + config.tolerance)),
        model_(model),
        seen_(seen),
        points_(points) {}

  /// @param motion   of the model about its origin, onto what is seen about the origin of that
  /// @param samples  points of each surface that are asked, about
  [[nodiscard]] Registration judged(const Eigen::Isometry3f& motion, std::size_t samples) const;

  /// m, within which two surfaces overlap.
  [[nodiscard]] float near() const { return near_; }

  /// From motions of the surfaces about their origins to those of the world, and back.
  [[nodiscard]] Eigen::Isometry3d toWorld(const Eigen::Isometry3f& motion) const;
  [[nodiscard]] Eigen::Isometry3f toLocal(const Eigen::Isometry3d& motion) const;

 private:
  /// Whether a seen point faces a way that nothing of the model does.
  [[nodiscard]] bool isNewSide(std::size_t seen, const Eigen::Isometry3f& back) const;
  /// What the scan says of a point of the model.
  [[nodiscard]] Sight sightOf(std::size_t model, const Eigen::Isometry3f& motion) const;
  /// Difference of the tops, m.
  [[nodiscard]] double heightError(const Eigen::Isometry3f& motion) const;
  [[nodiscard]] Match verdict(const Registration& r, double visible, double height_error) const;

  const RegistrationConfig& config_;
  const RegistrationSight& sight_;
  float near_;
  const RegistrationSurface& model_;
  const RegistrationSurface& seen_;
  const ClosestPoints& points_;
};

}  // namespace hoctomap
