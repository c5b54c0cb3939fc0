// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "measuring/Tasks.h"

namespace hoctomap {

/// Takes the measurement in a process of its own: this program again, as `measure`.
/// @return nothing if the task's limits were reached
/// @throws InputError if it failed for another reason, which it has said on stderr
[[nodiscard]] std::optional<Figures> measureApart(const Task& task);

/// Runs a program to its end, with its stdout dropped.
/// Figures: wall_s, user_s, cpu_s and max_rss_bytes, of the program and of the programs it has run.
/// @throws InputError if it fails
[[nodiscard]] Figures runApart(const std::filesystem::path& program,
                               const std::vector<std::string>& arguments);

/// The path of this program.
[[nodiscard]] std::filesystem::path thisProgram();

/// The program `hoctomap` beside this one, or in the build tree that this program lies in.
/// @throws FileError if there is none
[[nodiscard]] std::filesystem::path findHoctomap();

}  // namespace hoctomap
