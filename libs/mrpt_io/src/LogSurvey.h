// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ObservationReader.h"
#include "ScanSelector.h"
#include "hoctomap/io/PoseTrack.h"

namespace hoctomap {

inline constexpr const char* kMotionPrefix = "object_motion/";

/// One sensor of a log: a label with a class.
struct SensorSurvey {
  std::string label;
  std::string type;
  std::uint64_t count = 0;
  bool scan = false;  ///< gives 3D points
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string remark;
};

/// Damage of a log; what stands before it is whole.
struct Damage {
  std::exception_ptr error;
  std::string text;
  bool limit = false;        ///< a limit was reached: nothing of such a log is used
  std::uint64_t object = 0;  ///< the first object that is not whole
};

/// What one log holds: the result of reading it once from end to end, poses kept, scans dropped.
struct LogSurvey {
  std::vector<SensorSurvey> sensors;             ///< in the order of their first appearance
  std::map<std::string, PoseTrack> robot_poses;  ///< by label, object motions excluded
  PoseTrack odometry;                            ///< of CObservationOdometry
  bool action_odometry = false;
  bool simple_map = false;
  bool compressed = false;
  std::uint64_t objects = 0;
  std::uint64_t null_objects = 0;
  std::uint64_t other_objects = 0;
  std::uint64_t scans = 0;
  std::uint64_t motions = 0;
  std::optional<double> first_stamp;  ///< seconds since the epoch, of the scans
  std::optional<double> last_stamp;
  std::optional<Damage> damage;
  /// Over names and contents of the files that scans store outside of the log, in hex; empty if none does.
  std::string external_sha256;
};

/// Reads log number `log` once; damage is reported in the result, not thrown.
/// @throws InputError if the file cannot be opened.
[[nodiscard]] LogSurvey surveyLog(const LogReadOptions& options, std::uint32_t log, ReadProgress& progress);

/// Seconds since the epoch; nothing for MRPT's invalid time.
[[nodiscard]] std::optional<double> stampOf(const mrpt::obs::CObservation& observation);

/// Class name without its namespaces, as users know it.
[[nodiscard]] std::string typeName(const mrpt::obs::CObservation& observation);

}  // namespace hoctomap
