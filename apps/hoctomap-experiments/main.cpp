// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>
#include <new>

#include "Command.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/ScanStream.h"

namespace {

int fail(const std::string& what, int exit_code) {
  std::cerr << "hoctomap-experiments: " << hoctomap::escapedText(what) << std::endl;
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The experiments of the paper (Section VI), and how fast hoctomap is beside stock OctoMap."};
  app.name("hoctomap-experiments");
  app.require_subcommand(1);
  app.footer("\nHelp of a command: hoctomap-experiments COMMAND --help\n");
  hoctomap::Action action;
  hoctomap::addViACommand(app, action);
  hoctomap::addViBCommand(app, action);
  hoctomap::addViCCommand(app, action);
  hoctomap::addPerformanceCommand(app, action);
  hoctomap::addChangesCommand(app, action);
  hoctomap::addIdentityCommand(app, action);
  hoctomap::addSegmentationCommand(app, action);
  hoctomap::addBuildingCommand(app, action);
  hoctomap::addLargeMapCommand(app, action);
  hoctomap::addMeasureCommand(app, action);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help
    return fail(e.what(), 2);
  }
  try {
    return action();
  } catch (const hoctomap::Error& e) {
    return fail(e.what(), hoctomap::exitCodeOf(e));
  } catch (const std::bad_alloc&) {
    return fail("out of memory", 6);
  } catch (const std::exception& e) {
    return fail(std::string("internal error: ") + e.what(), 1);
  }
}
