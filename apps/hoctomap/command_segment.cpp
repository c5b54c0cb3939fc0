// SPDX-License-Identifier: BSD-3-Clause
#include <tbb/global_control.h>

#include <chrono>
#include <iostream>
#include <memory>

#include "Command.h"
#include "LogOptions.h"
#include "MappingSetup.h"
#include "Progress.h"
#include "RunSummary.h"
#include "SegmentWriter.h"
#include "hoctomap/io/PipeSource.h"
#include "hoctomap/tabletop/LabelRules.h"

namespace hoctomap {

namespace {

int segment(const LogOptions& options, bool overwrite) {
  const Settings settings = options.settings();
  RunLog log(options.verbose, options.quiet);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, options.threadCount());
  PipeSource source(options.readOptions(settings), RangeLimits{settings.sensor.min_range},
                    [&log](const std::string& text) { log.warn(text); });
  SegmentWriter writer(options.output, overwrite);
  log.writeTo(std::filesystem::path(options.output) / "log.txt");

  const auto segmentation = makeSegmentation(settings);
  const auto labeling = makeTabletopLabeling(settings.labelRules());
  RunSummary summary;
  {
    Progress progress(log, source.totalScans(), options.quiet);
    while (const auto item = source.next()) {
      if (const auto* z = std::get_if<Measurement>(&*item)) {
        const auto start = std::chrono::steady_clock::now();
        const auto segments = segmentation->segment(*z);
        summary.addSeconds("segment",
                           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        summary.addUsed(*z);
        writer.write(*z, segments, *labeling);
      } else if (const auto* skipped = std::get_if<SkippedScan>(&*item)) {
        summary.addSkipped(*skipped);
      }
      progress.show(summary.used() + summary.skipped(), std::nullopt);
    }
  }
  writer.finish();
  std::cout << summary.text() << "labels     " << options.output << std::endl;
  return summary.skippedMoreThan(settings.limits.max_skipped_share) ? 3 : 0;
}

}  // namespace

void addSegmentCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<LogOptions>();
  auto overwrite = std::make_shared<bool>(false);
  CLI::App* command =
      addCommand(app, "segment", "Write what segmentation and labelling say of every scan, without a map",
                 {"hoctomap segment -i log.rawlog -o labels"});
  options->addTo(*command);
  command->add_flag("--overwrite", *overwrite, "replace the results in DIR");
  command->callback([options, overwrite, &action] {
    action = [options, overwrite] { return segment(*options, *overwrite); };
  });
}

}  // namespace hoctomap
