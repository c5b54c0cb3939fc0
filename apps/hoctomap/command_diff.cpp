// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iostream>
#include <memory>

#include "AtScan.h"
#include "Command.h"
#include "DiffOutput.h"
#include "TransformOption.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/AtomicFile.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/MapReader.h"

namespace hoctomap {

namespace {

struct DiffOptions {
  std::string a;
  std::string b;
  std::string transform;
  std::string output;
  bool json = false;
  bool exit_code = false;
  AtScan at_scan;
  AtScan at_scan_a;
  AtScan at_scan_b;
  double min_motion = DiffConfig{}.min_motion;
};

int compare(const DiffOptions& options) {
  const Pose a_T_b = options.transform.empty() ? Pose() : parseTransform(options.transform);
  if (!(options.min_motion >= 0.0) || !std::isfinite(options.min_motion)) {
    throw ConfigError("--min-motion must be a length in metres");
  }
  const StoredMap a = readMapAt(options.a, options.at_scan_a ? options.at_scan_a : options.at_scan);
  const StoredMap b = readMapAt(options.b, options.at_scan_b ? options.at_scan_b : options.at_scan);
  DiffConfig config;
  config.min_motion = options.min_motion;
  const std::vector<Change> changes = diff(a.hierarchy, b.hierarchy, config, toIsometry(a_T_b));
  if (!options.output.empty()) replaceFile(options.output, diffCsv(changes));
  const ComparedMap in_a{options.a, a.manifest};
  const ComparedMap in_b{options.b, b.manifest};
  std::cout << (options.json ? diffJson(in_a, in_b, a_T_b, changes) : diffText(in_a, in_b, changes))
            << std::flush;
  return options.exit_code && !changes.empty() ? 1 : 0;
}

}  // namespace

void addDiffCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<DiffOptions>();
  CLI::App* command = addCommand(
      app, "diff",
      "Say what was added, removed, moved or changed between two maps of a place, and what cannot be known",
      {"hoctomap diff before after", "hoctomap diff before after --json -o diff.csv",
       "hoctomap diff map map --at-scan-a 3 --at-scan-b 7",
       "hoctomap diff before after --transform \"0.5 0 0 90 0 0\""});
  command->add_option("a", options->a, "map directory: before")->type_name("A")->required();
  command->add_option("b", options->b, "map directory: after")->type_name("B")->required();
  command
      ->add_option("--transform", options->transform,
                   "pose of B's world in A's: \"x y z yaw pitch roll\", metres and degrees")
      ->type_name("T");
  command->add_flag("--json", options->json, "for programs");
  command->add_option("-o,--output", options->output, "also write the changes as CSV")->type_name("CSV");
  addAtScan(*command, options->at_scan, "--at-scan", "both maps as they were after scan K");
  addAtScan(*command, options->at_scan_a, "--at-scan-a", "A as it was after scan K (of a kept snapshot)");
  addAtScan(*command, options->at_scan_b, "--at-scan-b", "B as it was after scan K");
  command
      ->add_option("--min-motion", options->min_motion,
                   "metres; smaller shifts are taken for errors of the poses")
      ->type_name("M")
      ->capture_default_str();
  command->add_flag("--exit-code", options->exit_code, "exit with 1 if there is any change");
  command->callback([options, &action] { action = [options] { return compare(*options); }; });
}

}  // namespace hoctomap
