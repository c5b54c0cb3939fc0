// SPDX-License-Identifier: BSD-3-Clause
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
#include "hoctomap/report/Report.h"

namespace hoctomap {

namespace {

struct ReportOptions {
  std::vector<std::string> folders;
  std::string output;
  std::string transform;
  bool compare = false;
  bool experiments = false;
  AtScan at_scan;
  AtScan at_scan_a;
  AtScan at_scan_b;
};

/// The differences as `hoctomap diff A B --json` prints them.
std::string differences(const ReportOptions& options) {
  const Pose a_T_b = options.transform.empty() ? Pose() : parseTransform(options.transform);
  const StoredMap a = readMapAt(options.folders[0], options.at_scan_a);
  const StoredMap b = readMapAt(options.folders[1], options.at_scan_b);
  const auto changes = diff(a.hierarchy, b.hierarchy, DiffConfig{}, toIsometry(a_T_b));
  return diffJson({options.folders[0], a.manifest}, {options.folders[1], b.manifest}, a_T_b, changes);
}

std::string page(const ReportOptions& options) {
  if (options.experiments) return experimentsReport({options.folders.begin(), options.folders.end()});
  if (options.compare) {
    if (options.folders.size() != 2) throw ConfigError("--compare wants two map directories");
    return comparisonReport({options.folders[0], options.at_scan_a}, {options.folders[1], options.at_scan_b},
                            differences(options));
  }
  if (options.folders.size() != 1) {
    throw ConfigError("a report is of one map; --compare shows two, --experiments folders of experiments");
  }
  if (options.at_scan) {
    noteOlderState(options.folders[0], readManifest(options.folders[0], options.at_scan).scans,
                   options.at_scan);
  }
  return mapReport(options.folders[0], options.at_scan);
}

int report(const ReportOptions& options) {
  if (!options.transform.empty() && !options.compare) throw ConfigError("--transform goes with --compare");
  if (options.at_scan && (options.compare || options.experiments)) {
    throw ConfigError("--at-scan is for the report of one map; --compare has --at-scan-a and --at-scan-b");
  }
  if ((options.at_scan_a || options.at_scan_b) && !options.compare) {
    throw ConfigError("--at-scan-a and --at-scan-b go with --compare");
  }
  const std::string html = page(options);
  replaceFile(options.output, html);
  std::cout << "report     " << escapedText(options.output) << " (" << (html.size() + 500'000) / 1'000'000
            << " MB): open it in a browser" << std::endl;
  return 0;
}

}  // namespace

void addReportCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command = addCommand(
      app, "report",
      "Make a page for a browser that shows a map in 3D, its tree and what happened; works offline",
      {"hoctomap report map -o map.html", "hoctomap report --compare before after -o change.html",
       "hoctomap report --compare map map --at-scan-a 3 -o since.html",
       "hoctomap report --experiments out/vi-a out/vi-b -o experiments.html"});
  command
      ->add_option("folders", options->folders,
                   "a map directory; with --compare two; with --experiments some")
      ->type_name("DIR")
      ->required();
  command->add_option("-o,--output", options->output, "the page")->type_name("HTML")->required();
  auto* compare = command->add_flag("--compare", options->compare, "two maps side by side, and what changed");
  command
      ->add_option("--transform", options->transform,
                   "with --compare: pose of B's world in A's: \"x y z yaw pitch roll\", metres and degrees")
      ->type_name("T");
  command
      ->add_flag("--experiments", options->experiments,
                 "tables and figures that hoctomap-experiments wrote, as plots")
      ->excludes(compare);
  addAtScan(*command, options->at_scan);
  addAtScan(*command, options->at_scan_a, "--at-scan-a", "with --compare: A as it was after scan K");
  addAtScan(*command, options->at_scan_b, "--at-scan-b", "with --compare: B as it was after scan K");
  command->callback([options, &action] { action = [options] { return report(*options); }; });
}

}  // namespace hoctomap
