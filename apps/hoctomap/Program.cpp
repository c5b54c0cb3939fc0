// SPDX-License-Identifier: BSD-3-Clause
#include "Program.h"

#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "Terminal.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/ScanStream.h"

namespace hoctomap {

namespace {

int fail(const std::string& what, int exit_code) {
  // One clear line, whatever stands in the names and values of the input.
  std::cerr << coloured("hoctomap: " + what, Colour::red) << std::endl;
  return exit_code;
}

/// The problems of a configuration come one a line; anything else is one line.
std::string escapedLines(const std::string& text) {
  std::string result;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (begin > 0) result += '\n';
    result += escapedText(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

/// What is wrong with a command line, and where its help is.
std::string usageError(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first.empty()) return "which command? hoctomap --help lists them";
  const auto is_first = [&first](const CLI::App* command) { return command->check_name(first); };
  if (!first.empty() && !first.starts_with('-') && app.get_subcommands(is_first).empty()) {
    return "there is no command '" + escapedText(first) + "'; hoctomap --help lists them";
  }
  const std::vector<CLI::App*> given = app.get_subcommands();
  const std::string command = given.empty() ? "" : " " + given.front()->get_name();
  return escapedText(error.what()) + " (see hoctomap" + command + " --help)";
}

}  // namespace

int runProgram(CLI::App& app, const Action& action, int argc, char** argv) {
  app.set_version_flag("--version", "hoctomap " HOCTOMAP_VERSION);
  app.require_subcommand(1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    return fail(usageError(app, e, argc, argv), 2);
  }
  try {
    return action();
  } catch (const ConfigError& e) {
    return fail(escapedLines(e.what()), 2);
  } catch (const Error& e) {
    return fail(escapedText(e.what()), exitCodeOf(e));
  } catch (const std::bad_alloc&) {
    return fail("out of memory", 6);
  } catch (const std::exception& e) {
    return fail("internal error: " + escapedText(e.what()), 1);
  }
}

}  // namespace hoctomap
