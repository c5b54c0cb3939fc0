// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace hoctomap {

/// A script for bash that completes commands, options, and the values of options with a fixed choice; file
/// names everywhere else.
[[nodiscard]] std::string bashCompletion(const CLI::App& program);

}  // namespace hoctomap
