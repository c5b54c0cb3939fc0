// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/simulation/Scene.h"

namespace hoctomap {

enum class SceneAction {
  appear,  ///< an absent solid is there, where told or else where it was
  vanish,  ///< a present solid is gone, with all that stands on it
  move,    ///< a solid and all that stands on it is somewhere else
  swap     ///< two solids exchange their places (support and pose)
};

/// One change, done before the scan with that number is taken.
struct SceneEvent {
  std::uint64_t scan = 0;
  SceneAction action = SceneAction::move;
  std::string solid;
  /// appear, move: the new place; what is not given stays. Relative to the top of the support.
  std::optional<Eigen::Vector3d> position{};
  std::optional<Eigen::Vector3d> yaw_pitch_roll{};  ///< radians
  std::optional<std::string> support{};             ///< name of a solid, or `world`
  std::string other{};                              ///< swap: the second solid
};

/// What happens to a scene, scan by scan. Events of one scan are done in the order given.
class SceneScript {
 public:
  SceneScript() = default;
  explicit SceneScript(std::vector<SceneEvent> events);

  [[nodiscard]] const std::vector<SceneEvent>& events() const { return events_; }

  /// Does the events of one scan.
  /// @throws ConfigError if an event makes no sense: unknown solid, appearance of what is there,
  /// disappearance
  ///         or swap of what is not, a solid put on itself, an event without effect.
  void apply(Scene& scene, std::uint64_t scan) const;

  /// The scene as scan `scan` sees it, starting from `initial`.
  [[nodiscard]] Scene at(Scene initial, std::uint64_t scan) const;

 private:
  std::vector<SceneEvent> events_;  // ascending by scan
};

}  // namespace hoctomap
