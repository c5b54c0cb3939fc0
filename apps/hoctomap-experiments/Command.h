// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace hoctomap {

/// What a chosen subcommand runs; returns the exit code. Errors are thrown and become exit codes in main().
using Action = std::function<int()>;

// One a subcommand, each in command_<name>.cpp: adds its options to `app`, and sets `action` when it is
// chosen.
void addViACommand(CLI::App& app, Action& action);
void addViBCommand(CLI::App& app, Action& action);
void addViCCommand(CLI::App& app, Action& action);
void addPerformanceCommand(CLI::App& app, Action& action);
void addChangesCommand(CLI::App& app, Action& action);
void addIdentityCommand(CLI::App& app, Action& action);
void addSegmentationCommand(CLI::App& app, Action& action);
void addBuildingCommand(CLI::App& app, Action& action);
void addLargeMapCommand(CLI::App& app, Action& action);
void addMeasureCommand(CLI::App& app, Action& action);

}  // namespace hoctomap
