// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MapCheck.h"

#include <map>
#include <optional>
#include <set>

#include "DirectoryLock.h"
#include "MapFiles.h"
#include "MapNames.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/OctreeFile.h"

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

/// Whether the octree, which is whole, is the one that the manifest describes.
std::optional<std::string> contradiction(const std::filesystem::path& directory, const NodeRecord& node) {
  const std::string bytes = readChecked(directory, node.ot, false);
  const std::string name = (directory / node.ot.path).string();
  const NodeMap map(parseOt(bytes, node.resolution, name), node.occupancy);
  const VoxelCounts counts = map.countVoxels();
  if (counts.occupied == node.voxels.occupied && counts.free == node.voxels.free) return std::nullopt;
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
      if (!isNodeFileName(name) && !isSeamsFileName(name))
        check_.foreign.push_back(std::string(kNodesFolder) + "/" + name);
    }
  }

  [[nodiscard]] MapCheck result() && { return std::move(check_); }

 private:
  void checkFile(const FileRecord& file, bool prefix) {
    named_.insert(file.path);
    // States vouch for different parts of a file that grows.
    const std::string key = file.path + " " + std::to_string(file.bytes) + " " + file.sha256;
    if (!whole_.try_emplace(key, false).second) return;
    if (auto problem = problemOf(directory_, file, prefix)) {
      check_.damage.push_back({file.path, std::move(*problem)});
      return;
    }
    whole_[key] = true;
    ++check_.files;
    check_.bytes += file.bytes;
  }

  void checkNode(const NodeRecord& node) {
    const std::string key = node.ot.path + " " + std::to_string(node.ot.bytes) + " " + node.ot.sha256;
    if (!whole_[key] || !counted_.insert(key).second) return;
    if (auto problem = contradiction(directory_, node))
      check_.damage.push_back({node.ot.path, std::move(*problem)});
  }

  std::filesystem::path directory_;
  MapCheck check_;
  std::set<std::string> named_;
  std::map<std::string, bool> whole_;  ///< by file record
  std::set<std::string> counted_;
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
