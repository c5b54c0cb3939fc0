// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/io/Manifest.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/mapping/SeamVotes.h"
#include "hoctomap/mapping/UpdateReport.h"

namespace hoctomap {

struct MapReadOptions {
  std::optional<std::uint64_t> at_scan;  ///< the kept snapshot of this scan; default: the map itself
  bool removed = false;                  ///< whether to load the octrees of removed nodes, too
  bool to_go_on = false;                 ///< as the mapper had it before the end of the log
  bool to_edit = false;                  ///< as it is, with all that a commit needs: what waits, and seams
  /// If given: a node whose file is damaged is left without voxels and named here, instead of an error.
  std::vector<Damage>* damage = nullptr;
};

/// A map of a directory. Writing it again gives the same bytes.
struct StoredMap {
  Manifest manifest;
  MapHierarchy hierarchy;
  std::vector<RemovedNode> removed;  ///< empty unless asked for
  SeamVotes seams;                   ///< empty unless the map is read to go on or to edit
};

/// Loads a map: manifest and octrees. Every octree file is checked against its size and hash and validated
/// before OctoMap sees it.
/// @throws MapError naming the file; FileError if a file cannot be read.
[[nodiscard]] StoredMap readMap(const std::filesystem::path& directory, const MapReadOptions& options = {});

}  // namespace hoctomap
