// SPDX-License-Identifier: BSD-3-Clause
#include <signal.h>

#include <iostream>
#include <memory>

#include "AtScan.h"
#include "Command.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapDescription.h"
#include "hoctomap/io/MapReader.h"

namespace hoctomap {

namespace {

struct InfoOptions {
  std::string path;
  bool json = false;
  AtScan at_scan;
};

int info(const InfoOptions& options) {
  if (std::filesystem::is_directory(options.path)) {
    const Manifest manifest = readManifestAt(options.path, options.at_scan);
    const auto damage = findDamage(options.path, manifest);
    if (!damage.empty()) {
      throw MapError(
          options.path + "/" + damage.front().path + ": " + damage.front().what +
          (damage.size() > 1 ? " (and " + std::to_string(damage.size() - 1) + " more files)" : ""));
    }
    std::cout << (options.json ? mapJson(manifest) : describeMap(manifest)) << std::flush;
    return 0;
  }
  if (options.at_scan) throw ConfigError("--at-scan is for maps; " + options.path + " is no map directory");
  std::vector<std::string> arguments{"info", options.path};
  if (options.json) arguments.emplace_back("--json");
  const int code = runHelper(arguments);
  // A reader that crashes says so itself; one that is killed cannot.
  if (code == 128 + SIGKILL)
    throw LimitError(options.path + ": the log reader was killed, out of memory or of processor time");
  return code;
}

}  // namespace

void addInfoCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* command =
      addCommand(app, "info", "Say what a log holds and whether it can be built, or show the tree of a map",
                 {"hoctomap info log.rawlog", "hoctomap info map --json"});
  command->add_option("path", options->path, "a log or a map directory")->type_name("LOG|DIR")->required();
  command->add_flag("--json", options->json, "for programs");
  addAtScan(*command, options->at_scan);
  command->callback([options, &action] { action = [options] { return info(*options); }; });
}

}  // namespace hoctomap
