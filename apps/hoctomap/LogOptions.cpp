// SPDX-License-Identifier: BSD-3-Clause
#include "LogOptions.h"

#include <thread>

#include "hoctomap/config/IniDocument.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/geometry/Pose.h"

namespace hoctomap {

namespace {

Eigen::Vector3d parseUp(const std::string& text) {
  // The checks of the INI reader are those wanted here: three finite numbers, nothing else.
  IniDocument document = IniDocument::fromText("[up]\n", "--up");
  document.set("up.direction=" + text);
  const auto values = document.numbers("up", "direction", {0, 0, 1}, 3, {-1e6, 1e6});
  document.finish();
  const Eigen::Vector3d up(values[0], values[1], values[2]);
  if (up.norm() < 1e-9) throw ConfigError("--up " + text + ": the direction must not be zero");
  return up;
}

}  // namespace

void LogOptions::addTo(CLI::App& command) {
  command.add_option("-c,--config", config, "configuration (default: the built-in tabletop.ini)")
      ->type_name("INI");
  command.add_option("-i,--input", logs, "rawlog or simplemap; several are read in this order")
      ->type_name("LOG")
      ->required()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("-o,--output", output, "directory for the results; it is made")
      ->type_name("DIR")
      ->required();
  command.add_option("--poses", poses, "FILE (7 columns: MRPT, 8: TUM), 'identity' or 'odometry'")
      ->type_name("SOURCE");
  command.add_option("--pose-label", pose_label, "label of the CObservationRobotPose entries to use")
      ->type_name("L");
  command.add_option("--sensor", sensors, "use this sensor only; may be repeated")
      ->type_name("LABEL")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("--start", start, "number of the first scan, from 0")->type_name("N");
  command.add_option("--end", end, "number of the scan before which to stop")->type_name("N");
  command.add_option("--every", every, "use every N-th scan")->type_name("N")->check(CLI::PositiveNumber);
  command.add_option("--max-scans", max_scans, "stop after N scans")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command.add_option("--up", up, "what points up in the world of the poses (default 0,0,1)")
      ->type_name("X,Y,Z");
  command.add_flag("--salvage", salvage, "of a damaged log, keep what stands before the damage");
  command.add_option("--threads", threads, "threads to use (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command.add_option("--set", overrides, "override a setting; may be repeated")
      ->type_name("section.key=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_flag("-v,--verbose", verbose, "say more");
  command.add_flag("-q,--quiet", quiet, "say only warnings and errors");
}

Settings LogOptions::settings() const {
  std::optional<std::filesystem::path> file;
  if (config) file = *config;
  return loadSettings(file, overrides);
}

LogReadOptions LogOptions::readOptions(const Settings& settings) const {
  LogReadOptions read;
  for (const auto& log : logs) read.logs.emplace_back(log);
  read.poses = poses;
  read.pose_label = pose_label;
  read.max_gap_s = settings.poses.max_gap;
  if (up) read.up = parseUp(*up);
  read.sensors = sensors;
  read.start = start;
  read.end = end;
  read.every = every;
  read.max_scans = max_scans;
  read.salvage = salvage;
  read.max_inflated_bytes = static_cast<std::uint64_t>(settings.limits.max_inflated_bytes);
  read.max_ratio = settings.limits.max_inflate_ratio;
  read.max_object_bytes = static_cast<std::uint64_t>(settings.limits.max_object_bytes);
  read.max_points = static_cast<std::uint64_t>(settings.limits.max_points);
  return read;
}

std::size_t LogOptions::threadCount() const {
  if (threads > 0) return static_cast<std::size_t>(threads);
  return std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace hoctomap
