// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "hoctomap/geometry/Measurement.h"

namespace hoctomap {

/// Which scans of a log are measured with.
struct ScanChoice {
  std::filesystem::path log;
  std::uint64_t start = 0;
  std::uint64_t every = 1;
  std::optional<std::uint64_t> max_scans;
  double min_range = 0.0;  ///< m
};

/// All chosen scans, in memory. Objects that move are left out.
/// @throws InputError and the other errors of reading a log; InputError if no scan is left.
[[nodiscard]] std::vector<Measurement> readScans(const ScanChoice& choice);

[[nodiscard]] std::size_t pointsOf(const std::vector<Measurement>& scans);

/// Assignments for a scene with a sweep: three views with a quarter of the pixels.
[[nodiscard]] std::vector<std::string> quickScene();

/// Makes the log of a scene file, changed by assignments `section.key=value`.
/// @return number of scans
std::size_t simulateLog(const std::filesystem::path& scene, const std::vector<std::string>& assignments,
                        const std::filesystem::path& log);

}  // namespace hoctomap
