// SPDX-License-Identifier: BSD-3-Clause
#include "Command.h"

namespace hoctomap {

CLI::App* addCommand(CLI::App& app, const std::string& name, const std::string& what,
                     const std::vector<std::string>& examples) {
  CLI::App* command = app.add_subcommand(name, what);
  std::string footer = examples.size() == 1 ? "\nExample:" : "\nExamples:";
  for (const auto& example : examples) footer += "\n  " + example;
  command->footer(footer + "\n");
  return command;
}

}  // namespace hoctomap
