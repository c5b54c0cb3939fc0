// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hoctomap/config/IniDocument.h"
#include "hoctomap/simulation/Simulation.h"

namespace hoctomap {

/// The simulation that a scene file describes; libs/simulation/README.md lists the keys. Notes what is wrong
/// in `ini` and leaves it to the caller to `finish()` it, so that more sections can be read from the same
/// file.
/// @param mesh_folder what relative names of mesh files start from
[[nodiscard]] Simulation readScene(IniDocument& ini, const std::filesystem::path& mesh_folder);

/// Reads a scene file, changed by assignments `section.key=value`. Meshes are looked for beside the file.
/// @throws ConfigError naming everything that is wrong.
[[nodiscard]] Simulation loadScene(const std::filesystem::path& path,
                                   const std::vector<std::string>& assignments = {});

}  // namespace hoctomap
