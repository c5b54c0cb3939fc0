// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/hierarchy/NodeId.h"

namespace hoctomap {

// Names inside a map directory (docs/map-format.md).
inline constexpr const char* kManifestName = "hierarchy.yaml";
inline constexpr const char* kConfigName = "config.ini";
inline constexpr const char* kEventsName = "events.csv";
inline constexpr const char* kExistenceName = "existence.csv";
inline constexpr const char* kScansName = "scans.csv";
inline constexpr const char* kTimingName = "timing.csv";
inline constexpr const char* kLogName = "log.txt";
inline constexpr const char* kSceneName = "hierarchy.3Dscene";
inline constexpr const char* kNodesFolder = "nodes";
/// Where the files of the old map stand while `--overwrite` builds a new one.
inline constexpr const char* kPreviousFolder = "previous";

/// `NNNNNN-VVVVVV`, without extension; of what was edited by hand `NNNNNN-VVVVVV-E`.
[[nodiscard]] std::string nodeFileStem(NodeId id, std::uint64_t version, std::uint64_t edition);
[[nodiscard]] std::string seamsFileName(std::uint64_t scans, std::uint64_t edits);
/// Named by its content: the same scan may be the last of several states.
[[nodiscard]] std::string indexFileName(const std::string& sha256);
/// Whether a file of this name in `nodes/` can only be ours.
[[nodiscard]] bool isIndexFileName(const std::string& name);
[[nodiscard]] bool isSeamsFileName(const std::string& name);
[[nodiscard]] bool isNodeFileName(const std::string& name);

/// Manifest of the state after scan `scan`, kept for good.
[[nodiscard]] std::string snapshotName(std::uint64_t scan);
/// The scan, if this is the name of a kept manifest.
[[nodiscard]] std::optional<std::uint64_t> snapshotScan(const std::string& name);
/// The scans of all kept manifests of a directory, ascending.
[[nodiscard]] std::vector<std::uint64_t> snapshotScans(const std::filesystem::path& directory);

/// Names in a directory, sorted; none if it is missing.
/// @throws FileError if it cannot be read.
[[nodiscard]] std::vector<std::string> listDirectory(const std::filesystem::path& directory);

}  // namespace hoctomap
