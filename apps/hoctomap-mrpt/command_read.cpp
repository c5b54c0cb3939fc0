// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <memory>

#include "Confinement.h"
#include "ProcessGuards.h"
#include "StreamLog.h"
#include "Verb.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/mrpt_io/LogReader.h"

namespace hoctomap {

namespace {

int read(const LogReadOptions& options) {
  if (isatty(STDOUT_FILENO))
    throw ConfigError("read writes a binary stream: `hoctomap build` takes it over a pipe");
  dieWithParent();
  limitProcess(options);
  setAllocationCeiling(kLargestArray);
  const int stream = takeOverOutput();
  confine();
  return streamLog(options, stream);
}

}  // namespace

void addPoseOptions(CLI::App& verb, LogReadOptions& options) {
  verb.add_option("--poses", options.poses,
                  "FILE (t x y z yaw pitch roll, or TUM), `identity` or `odometry`");
  verb.add_option("--pose-label", options.pose_label, "label of the robot poses to use");
  verb.add_option("--max-gap", options.max_gap_s, "longest gap between poses, seconds")
      ->check(CLI::NonNegativeNumber);
}

void addBudgetOptions(CLI::App& verb, LogReadOptions& options) {
  verb.add_option("--max-inflated-bytes", options.max_inflated_bytes, "of each log");
  verb.add_option("--max-ratio", options.max_ratio, "inflated to compressed bytes");
  verb.add_option("--ratio-free-bytes", options.ratio_free_bytes, "inflated bytes before the ratio counts");
  verb.add_option("--max-object-bytes", options.max_object_bytes, "of one object of a log");
  verb.add_option("--address-space-bytes", options.address_space_bytes, "of this process");
}

void addReadCommand(CLI::App& app, VerbRun& run) {
  auto* verb = app.add_subcommand("read", "stream the scans of logs as binary messages to stdout");
  const auto options = std::make_shared<LogReadOptions>();
  const auto logs = std::make_shared<std::vector<std::string>>();
  const auto up = std::make_shared<std::vector<double>>();
  verb->add_option("-i,--input", *logs, "log; repeat for several")->required();
  addPoseOptions(*verb, *options);
  verb->add_option("--up", *up, "what points up in the world of the poses: X,Y,Z")
      ->delimiter(',')
      ->expected(3);
  verb->add_option("--sensor", options->sensors, "label of a sensor to use; repeat for several");
  verb->add_option("--start", options->start, "first scan");
  verb->add_option("--end", options->end, "scan before which to stop");
  verb->add_option("--every", options->every, "take every N-th scan")->check(CLI::PositiveNumber);
  verb->add_option("--max-scans", options->max_scans, "stop after this many used scans");
  verb->add_option("--resume-at", options->resume_at, "count, but do not send, the scans before this one");
  verb->add_option("--sample-pairs", options->sample_pairs,
                   "only so many pairs of neighbours, spread evenly");
  verb->add_flag("--salvage", options->salvage, "keep what stands before damage");
  addBudgetOptions(*verb, *options);
  verb->callback([=, &run] {
    options->logs.assign(logs->begin(), logs->end());
    if (!up->empty()) options->up = {(*up)[0], (*up)[1], (*up)[2]};
    run = [=] { return read(*options); };
  });
}

}  // namespace hoctomap
