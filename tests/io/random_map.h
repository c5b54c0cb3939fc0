// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/io/MapDirectory.h"
#include "support/RandomScenes.h"

namespace hoctomap::test {

/// An octree with a blob of occupied and some free voxels, pruned.
NodeMap randomNodeMap(Rng& rng, double resolution, const OccupancyModel& model = {});

/// A hierarchy of a background, tables and objects: `nodes` nodes below the root, random parents and poses.
MapHierarchy randomHierarchy(Rng& rng, std::size_t nodes);

/// Changes the map of a node as scan `scan` would.
void changeNode(Rng& rng, MapHierarchy& hierarchy, NodeId id, std::uint64_t scan);

/// A report with one event and one line of existence for a node.
UpdateReport reportOf(const MapHierarchy& hierarchy, NodeId id, std::uint64_t scan);

/// A fresh folder below the system's temporary folder, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string readText(const std::filesystem::path& file);
void writeText(const std::filesystem::path& file, const std::string& text);

/// Every file below `directory` (relative path to contents) but timing.csv and log.txt.
std::map<std::string, std::string> contents(const std::filesystem::path& directory);

MapDirectoryOptions mapOptions(MapOpenMode mode);

}  // namespace hoctomap::test
