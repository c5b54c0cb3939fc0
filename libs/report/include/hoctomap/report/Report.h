// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hoctomap {

/// The bytes of an HTML page that shows a map: model, tree, what happened over the scans, settings, warnings.
/// Self-contained: it works without a network and without other files.
/// @param at_scan a kept state; default: the map itself
/// @throws MapError, FileError if the map cannot be read; LimitError beyond 5 10^7 occupied voxels; FileError
///         if the program was built without the page's script (docs/decisions/0047)
[[nodiscard]] std::string mapReport(const std::filesystem::path& directory,
                                    std::optional<std::uint64_t> at_scan = std::nullopt);

/// A map directory, and which of its kept states (default: the map itself).
struct ReportedMap {
  std::filesystem::path directory;
  std::optional<std::uint64_t> at_scan;
};

/// The same for two maps of one place, or two states of one, side by side, coloured by what changed.
/// @param diff_json what `hoctomap diff A B --json` prints (docs/json.md)
[[nodiscard]] std::string comparisonReport(const ReportedMap& a, const ReportedMap& b,
                                           const std::string& diff_json);

/// A page with the figures of experiments (`hoctomap-experiments ... -o FOLDER`), one chapter a folder: plots
/// of the tables it knows, the pictures, and every table.
/// @throws FileError if a folder cannot be read; InputError if it holds no table; LimitError beyond 64 MB
[[nodiscard]] std::string experimentsReport(const std::vector<std::filesystem::path>& folders);

}  // namespace hoctomap
