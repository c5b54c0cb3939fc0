// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MapCheck.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "DirectoryLock.h"
#include "Disk.h"
#include "ManifestHead.h"
#include "MapFiles.h"
#include "MapNames.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/OctreeFile.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

namespace {

/// What is wrong with a file, if anything is.
std::optional<std::string> problemOf(const std::filesystem::path& directory, const FileRecord& file,
                                     bool grows) {
  try {
    const std::string bytes = readChecked(directory, file, grows);
    if (file.path.ends_with(".ot")) checkOt(bytes, (directory / file.path).string());
    if (file.path.ends_with(".bt")) checkBt(bytes, (directory / file.path).string());
    return std::nullopt;
  } catch (const Error& error) {
    return error.what();
  }
}

bool grows(const Manifest& manifest, const FileRecord& file) {
  return file.path == manifest.events.path || file.path == manifest.existence.path ||
         (manifest.scan_table && file.path == manifest.scan_table->path);
}

/// Whether every place is that of its record. @param manifest with the nodes of the index, parents first
bool placesAgree(const NodeIndex& index, const Manifest& manifest) {
  std::map<NodeId, std::size_t> depths;
  for (const NodeRecord& node : manifest.nodes)
    depths[node.id] = node.parent ? depths.at(*node.parent) + 1 : 0;
  for (std::size_t i = 0; i < index.places().size(); ++i) {
    const NodePlace& place = index.places()[i];
    const NodeRecord node = index.record(i);
    if (place.depth != depths.at(node.id) || place.resolution != node.resolution ||
        place.existence != node.existence ||
        place.world_T_node.matrix() != toIsometry(node.world_T_node).matrix())
      return false;
  }
  return true;
}

/// What is wrong with the index of a manifest, which is whole: it must say the same as the text.
std::optional<std::string> indexProblem(const NodeIndex& index, const std::string& manifest_text) {
  const std::string nodes = manifest_text.substr(std::min(nodesBegin(manifest_text), manifest_text.size()));
  if (index.nodesSha256() != sha256Hex(nodes)) return "is not the index of this manifest's nodes";
  Manifest indexed;
  indexed.next_id = NodeId{std::numeric_limits<std::uint32_t>::max()};
  index.addNodes(indexed);
  if (manifestNodesText(indexed) != nodes || !placesAgree(index, indexed))
    return "says something else than the manifest";
  return std::nullopt;
}

/// Whether the octree, which is whole, is the one that the manifest describes, and the index, if there is
/// one.
std::optional<std::string> contradiction(const std::filesystem::path& directory, const NodeRecord& node,
                                         const NodePlace* place) {
  const std::string bytes = readChecked(directory, node.ot, false);
  const std::string name = (directory / node.ot.path).string();
  const NodeMap map(parseOt(bytes, node.resolution, name), node.occupancy);
  const VoxelExtent extent = map.extent();
  const VoxelCounts& counts = extent.voxels;
  if (counts.occupied == node.voxels.occupied && counts.free == node.voxels.free) {
    const auto isSame = [](const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
      return a.min() == b.min() && a.max() == b.max();
    };
    const bool is_there = place == nullptr || (isSame(place->extent.known, extent.known) &&
                                               isSame(place->extent.occupied, extent.occupied));
    return is_there ? std::nullopt : std::optional(name + ": lies elsewhere than the index says");
  }
  return name + ": has " + std::to_string(counts.occupied) + " occupied and " + std::to_string(counts.free) +
         " free voxels, the manifest says " + std::to_string(node.voxels.occupied) + " and " +
         std::to_string(node.voxels.free);
}

/// Collects what is wrong with the states of one map; a file that several of them name is read once.
class Checker {
 public:
  explicit Checker(std::filesystem::path directory) : directory_(std::move(directory)) {}

  void checkState(const std::string& manifest_name, bool current) {
    ++check_.states;
    Manifest manifest;
    try {
      manifest = readManifestFile(directory_ / manifest_name);
    } catch (const Error& error) {
      check_.damage.push_back({manifest_name, error.what()});
      return;
    }
    if (current) check_.nodes = manifest.nodes.size();
    for (const FileRecord& file : manifest.files()) checkFile(file, grows(manifest, file));
    checkIndex(directory_ / manifest_name, manifest);
    for (const auto* list : {&manifest.nodes, &manifest.removed, &manifest.waiting}) {
      for (const NodeRecord& node : *list) checkNode(node);
    }
  }

  void findForeign() {
    for (const std::string& name : listDirectory(directory_)) {
      const bool ours = named_.contains(name) || snapshotScan(name) || isSeamsFileName(name);
      static const std::set<std::string> fixed{kManifestName, kConfigName,     kEventsName, kExistenceName,
                                               kScansName,    kTimingName,     kLogName,    kSceneName,
                                               kNodesFolder,  kPreviousFolder, kLockName};
      if (!ours && !fixed.contains(name)) check_.foreign.push_back(name);
    }
    for (const std::string& name : listDirectory(directory_ / kNodesFolder)) {
      if (!isNodeFileName(name) && !isSeamsFileName(name) && !isIndexFileName(name))
        check_.foreign.push_back(std::string(kNodesFolder) + "/" + name);
    }
  }

  [[nodiscard]] MapCheck result() && { return std::move(check_); }

 private:
  static std::string keyOf(const FileRecord& file) {
    return file.path + " " + std::to_string(file.bytes) + " " + file.sha256;
  }
  void checkFile(const FileRecord& file, bool prefix) {
    named_.insert(file.path);
    // States vouch for different parts of a file that grows.
    const std::string key = keyOf(file);
    if (!whole_.try_emplace(key, false).second) return;
    if (auto problem = problemOf(directory_, file, prefix)) {
      check_.damage.push_back({file.path, std::move(*problem)});
      return;
    }
    whole_[key] = true;
    ++check_.files;
    check_.bytes += file.bytes;
  }

  void checkIndex(const std::filesystem::path& manifest_file, const Manifest& manifest) {
    places_.clear();
    if (!manifest.index || !whole_[keyOf(*manifest.index)]) return;
    const std::string name = (directory_ / manifest.index->path).string();
    try {
      const NodeIndex index(readChecked(directory_, *manifest.index, false), name);
      if (const auto problem = indexProblem(index, readWholeFile(manifest_file)))
        throw MapError(name + ": " + *problem);
      for (const NodePlace& place : index.places()) places_[place.id] = place;
    } catch (const Error& error) {
      check_.damage.push_back({manifest.index->path, error.what()});
    }
  }

  void checkNode(const NodeRecord& node) {
    const std::string key = keyOf(node.ot);
    if (!whole_[key] || !counted_.insert(key).second) return;
    const auto place = places_.find(node.id);
    if (auto problem = contradiction(directory_, node, place == places_.end() ? nullptr : &place->second))
      check_.damage.push_back({node.ot.path, std::move(*problem)});
  }

  std::filesystem::path directory_;
  MapCheck check_;
  std::set<std::string> named_;
  std::map<std::string, bool> whole_;  ///< by file record
  std::set<std::string> counted_;
  std::map<NodeId, NodePlace> places_;  ///< by the index of the state at hand
};

}  // namespace

std::vector<Damage> findDamage(const std::filesystem::path& directory, const Manifest& manifest) {
  std::vector<Damage> damage;
  for (const FileRecord& file : manifest.files()) {
    if (auto problem = problemOf(directory, file, grows(manifest, file))) {
      damage.push_back({file.path, std::move(*problem)});
    }
  }
  return damage;
}

MapCheck checkMap(const std::filesystem::path& directory) {
  requireMap(directory);
  Checker checker(directory);
  checker.checkState(kManifestName, true);
  for (const std::uint64_t scan : snapshotScans(directory)) checker.checkState(snapshotName(scan), false);
  checker.findForeign();
  return std::move(checker).result();
}

}  // namespace hoctomap
