// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace hoctomap {

/// Manual pages of a program and of its commands, made of the same options, descriptions and examples that
/// `--help` shows: text for man(7) by file name (`hoctomap-build.1`). Commands of commands are on the page of
/// the command. Hidden commands are left out.
[[nodiscard]] std::map<std::string, std::string> manualPages(const CLI::App& program,
                                                             const std::string& version);

/// The commands of an app that are not hidden, in their order.
[[nodiscard]] std::vector<const CLI::App*> shownCommands(const CLI::App& app);
/// Its options and positionals that are not hidden, in their order.
[[nodiscard]] std::vector<const CLI::Option*> shownOptions(const CLI::App& app);

}  // namespace hoctomap
