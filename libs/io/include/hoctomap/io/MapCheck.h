// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hoctomap/io/Manifest.h"

namespace hoctomap {

/// A file of a map that is not as the manifest says.
struct Damage {
  std::string path;  ///< relative to the map directory
  std::string what;
};

/// Every file that the manifest names and that is missing, or has another size, hash or content. Empty: the
/// map is whole.
[[nodiscard]] std::vector<Damage> findDamage(const std::filesystem::path& directory,
                                             const Manifest& manifest);

/// What a whole map directory holds.
struct MapCheck {
  std::vector<Damage> damage;        ///< of the map and of all its kept states
  std::vector<std::string> foreign;  ///< names that no map has; they are left alone
  std::size_t states = 0;            ///< the map and its snapshots
  std::size_t nodes = 0;             ///< of the map
  std::size_t files = 0;
  std::uint64_t bytes = 0;
};

/// Reads everything: the manifests with the structure of their trees, every file that they name, and whether
/// each octree has the voxels that its manifest says. Each file once.
/// @throws MapError if the directory is no map, FileError if it cannot be read.
[[nodiscard]] MapCheck checkMap(const std::filesystem::path& directory);

}  // namespace hoctomap
