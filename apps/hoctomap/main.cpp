// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>
#include <new>

#include "Command.h"
#include "Terminal.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/ScanStream.h"

namespace {

int fail(const std::string& what, int exit_code) {
  // One clear line, whatever stands in the names and values of the input.
  std::cerr << hoctomap::coloured("hoctomap: " + what, hoctomap::Colour::red) << std::endl;
  return exit_code;
}

/// The problems of a configuration come one a line; anything else is one line.
std::string escapedLines(const std::string& text) {
  std::string result;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (begin > 0) result += '\n';
    result += hoctomap::escapedText(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "hoctomap turns recorded 3D measurements with known sensor poses into a hierarchy of octree maps."};
  app.name("hoctomap");
  app.set_version_flag("--version", "hoctomap " HOCTOMAP_VERSION);
  app.require_subcommand(1);
  app.footer(
      "\nExit codes: 0 done, 2 usage or configuration, 3 input, 4 map, 5 files, 6 limit, 130/143 stopped.\n"
      "Help of a command: hoctomap COMMAND --help\n");
  hoctomap::Action action;
  hoctomap::addBuildCommand(app, action);
  hoctomap::addSegmentCommand(app, action);
  hoctomap::addInfoCommand(app, action);
  hoctomap::addRenderCommand(app, action);
  hoctomap::addReportCommand(app, action);
  hoctomap::addExplainCommand(app, action);
  hoctomap::addDiffCommand(app, action);
  hoctomap::addQueryCommand(app, action);
  hoctomap::addEditCommand(app, action);
  hoctomap::addMergeCommand(app, action);
  hoctomap::addVerifyCommand(app, action);
  hoctomap::addExportCommand(app, action);
  hoctomap::addImportCommand(app, action);
  hoctomap::addSimulateCommand(app, action);
  hoctomap::addExploreCommand(app, action);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    return fail(hoctomap::escapedText(e.what()) + " (see hoctomap --help)", 2);
  }
  try {
    return action();
  } catch (const hoctomap::ConfigError& e) {
    return fail(escapedLines(e.what()), 2);
  } catch (const hoctomap::Error& e) {
    return fail(hoctomap::escapedText(e.what()), hoctomap::exitCodeOf(e));
  } catch (const std::bad_alloc&) {
    return fail("out of memory", 6);
  } catch (const std::exception& e) {
    return fail("internal error: " + hoctomap::escapedText(e.what()), 1);
  }
}
