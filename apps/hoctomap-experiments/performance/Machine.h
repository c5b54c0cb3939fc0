// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measuring/Figures.h"

namespace hoctomap {

/// Processor, cores, memory, how busy the machine is, and what its memory does (`measureMachine`), in
/// Markdown.
[[nodiscard]] std::string describeMachine(const Figures& bandwidth);

/// How far an update is from what the memory of the machine allows: `name`, what the scans mean for the map
/// (`measureCells`), our update (`measureWhole`), in Markdown.
[[nodiscard]] std::string describeBound(const std::string& name, const Figures& cells, const Figures& ours,
                                        const Figures& bandwidth);

}  // namespace hoctomap
