// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Command.h"

namespace hoctomap {

/// Parses the command line and runs what was chosen. `action` is what the commands of `app` set. Every error
/// becomes one clear line and its exit code (docs/reliability.md).
int runProgram(CLI::App& app, const Action& action, int argc, char** argv);

}  // namespace hoctomap
