// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "hoctomap/exploration/Robot.h"
#include "hoctomap/mapping/HierarchyMapper.h"

namespace hoctomap::testing {

/// A world of axis-aligned boxes, each of which knows what it is.
struct BoxWorld {
  struct Thing {
    Label label;
    Eigen::AlignedBox3d box;
  };
  std::vector<Thing> things;

  void add(const Label& label, const Eigen::AlignedBox3d& box) { things.push_back({label, box}); }
  /// Lengths of the direction to the first surface; nothing if there is none.
  [[nodiscard]] std::optional<double> cast(const Eigen::Vector3d& origin,
                                           const Eigen::Vector3d& direction) const;
  /// The thing whose surface a point lies on.
  [[nodiscard]] std::size_t nearest(const Eigen::Vector3d& point) const;

  /// A floor of 6 x 6 m with walls, without furniture.
  static BoxWorld room();
  /// A table of 0.8 x 0.5 m with the upper face at 0.7 m, and two boxes on it.
  void addTable(double x, double y);
};

/// A mapper that knows the things of the world: S, L and f_A by truth. Tables support objects.
[[nodiscard]] HierarchyMapper truthfulMapper(const BoxWorld& world);

/// A robot in a world of boxes. It gets everywhere, unless told otherwise.
class BoxRobot : public Robot, public MeasurementSource {
 public:
  BoxRobot(const BoxWorld& world, const Eigen::Vector2d& start);

  [[nodiscard]] const RobotModel& model() const override { return model_; }
  [[nodiscard]] Pose world_T_base() const override { return at_.world_T_base; }
  bool moveTo(const Viewpoint& goal, std::span<const Eigen::Vector2d> path) override;
  [[nodiscard]] std::optional<SourceItem> next() override;

  std::function<bool(const Eigen::Vector2d&)>
      refuses;  ///< places that it cannot get to, although they look free
  std::function<bool(const Eigen::Vector2d&)>
      stops;           ///< places that it cannot drive through: it stands before them
  bool blind = false;  ///< no measurements
  int drives = 0;

 private:
  const BoxWorld& world_;
  RobotModel model_;
  Viewpoint at_;
  std::uint64_t scans_ = 0;
};

}  // namespace hoctomap::testing
