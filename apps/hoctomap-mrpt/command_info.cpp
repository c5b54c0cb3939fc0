// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <iostream>
#include <memory>

#include "Confinement.h"
#include "ProcessGuards.h"
#include "Verb.h"
#include "hoctomap/mrpt_io/LogInfo.h"

namespace hoctomap {

void addInfoCommand(CLI::App& app, VerbRun& run) {
  auto* verb = app.add_subcommand("info", "what a log holds and whether it can be built");
  const auto options = std::make_shared<LogReadOptions>();
  const auto log = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  verb->add_option("log", *log, "rawlog or simplemap")->required();
  verb->add_flag("--json", *json, "as JSON");
  addPoseOptions(*verb, *options);
  addBudgetOptions(*verb, *options);
  verb->callback([=, &run] {
    options->logs = {*log};
    run = [=] {
      dieWithParent();
      limitProcess(*options);
      setAllocationCeiling(kLargestArray);
      confine();
      ReadProgress progress;
      reportCrashes(LastWord::line_of_text, STDERR_FILENO, options->logs, progress);
      const LogInfo info = describeLog(*options, progress);
      std::cout << (*json ? info.json : info.text) << std::flush;
      return info.damaged ? 3 : 0;
    };
  });
}

}  // namespace hoctomap
