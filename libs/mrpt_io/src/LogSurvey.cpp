// SPDX-License-Identifier: BSD-3-Clause
#include "LogSurvey.h"

#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <utility>

#include "ExternalFiles.h"
#include "ScanConverter.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

namespace {

void countSensor(LogSurvey& survey, const mrpt::obs::CObservation& observation) {
  constexpr std::size_t kMaxSensors = 10'000;  // a hostile log may name each observation anew
  const std::string type = typeName(observation);
  auto sensor = std::find_if(survey.sensors.begin(), survey.sensors.end(), [&](const SensorSurvey& s) {
    return s.label == observation.sensorLabel && s.type == type;
  });
  if (sensor == survey.sensors.end()) {
    if (survey.sensors.size() >= kMaxSensors) throw LimitError("more than 10000 sensor labels");
    SensorSurvey fresh;
    fresh.label = observation.sensorLabel;
    fresh.type = type;
    fresh.scan = isScan(observation);
    survey.sensors.push_back(fresh);
    sensor = std::prev(survey.sensors.end());
  }
  ++sensor->count;
  if (sensor->width == 0) std::tie(sensor->width, sensor->height) = imageSize(observation);
  if (sensor->remark.empty()) sensor->remark = remarkOn(observation);
}

/// Names and contents of the files beside a log, in the order in which it names them.
class ExternalContents {
 public:
  explicit ExternalContents(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void add(const mrpt::obs::CObservation& observation) {
    for (const std::string& name : externalNames(observation)) {
      any_ = true;
      hash_.add(name + '\n' + contentOf(name) + '\n');
    }
  }
  [[nodiscard]] std::string sha256() const { return any_ ? hash_.copy().hex() : std::string(); }

 private:
  /// Names that are not allowed are reported when the scan is read.
  [[nodiscard]] std::string contentOf(const std::string& name) const {
    try {
      const ExternalFile file(folder_, name);
      return file.exists() ? file.sha256() : "missing";
    } catch (const InputError&) {
      return "refused";
    }
  }

  std::filesystem::path folder_;
  Sha256 hash_;
  bool any_ = false;
};

/// Keeps the poses of an observation; a scan is counted.
void take(LogSurvey& survey, const Observed& observed) {
  const mrpt::obs::CObservation& observation = *observed.observation;
  countSensor(survey, observation);
  survey.action_odometry = survey.action_odometry || observed.odometry_T_base != nullptr;
  const std::optional<double> stamp = stampOf(observation);
  if (const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation)) {
    if (pose->sensorLabel.starts_with(kMotionPrefix)) {
      ++survey.motions;
    } else if (stamp) {
      // The pose is that of what `sensorPose` mounts on the base.
      survey.robot_poses[pose->sensorLabel].add(*stamp, pose->pose.mean + -pose->sensorPose);
    }
  } else if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
    if (stamp) survey.odometry.add(*stamp, Pose(odometry->odometry));
  } else if (isScan(observation)) {
    ++survey.scans;
    if (stamp) {
      survey.first_stamp = std::min(survey.first_stamp.value_or(*stamp), *stamp);
      survey.last_stamp = std::max(survey.last_stamp.value_or(*stamp), *stamp);
    }
  }
}

void readAll(LogSurvey& survey, ObservationReader& reader, ExternalContents& externals) {
  try {
    while (auto observed = reader.next()) {
      try {
        take(survey, *observed);
        externals.add(*observed->observation);
      } catch (const InputError& error) {
        throw reader.errorHere<InputError>(error.what());
      } catch (const LimitError& error) {
        throw reader.errorHere<LimitError>(error.what());
      }
    }
  } catch (const std::exception& error) {
    const bool limit = dynamic_cast<const LimitError*>(&error) || dynamic_cast<const std::bad_alloc*>(&error);
    survey.damage = Damage{std::current_exception(), error.what(), limit, reader.objectsRead()};
  }
}

}  // namespace

LogSurvey surveyLog(const LogReadOptions& options, std::uint32_t log, ReadProgress& progress) {
  ObservationReader reader(options, log, progress);
  LogSurvey survey;
  ExternalContents externals(imagesFolder(options.logs[log]));
  readAll(survey, reader, externals);
  survey.external_sha256 = externals.sha256();
  survey.compressed = reader.compressed();
  survey.simple_map = reader.hasSimpleMap();
  survey.objects = reader.objectsRead();
  survey.null_objects = reader.nullObjects();
  survey.other_objects = reader.otherObjects();
  try {
    for (auto& [label, track] : survey.robot_poses) track.finish();
    survey.odometry.finish();
  } catch (const InputError& error) {
    if (!survey.damage)
      survey.damage =
          Damage{std::make_exception_ptr(reader.errorHere<InputError>(error.what())), error.what(), false, 0};
  }
  return survey;
}

std::optional<double> stampOf(const mrpt::obs::CObservation& observation) {
  if (observation.timestamp == INVALID_TIMESTAMP) return std::nullopt;
  return mrpt::Clock::toDouble(observation.timestamp);
}

std::string typeName(const mrpt::obs::CObservation& observation) {
  const std::string name = observation.GetRuntimeClass()->className;
  const auto colon = name.rfind(':');
  return colon == std::string::npos ? name : name.substr(colon + 1);
}

}  // namespace hoctomap
