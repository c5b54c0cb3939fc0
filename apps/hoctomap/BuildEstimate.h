// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "hoctomap/config/Settings.h"
#include "hoctomap/io/PipeSource.h"

namespace hoctomap {

/// What a build will take, judged by a few of its scans (docs/scaling.md says how well).
struct BuildEstimate {
  std::uint64_t scans = 0;              ///< that it will go through
  std::uint64_t sampled_scans = 0;      ///< of them looked at
  std::uint64_t points = 0;             ///< of all scans
  std::uint64_t map_bytes = 0;          ///< of the octrees at the end, as `memoryUsage()` counts them
  std::uint64_t peak_memory_bytes = 0;  ///< of the program and its helpers together
  double cpu_s = 0.0;                   ///< of all of them, on this machine
  std::uint64_t disk_bytes = 0;         ///< of the map directory

  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string json() const;
};

/// Goes through the logs, maps a sample of the scans that a build would, and writes nothing.
/// @throws what a build throws at logs and poses that it cannot use.
[[nodiscard]] BuildEstimate estimateBuild(const Settings& settings, LogReadOptions read,
                                          const PipeSource::WarningSink& warn);

}  // namespace hoctomap
