// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "hoctomap/io/Manifest.h"
#include "hoctomap/io/MapReader.h"

namespace hoctomap {

/// The state of a map that a reading command is asked for: after scan K, or the newest one.
using AtScan = std::optional<std::uint64_t>;

/// Adds `--at-scan K` to a command.
void addAtScan(CLI::App& command, AtScan& at_scan, const std::string& name = "--at-scan",
               const std::string& what = "the map as it was after scan K (of a kept snapshot)");

/// Says on stderr when the state read is older than the one asked for, because only some are kept.
/// @param scans of the state read (Manifest::scans)
void noteOlderState(const std::string& map, std::uint64_t scans, const AtScan& at_scan);

/// The manifest of that state, and the map; they note an older one.
[[nodiscard]] Manifest readManifestAt(const std::string& map, const AtScan& at_scan);
[[nodiscard]] StoredMap readMapAt(const std::string& map, const AtScan& at_scan);

}  // namespace hoctomap
