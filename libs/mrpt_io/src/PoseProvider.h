// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "LogSurvey.h"

namespace hoctomap {

/// The one pose source of a run (design.md, "Input poses").
class PoseProvider {
 public:
  /// Chooses the source.
  /// @throws InputError if there is none, naming the options; ConfigError for a label that no entry has.
  PoseProvider(const LogReadOptions& options, const std::vector<LogSurvey>& surveys);

  /// Pose of the robot's base for a scan, in the levelled world; nothing if the source has none at its time.
  [[nodiscard]] std::optional<Pose> worldTBase(const Observed& scan) const;

  /// For the log of the run: `robot poses 'groundtruth'`.
  [[nodiscard]] const std::string& description() const { return description_; }

 private:
  enum class Kind { simple_map, file, robot_poses, odometry, identity };

  void chooseRobotPoses(const LogReadOptions& options, const std::vector<LogSurvey>& surveys);
  [[nodiscard]] std::optional<Pose> inSourceFrame(const Observed& scan) const;
  [[nodiscard]] const PoseTrack* trackOf(std::uint32_t log) const;

  const std::vector<LogSurvey>& surveys_;
  double max_gap_;
  Pose world_T_source_;
  Kind kind_ = Kind::identity;
  PoseTrack file_;
  std::string label_;
  std::string description_;
};

}  // namespace hoctomap
