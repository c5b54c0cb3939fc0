// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/exploration/Robot.h"
#include "hoctomap/mapping/MeasurementSource.h"
#include "hoctomap/simulation/FloorPlan.h"
#include "hoctomap/simulation/Simulation.h"

namespace hoctomap {

/// A robot in the scene of a simulation that measures with its camera: both ports of exploration.
///
/// It drives on the path it is given until something of the true scene is in its way. Where it believes to be
/// is where it meant to go; where it is differs by an error that is drawn anew at the end of every drive.
/// Every draw depends on the simulation's seed and the number of the drive or scan only.
class SimulatedRobot final : public Robot, public MeasurementSource {
 public:
  /// Scans are numbered from 0; the scene's script is done by their numbers. Stamps: the simulation's start
  /// plus the time spent on driving and measuring, in steps of 1/64 s, which logs keep exactly.
  /// @param limits as for recorded scans. @param threads 0 = as many as the machine has.
  /// @throws ConfigError if the simulation has no robot, or its sensor or robot make no sense.
  explicit SimulatedRobot(const Simulation& simulation, const RangeLimits& limits = {}, int threads = 0);

  [[nodiscard]] const RobotModel& model() const override { return config_.model; }
  [[nodiscard]] Pose world_T_base() const override { return believed_.world_T_base; }
  bool moveTo(const Viewpoint& goal, std::span<const Eigen::Vector2d> path) override;

  /// A measurement of the scene as it is, at the pose that the robot believes to have. Never ends.
  [[nodiscard]] std::optional<SourceItem> next() override;

  /// Where it believes to be, with its camera, and where it is.
  [[nodiscard]] const Viewpoint& believedView() const { return believed_; }
  [[nodiscard]] Pose world_T_trueBase() const { return believed_.world_T_base + error_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }

 private:
  [[nodiscard]] Eigen::Vector2d place() const;
  void standAt(const Pose& world_T_base);
  [[nodiscard]] Pose drawError() const;

  SimulatedRobotConfig config_;
  SceneScript script_;
  std::string sensor_label_;
  std::uint64_t seed_;
  double start_stamp_;
  RangeLimits limits_;
  Scene scene_;
  SimulatedRangeSensor sensor_;
  FloorPlan plan_;
  Viewpoint believed_;
  Pose error_;
  std::uint64_t drives_ = 0;
  std::uint64_t scans_ = 0;
  double seconds_ = 0.0;  ///< spent so far
};

}  // namespace hoctomap
