// SPDX-License-Identifier: BSD-3-Clause
#include "PoseProvider.h"

#include <algorithm>
#include <set>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

constexpr const char* kDefaultLabel = "groundtruth";

std::string quotedList(const std::set<std::string>& labels) {
  std::string list;
  for (const auto& label : labels) list += (list.empty() ? "'" : ", '") + escapedText(label, 100) + "'";
  return list;
}

std::optional<Pose> optionalPose(const std::shared_ptr<const Pose>& pose) {
  if (!pose) return std::nullopt;
  return *pose;
}

/// The label to use out of those present; nothing if there is no telling.
std::optional<std::string> choose(const std::string& asked, const std::set<std::string>& present) {
  const std::string wanted = !asked.empty() ? asked : present.size() == 1 ? *present.begin() : kDefaultLabel;
  if (present.contains(wanted)) return wanted;
  return std::nullopt;
}

}  // namespace

PoseProvider::PoseProvider(const LogReadOptions& options, const std::vector<LogSurvey>& surveys)
    : surveys_(surveys), max_gap_(options.max_gap_s), world_T_source_(levelled(options.up)) {
  const bool simple_map =
      std::any_of(surveys.begin(), surveys.end(), [](const auto& s) { return s.simple_map; });
  if (simple_map) {
    kind_ = Kind::simple_map;
    description_ = "the simple map's own poses";
    if (!options.poses.empty()) throw ConfigError("--poses: a .simplemap brings its own poses");
  } else if (options.poses == "identity") {
    description_ = "identity (on request): the sensor's pose on the robot is its pose in the world";
  } else if (options.poses == "odometry") {
    kind_ = Kind::odometry;
    description_ = "odometry (on request)";
    const bool any = std::any_of(surveys.begin(), surveys.end(),
                                 [](const auto& s) { return !s.odometry.empty() || s.action_odometry; });
    if (!any) throw InputError("--poses odometry: the log holds no odometry");
  } else if (!options.poses.empty()) {
    kind_ = Kind::file;
    file_ = readPoseFile(options.poses);
    description_ =
        "pose file " + escapedText(options.poses) + " (" + std::to_string(file_.size()) + " poses)";
  } else {
    kind_ = Kind::robot_poses;
    chooseRobotPoses(options, surveys);
  }
}

void PoseProvider::chooseRobotPoses(const LogReadOptions& options, const std::vector<LogSurvey>& surveys) {
  std::set<std::string> present;
  bool odometry = false;
  for (const auto& survey : surveys) {
    odometry = odometry || survey.action_odometry || !survey.odometry.empty();
    for (const auto& [label, track] : survey.robot_poses) present.insert(label);
  }
  const auto label = choose(options.pose_label, present);
  if (!label) {
    const std::string tail = std::string("; give --poses FILE, ") + (odometry ? "--poses odometry, " : "") +
                             "or --poses identity if the sensor's pose on the robot is its pose in the world";
    if (present.empty()) {
      throw InputError(escapedText(options.logs[0].string()) +
                       ": no poses: there are no CObservationRobotPose entries" + tail);
    }
    const std::string list = "robot poses are labelled " + quotedList(present);
    if (!options.pose_label.empty())
      throw InputError("--pose-label '" + escapedText(options.pose_label, 100) + "': " + list + tail);
    throw InputError("no poses: " + list + ": choose with --pose-label" + tail);
  }
  label_ = *label;
  description_ = "robot poses '" + escapedText(label_, 100) + "' of the log";
}

std::optional<Pose> PoseProvider::worldTBase(const Observed& scan) const {
  auto pose = inSourceFrame(scan);
  if (pose) pose = world_T_source_ + *pose;
  return pose;
}

std::optional<Pose> PoseProvider::inSourceFrame(const Observed& scan) const {
  if (kind_ == Kind::simple_map) return optionalPose(scan.map_T_base);
  if (kind_ == Kind::identity) return Pose();
  const PoseTrack* track = trackOf(scan.position.log);
  if (track == nullptr) return optionalPose(scan.odometry_T_base);  // summed up from actions
  const auto stamp = stampOf(*scan.observation);
  return stamp ? track->at(*stamp, max_gap_) : std::nullopt;
}

/// The track that holds for a log; none where odometry comes from actions. Logs do not share their poses:
/// each has its own clock and world.
const PoseTrack* PoseProvider::trackOf(std::uint32_t log) const {
  static const PoseTrack none;
  if (kind_ == Kind::file) return &file_;
  const LogSurvey& survey = surveys_[log];
  if (kind_ == Kind::odometry) return survey.odometry.empty() ? nullptr : &survey.odometry;
  const auto found = survey.robot_poses.find(label_);
  return found == survey.robot_poses.end() ? &none : &found->second;
}

}  // namespace hoctomap
