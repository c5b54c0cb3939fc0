// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hoctomap {

/// What is read of which logs, with which poses. The program takes it from its command line and hands it to
/// `hoctomap-mrpt read` through toArguments().
struct LogReadOptions {
  std::vector<std::filesystem::path> logs{};  ///< one or more, read in this order

  /// "" (poses of the log), "identity", "odometry", or a pose file.
  std::string poses{};
  /// Label of the CObservationRobotPose entries; "": the only one, else `groundtruth`.
  std::string pose_label{};
  double max_gap_s = 0.5;  ///< seconds; poses further apart than this are not interpolated between
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< what points up in the world of the poses

  std::vector<std::string> sensors{};        ///< labels; none: all
  std::uint64_t start = 0;                   ///< number of the first scan taken
  std::optional<std::uint64_t> end{};        ///< number of the first scan not taken any more
  std::uint64_t every = 1;                   ///< take every n-th of the scans of the chosen sensors
  std::optional<std::uint64_t> max_scans{};  ///< stop after this many *used* scans
  /// Scans before this number are chosen, counted and converted as always, but not sent: a continued run
  /// takes up exactly where it was, whatever `start`, `every` and `max_scans` say.
  std::uint64_t resume_at = 0;

  /// 0: all scans. Else only pairs of neighbouring ones, so many, spread evenly over those chosen otherwise;
  /// all where there are no more than those.
  std::uint64_t sample_pairs = 0;

  bool salvage = false;  ///< keep what stands before damage, with a warning, instead of an error

  std::uint64_t max_inflated_bytes = std::uint64_t{8} << 30;  ///< of each log
  double max_ratio = 100.0;                                   ///< inflated to compressed ...
  std::uint64_t ratio_free_bytes = std::uint64_t{64} << 20;   ///< ... beyond this many inflated bytes
  std::uint64_t max_points = 10'000'000;  ///< of a scan; checked by this program, not by the helper
  std::uint64_t max_object_bytes = std::uint64_t{1} << 30;
  std::uint64_t address_space_bytes = std::uint64_t{4} << 30;  ///< of the reading process
};

/// The command line of `hoctomap-mrpt read` that says the same, the same in every locale.
[[nodiscard]] std::vector<std::string> toArguments(const LogReadOptions& options);

}  // namespace hoctomap
