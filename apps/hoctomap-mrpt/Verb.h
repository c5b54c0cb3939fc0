// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "hoctomap/io/LogReadOptions.h"

namespace hoctomap {

/// What the chosen verb does; returns the exit code.
using VerbRun = std::function<int()>;

// One function a verb, in command_<verb>.cpp: adds the verb's subcommand with its options to `app`, and lets
// its callback store in `run` what is to be done. Errors are thrown (hoctomap/geometry/Errors.h); main()
// turns them into one line on stderr and the exit code.
void addReadCommand(CLI::App& app, VerbRun& run);
void addWriteLogCommand(CLI::App& app, VerbRun& run);
void addInfoCommand(CLI::App& app, VerbRun& run);
void addSceneCommand(CLI::App& app, VerbRun& run);
void addRenderCommand(CLI::App& app, VerbRun& run);

/// The options that `read` and `info` share: poses and budgets.
void addPoseOptions(CLI::App& verb, LogReadOptions& options);
void addBudgetOptions(CLI::App& verb, LogReadOptions& options);

}  // namespace hoctomap
