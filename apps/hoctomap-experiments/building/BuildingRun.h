// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "hoctomap/config/Settings.h"
#include "hoctomap/simulation/Simulation.h"
#include "measuring/Stopwatch.h"

namespace hoctomap {

/// Takes the walk as a log.
void writeBuildingLog(const Simulation& building, const std::filesystem::path& log);

/// What mapping a log cost, scan by scan.
struct BuildingRun {
  std::vector<Elapsed> scans;      ///< all of the mapping, and of the commits
  std::vector<Elapsed> commits;    ///< of the same scans; of those without a commit nothing
  std::vector<std::size_t> nodes;  ///< of the hierarchy after each scan
  std::uint64_t memory_bytes = 0;  ///< by which the process grew at most
};

/// Maps a log in this process as `hoctomap build` does, with a commit to `directory` (new) every
/// `checkpoint_scans` scans. `progress` is told the scan.
[[nodiscard]] BuildingRun mapBuilding(const std::filesystem::path& log, const Settings& settings,
                                      const std::filesystem::path& directory,
                                      const std::function<void(std::uint64_t)>& progress);

}  // namespace hoctomap
