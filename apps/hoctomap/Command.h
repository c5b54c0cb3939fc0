// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace hoctomap {

/// What a chosen subcommand runs; returns the exit code. Errors are thrown and become exit codes in main().
using Action = std::function<int()>;

// One a subcommand, each in command_<verb>.cpp: adds its options to `app`, and sets `action` when it is
// chosen.
void addBuildCommand(CLI::App& app, Action& action);
void addSegmentCommand(CLI::App& app, Action& action);
void addInfoCommand(CLI::App& app, Action& action);
void addRenderCommand(CLI::App& app, Action& action);
void addReportCommand(CLI::App& app, Action& action);
void addExplainCommand(CLI::App& app, Action& action);
void addDiffCommand(CLI::App& app, Action& action);
void addQueryCommand(CLI::App& app, Action& action);
void addEditCommand(CLI::App& app, Action& action);
void addMergeCommand(CLI::App& app, Action& action);
void addVerifyCommand(CLI::App& app, Action& action);
void addExportCommand(CLI::App& app, Action& action);
void addImportCommand(CLI::App& app, Action& action);
void addSimulateCommand(CLI::App& app, Action& action);
void addExploreCommand(CLI::App& app, Action& action);
void addDocumentationCommand(CLI::App& app, Action& action);

/// Adds a subcommand with a help text that ends in examples, one a line.
CLI::App* addCommand(CLI::App& app, const std::string& name, const std::string& what,
                     const std::vector<std::string>& examples);

}  // namespace hoctomap
