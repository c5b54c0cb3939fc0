// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mrpt_io/LogReader.h"

#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "ExternalFiles.h"
#include "LogSurvey.h"
#include "PoseProvider.h"
#include "ScanConverter.h"
#include "ScanSelector.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/PoseTrack.h"
#include "hoctomap/io/Sha256.h"
#include "hoctomap/mrpt_io/FileHash.h"

namespace hoctomap {

namespace {

constexpr const char* kNoPose = "no pose at its time";

std::optional<NodeId> nodeOf(const std::string& label) {
  const char* first = label.data() + std::string_view(kMotionPrefix).size();
  const char* last = label.data() + label.size();
  NodeId node;
  const auto [end, error] = std::from_chars(first, last, node.value);
  if (error != std::errc{} || end != last) return std::nullopt;
  return node;
}

std::string countOf(std::uint64_t n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

}  // namespace

struct LogReader::Passes {
  Passes(LogReadOptions given, ReadProgress& shared) : options(std::move(given)), progress(shared) {
    registerLogClasses();
    surveyAll();
    checkScans();
    poses.emplace(options, surveys);
    makeHeader();
  }

  // First pass.
  void surveyAll();
  void checkDamage(std::uint32_t log);
  void warnOf(std::uint32_t log);
  void checkScans() const;
  void countChosen();
  void makeHeader();

  // Second pass.
  void streamLog(std::uint32_t log, const Sink& sink);
  void handle(const ObservationReader& reader, const Observed& observed, const std::filesystem::path& folder,
              const Sink& sink);
  void sendMotion(const ObservationReader& reader, const Observed& observed, const Sink& sink);
  void sendScan(const ObservationReader& reader, const Observed& observed,
                const std::filesystem::path& folder, const Sink& sink);
  StreamMessage messageFrom(const Observed& observed, std::uint64_t scan,
                            const std::filesystem::path& folder) const;
  [[nodiscard]] bool done() const {
    return (options.max_scans && used >= *options.max_scans) || (selector && selector->ended());
  }

  LogReadOptions options;
  ReadProgress& progress;
  std::vector<LogSurvey> surveys;
  std::vector<std::string> warnings;  // of the first pass
  std::optional<PoseProvider> poses;
  StreamHeader header;
  std::uint64_t used = 0;
  std::uint64_t skipped = 0;
  std::optional<ScanSelector> selector;
  std::set<std::string> warned;
};

LogReader::LogReader(LogReadOptions options, ReadProgress& progress)
    : passes_(std::make_unique<Passes>(std::move(options), progress)) {}

LogReader::~LogReader() = default;

const StreamHeader& LogReader::header() const {
  return passes_->header;
}

void LogReader::stream(const Sink& sink) {
  Passes& p = *passes_;
  for (const auto& warning : p.warnings) sink(StreamWarning{warning}, {});
  sink(p.header, {});
  p.selector.emplace(p.options, p.header.chosen_scans);
  for (std::uint32_t log = 0; log < p.options.logs.size() && !p.done(); ++log) p.streamLog(log, sink);
  sink(StreamEnd{p.used, p.skipped}, p.progress.get());
}

void LogReader::Passes::surveyAll() {
  if (options.logs.empty()) throw ConfigError("no log given");
  if (options.every == 0) throw ConfigError("--every must be at least 1");
  for (std::uint32_t log = 0; log < options.logs.size(); ++log) {
    surveys.push_back(surveyLog(options, log, progress));
    checkDamage(log);
    warnOf(log);
  }
}

void LogReader::Passes::checkDamage(std::uint32_t log) {
  const LogSurvey& survey = surveys[log];
  if (!survey.damage) return;
  if (!options.salvage || survey.damage->limit || survey.damage->object == 0)
    std::rethrow_exception(survey.damage->error);
  warnings.push_back("damaged: " + survey.damage->text + "; kept the " +
                     countOf(survey.damage->object, "object") + " (" + countOf(survey.scans, "scan") +
                     ") before it, lost all behind it");
}

void LogReader::Passes::warnOf(std::uint32_t log) {
  const LogSurvey& survey = surveys[log];
  const std::string name = escapedText(options.logs[log].string());
  for (const auto& sensor : survey.sensors) {
    const std::string who =
        name + ": sensor '" + escapedText(sensor.label, 100) + "' (" + sensor.type + "): ";
    const bool pose = sensor.type == "CObservationRobotPose" || sensor.type == "CObservationOdometry";
    if (!sensor.scan && !pose)
      warnings.push_back(who + countOf(sensor.count, "observation") + " without 3D points ignored");
    if (!sensor.remark.empty()) warnings.push_back(who + sensor.remark);
  }
  if (survey.null_objects > 0)
    warnings.push_back(name + ": " + countOf(survey.null_objects, "null object") + " passed over");
  if (survey.other_objects > 0)
    warnings.push_back(name + ": " + countOf(survey.other_objects, "object") +
                       " that are no observations ignored");
}

void LogReader::Passes::checkScans() const {
  if (std::any_of(surveys.begin(), surveys.end(), [](const auto& s) { return s.scans > 0; })) return;
  throw InputError(escapedText(options.logs[0].string()) +
                   ": no usable observation: no sensor gives 3D points");
}

void LogReader::Passes::makeHeader() {
  for (const auto& survey : surveys) {
    header.total_scans += survey.scans;
    for (const auto& s : survey.sensors) {
      if (!s.scan) continue;
      const auto same = std::find_if(header.sensors.begin(), header.sensors.end(),
                                     [&](const auto& h) { return h.label == s.label && h.type == s.type; });
      if (same != header.sensors.end())
        same->scans += s.count;
      else
        header.sensors.push_back({s.label, s.type, s.count, s.width, s.height});
    }
  }
  header.pose_source = poses->description();
  for (std::size_t log = 0; log < surveys.size(); ++log) {
    const std::string own = sha256OfFile(options.logs[log]);
    const std::string& external = surveys[log].external_sha256;
    header.log_sha256.push_back(external.empty() ? own : sha256Hex(own + ' ' + external));
  }
  for (const auto& wanted : options.sensors) {
    if (std::none_of(header.sensors.begin(), header.sensors.end(),
                     [&](const auto& s) { return s.label == wanted; }))
      throw InputError("--sensor '" + escapedText(wanted, 100) + "': no 3D sensor of that label in the log");
  }
  countChosen();
}

/// An upper bound: which sensor a scan is of is known in the second pass only.
void LogReader::Passes::countChosen() {
  const std::uint64_t first = std::max(options.start, options.resume_at);
  const std::uint64_t end = std::min(options.end.value_or(header.total_scans), header.total_scans);
  if (options.start >= end)
    throw InputError("no scan chosen: the log has " + countOf(header.total_scans, "scan") + ", --start is " +
                     std::to_string(options.start) +
                     (options.end ? ", --end " + std::to_string(*options.end) : std::string()));
  std::uint64_t of_sensors = 0;
  for (const auto& sensor : header.sensors) {
    const auto& wanted = options.sensors;
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), sensor.label) != wanted.end())
      of_sensors += sensor.scans;
  }
  const std::uint64_t left = first < end ? end - first : 0;
  header.chosen_scans = (std::min(of_sensors, left) + options.every - 1) / options.every;
  if (options.max_scans) header.chosen_scans = std::min(header.chosen_scans, *options.max_scans);
}

void LogReader::Passes::streamLog(std::uint32_t log, const Sink& sink) {
  ObservationReader reader(options, log, progress);
  const auto folder = imagesFolder(options.logs[log]);
  const auto& damage = surveys[log].damage;
  // Salvaging: what the first pass found whole is read again, the damage is not touched.
  while (!done() && !(damage && reader.objectsRead() >= damage->object && reader.drained())) {
    const auto observed = reader.next();
    if (!observed) return;
    handle(reader, *observed, folder, sink);
  }
}

void LogReader::Passes::handle(const ObservationReader& reader, const Observed& observed,
                               const std::filesystem::path& folder, const Sink& sink) {
  if (isScan(*observed.observation)) {
    sendScan(reader, observed, folder, sink);
  } else if (observed.observation->sensorLabel.starts_with(kMotionPrefix)) {
    sendMotion(reader, observed, sink);
  }
}

void LogReader::Passes::sendMotion(const ObservationReader& reader, const Observed& observed,
                                   const Sink& sink) {
  const auto* pose = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(observed.observation.get());
  if (pose == nullptr || !selector->started()) return;
  const auto node = nodeOf(pose->sensorLabel);
  if (!node) {
    const std::string text =
        "'" + escapedText(pose->sensorLabel, 100) + "' does not name a node (object_motion/<id>): ignored";
    if (warned.insert(text).second) sink(StreamWarning{text}, observed.position);
    return;
  }
  Pose motion;
  try {
    motion = poseFromInput(toIsometry(pose->pose.mean).matrix(), "motion");
  } catch (const InputError& error) {
    throw reader.errorHere<InputError>(error.what());
  }
  sink(ObjectMotion{stampOf(*pose).value_or(0.0), *node, motion}, observed.position);
}

void LogReader::Passes::sendScan(const ObservationReader& reader, const Observed& observed,
                                 const std::filesystem::path& folder, const Sink& sink) {
  const std::uint64_t scan = selector->nextScan();
  if (!selector->take(observed.observation->sensorLabel)) return;
  StreamMessage message;
  try {
    message = messageFrom(observed, scan, folder);
  } catch (const InputError& error) {
    throw reader.errorHere<InputError>(error.what());
  } catch (const LimitError& error) {
    throw reader.errorHere<LimitError>(error.what());
  }
  const bool was_skipped = std::holds_alternative<SkippedScan>(message);
  ++(was_skipped ? skipped : used);
  if (scan >= options.resume_at) sink(message, observed.position);
}

StreamMessage LogReader::Passes::messageFrom(const Observed& observed, std::uint64_t scan,
                                             const std::filesystem::path& folder) const {
  mrpt::obs::CObservation& observation = *observed.observation;
  const double stamp = stampOf(observation).value_or(0.0);
  // Converted even when it has no pose: a name that leads out of the folder is reported whatever the poses
  // are.
  SensorScan content = convertScan(observation, folder);
  if (const auto* unusable = std::get_if<Unusable>(&content))
    return SkippedScan{scan, stamp, unusable->reason};
  const auto world_T_base = poses->worldTBase(observed);
  if (!world_T_base) return SkippedScan{scan, stamp, kNoPose};

  Pose base_T_sensor;
  observation.getSensorPose(base_T_sensor);
  const Pose world_T_sensor =
      poseFromInput(toIsometry(*world_T_base + base_T_sensor).matrix(), "sensor pose");
  if (auto* image = std::get_if<DepthImage>(&content))
    return DepthScan{scan, stamp, observation.sensorLabel, world_T_sensor, std::move(*image)};
  return CloudScan{scan, stamp, observation.sensorLabel, world_T_sensor,
                   std::move(std::get<PointCloud>(content))};
}

}  // namespace hoctomap
