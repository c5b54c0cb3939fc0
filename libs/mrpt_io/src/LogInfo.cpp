// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mrpt_io/LogInfo.h"

#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "LogSurvey.h"
#include "PoseProvider.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

using Json = nlohmann::ordered_json;

Json sensorsOf(const LogSurvey& survey) {
  Json list = Json::array();
  for (const auto& s : survey.sensors) {
    Json sensor = {
        {"label", escapedText(s.label)}, {"class", s.type}, {"count", s.count}, {"gives_points", s.scan}};
    if (s.width > 0) {
      sensor["width"] = s.width;
      sensor["height"] = s.height;
    }
    if (!s.remark.empty()) sensor["remark"] = s.remark;
    list.push_back(sensor);
  }
  return list;
}

Json poseSourceOf(const std::string& kind, const std::string& label, const PoseTrack& track) {
  return {{"kind", kind},
          {"label", escapedText(label)},
          {"count", track.size()},
          {"first_stamp", track.firstStamp()},
          {"last_stamp", track.lastStamp()}};
}

Json poseSourcesOf(const LogSurvey& survey) {
  Json list = Json::array();
  if (survey.simple_map) list.push_back({{"kind", "simplemap"}});
  for (const auto& [label, track] : survey.robot_poses) {
    if (!track.empty()) list.push_back(poseSourceOf("robot_poses", label, track));
  }
  if (!survey.odometry.empty()) list.push_back(poseSourceOf("odometry", "", survey.odometry));
  if (survey.action_odometry) list.push_back({{"kind", "odometry"}, {"label", "actions"}});
  return list;
}

/// Adds `buildable` with the pose source, or the reason why not.
void judge(Json& info, const LogReadOptions& options, const std::vector<LogSurvey>& surveys) {
  const LogSurvey& survey = surveys.front();
  info["pose_source"] = nullptr;
  info["reason"] = nullptr;
  try {
    if (survey.scans == 0) throw InputError("no usable observation: no sensor gives 3D points");
    const PoseProvider poses(options, surveys);
    info["pose_source"] = poses.description();
    if (survey.damage)
      throw InputError(survey.damage->limit
                           ? "a limit was reached"
                           : "the log is damaged: --salvage keeps what stands before the damage");
    info["buildable"] = true;
  } catch (const Error& error) {
    info["buildable"] = false;
    info["reason"] = error.what();
  }
}

Json describe(const LogReadOptions& options, const std::vector<LogSurvey>& surveys) {
  const LogSurvey& survey = surveys.front();
  Json info;
  info["log"] = escapedText(options.logs.front().string());
  info["compression"] = survey.compressed ? "gz" : "none";
  info["objects"] = survey.objects;
  info["scans"] = survey.scans;
  info["first_stamp"] = survey.first_stamp ? Json(*survey.first_stamp) : Json(nullptr);
  info["last_stamp"] = survey.last_stamp ? Json(*survey.last_stamp) : Json(nullptr);
  info["duration_s"] = survey.first_stamp ? Json(*survey.last_stamp - *survey.first_stamp) : Json(nullptr);
  info["sensors"] = sensorsOf(survey);
  info["pose_sources"] = poseSourcesOf(survey);
  info["object_motions"] = survey.motions;
  info["null_objects"] = survey.null_objects;
  info["other_objects"] = survey.other_objects;
  info["buildable"] = false;
  judge(info, options, surveys);
  info["damage"] = survey.damage ? Json(survey.damage->text) : Json(nullptr);
  return info;
}

void writeSensors(std::ostream& out, const Json& info) {
  out << "sensors:\n";
  for (const auto& s : info["sensors"]) {
    out << "  '" << s["label"].get<std::string>() << "': " << s["count"] << " x "
        << s["class"].get<std::string>();
    if (s.contains("width")) out << ", " << s["width"] << " x " << s["height"];
    const bool pose = s["class"] == "CObservationRobotPose" || s["class"] == "CObservationOdometry";
    if (!s["gives_points"] && !pose) out << " (no 3D points: ignored)";
    if (s.contains("remark")) out << " (" << s["remark"].get<std::string>() << ")";
    out << "\n";
  }
}

void writePoseSources(std::ostream& out, const Json& info) {
  out << "pose sources:" << (info["pose_sources"].empty() ? " none\n" : "\n");
  for (const auto& p : info["pose_sources"]) {
    out << "  " << p["kind"].get<std::string>();
    if (p.contains("label") && p["label"] != "") out << " '" << p["label"].get<std::string>() << "'";
    if (p.contains("count")) out << ": " << p["count"];
    out << "\n";
  }
}

std::string textOf(const Json& info) {
  std::ostringstream out;
  out << "log:      " << info["log"].get<std::string>() << "\n"
      << "objects:  " << info["objects"] << " (compression: " << info["compression"].get<std::string>()
      << ")\n"
      << "scans:    " << info["scans"];
  if (!info["duration_s"].is_null())
    out << " over " << std::fixed << std::setprecision(3) << info["duration_s"].get<double>() << " s from "
        << info["first_stamp"].get<double>();
  out << "\n";
  writeSensors(out, info);
  writePoseSources(out, info);
  if (info["object_motions"] != 0) out << "object motions: " << info["object_motions"] << "\n";
  if (info["null_objects"] != 0) out << "null objects:   " << info["null_objects"] << "\n";
  if (!info["damage"].is_null()) out << "damage:   " << info["damage"].get<std::string>() << "\n";
  if (info["buildable"])
    out << "can be built: yes, with " << info["pose_source"].get<std::string>() << "\n";
  else
    out << "can be built: no: " << info["reason"].get<std::string>() << "\n";
  return out.str();
}

}  // namespace

LogInfo describeLog(const LogReadOptions& options, ReadProgress& progress) {
  registerLogClasses();
  const std::vector<LogSurvey> surveys{surveyLog(options, 0, progress)};
  if (surveys.front().damage && surveys.front().damage->limit)
    std::rethrow_exception(surveys.front().damage->error);
  const Json info = describe(options, surveys);
  return {textOf(info), info.dump(2) + "\n", surveys.front().damage.has_value()};
}

}  // namespace hoctomap
