// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hoctomap/geometry/Pose.h"
#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// A movement that the user tells (`--events`, Section III-D).
struct ToldMotion {
  std::variant<std::uint64_t, double>
      when;  ///< before this scan, or before the first scan at or after this time
  std::variant<NodeId, Eigen::Vector3d> what;  ///< a node, or the node around this point in the world
  Pose motion;
  bool in_world = false;  ///< the motion is given in the world's frame: world_T_node <- motion o world_T_node
  std::size_t line = 0;   ///< of the file
  std::string text;       ///< that line

  [[nodiscard]] bool isDue(std::uint64_t scan, double stamp) const;
};

/// Reads a CSV with a header: `scan` or `time`; `node` or `px,py,pz`; `x,y,z,yaw,pitch,roll` (metres,
/// degrees); optionally `frame` (`node`, the default, or `world`). In order of the file, which need not be
/// sorted.
/// @throws InputError naming file and line
[[nodiscard]] std::vector<ToldMotion> readMotionFile(const std::filesystem::path& file);

/// The node that a motion is about: of several around a point the deepest, then the smallest. Nothing if
/// there is none.
[[nodiscard]] std::optional<NodeId> findNode(const MapHierarchy& hierarchy, const ToldMotion& motion);

/// The motion in the node's own frame: t of t_i <- t_i o t.
[[nodiscard]] Pose motionInNodeFrame(const MapHierarchy& hierarchy, NodeId node, const ToldMotion& motion);

}  // namespace hoctomap
