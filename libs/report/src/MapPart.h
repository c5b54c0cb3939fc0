// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "Page.h"

namespace hoctomap {

/// Adds the voxels of all nodes of a map to the page, living and removed, as blocks `<prefix><id>`.
/// @returns what else the page says of the map (keys as in `hierarchy.yaml`; rows of the tables)
[[nodiscard]] nlohmann::ordered_json addMap(Page& page, const std::filesystem::path& directory,
                                            std::optional<std::uint64_t> at_scan, const std::string& prefix);

}  // namespace hoctomap
