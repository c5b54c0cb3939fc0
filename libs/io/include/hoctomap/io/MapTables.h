// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/io/Manifest.h"

namespace hoctomap {

/// A row of `events.csv`.
struct EventRow {
  std::uint64_t scan = 0;
  double time = 0.0;  ///< stamp of the scan, s since 1970
  std::string event;  ///< created, updated, removed, moved, merged, split, reidentified
  NodeId node;
  Label label;
  double existence = 0.0;  ///< after the event
  std::string detail;
};

/// A row of `existence.csv`.
struct ExistenceRow {
  std::uint64_t scan = 0;
  NodeId node;
  std::uint64_t present = 0;  ///< beams
  std::uint64_t absent = 0;
  std::uint64_t occluded = 0;
  double p_measurement = 0.5;  ///< P(n | z_t)
  double p_posterior = 0.5;    ///< P(n | z_1:t)
};

/// A row of `scans.csv`.
struct ScanTableRow {
  std::uint64_t scan = 0;
  double time = 0.0;  ///< s since 1970
  std::string sensor;
  std::uint64_t points = 0;
  std::optional<Pose> world_T_sensor;  ///< none if the scan was skipped
  std::optional<double> fov_x;         ///< degrees, of a depth camera
  std::optional<double> fov_y;
  std::string skipped;  ///< why; empty if it was mapped
};

/// A row of `timing.csv`, seconds.
struct TimingTableRow {
  std::uint64_t scan = 0;
  std::uint64_t points = 0;
  double read = 0.0;
  double segment = 0.0;
  double associate = 0.0;
  double update = 0.0;
  double existence = 0.0;
  double write = 0.0;
};

/// The rows that belong to the state of the map that `manifest` describes, in their order.
/// @throws MapError naming file and line; FileError if the file cannot be read.
[[nodiscard]] std::vector<EventRow> readEvents(const std::filesystem::path& directory,
                                               const Manifest& manifest);
[[nodiscard]] std::vector<ExistenceRow> readExistence(const std::filesystem::path& directory,
                                                      const Manifest& manifest);
/// Empty for maps of earlier versions, which have no such table.
[[nodiscard]] std::vector<ScanTableRow> readScans(const std::filesystem::path& directory,
                                                  const Manifest& manifest);
/// No file of the map's state: rows of scans that the manifest does not know are left out, and a missing file
/// has none.
[[nodiscard]] std::vector<TimingTableRow> readTiming(const std::filesystem::path& directory,
                                                     const Manifest& manifest);

}  // namespace hoctomap
