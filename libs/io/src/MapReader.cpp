// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/MapReader.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "Disk.h"
#include "ManifestTree.h"
#include "MapFiles.h"
#include "MapNames.h"
#include "SeamsFile.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/OctreeFile.h"

namespace hoctomap {
namespace {

NodeMap readNodeMap(const std::filesystem::path& directory, const NodeRecord& node) {
  const std::string bytes = readChecked(directory, node.ot, false);
  return {parseOt(bytes, node.resolution, (directory / node.ot.path).string()), node.occupancy};
}

void setState(MapNode& node, const NodeRecord& record) {
  node.existence_log_odds = record.existence_log_odds;
  node.first_scan = record.first_scan;
  node.last_scan = record.last_scan;
  node.version = record.version;
  node.edition = record.edition;
  node.votes = record.votes;
  node.confirmation = record.confirmation;
}

/// `damage`: see MapReadOptions
NodeMap readIntact(const std::filesystem::path& directory, const NodeRecord& node,
                   std::vector<Damage>* damage) {
  try {
    return readNodeMap(directory, node);
  } catch (const MapError& problem) {
    if (damage == nullptr) throw;
    damage->push_back({node.ot.path, problem.what()});
    return {node.resolution, node.occupancy};
  }
}

MapHierarchy readHierarchy(const std::filesystem::path& directory, const Manifest& manifest,
                           std::vector<Damage>* damage) {
  const NodeRecord& root = manifest.nodes.front();
  MapHierarchy hierarchy(root.label, readIntact(directory, root, damage));
  setState(hierarchy.root(), root);
  for (const NodeRecord& record : manifest.nodes) {
    if (!record.parent) continue;
    setState(hierarchy.restore(record.id, record.label, readIntact(directory, record, damage),
                               record.parent_T_node, *record.parent),
             record);
  }
  hierarchy.setNextId(manifest.next_id);
  return hierarchy;
}

/// The nodes that wait for confirmation.
void addWaiting(const std::filesystem::path& directory, const Manifest& manifest, MapHierarchy& hierarchy) {
  for (const NodeRecord& record : manifest.waiting) {
    setState(hierarchy.restore(record.id, record.label, readNodeMap(directory, record), record.parent_T_node,
                               *record.parent),
             record);
  }
  hierarchy.setNextId(manifest.next_id);
}

/// What a run that goes on begins with: those that only the end of the log has let in wait again.
void holdBack(MapHierarchy& hierarchy) {
  for (const NodeId id : hierarchy.ids()) {
    Confirmation& confirmation = hierarchy.node(id).confirmation;
    if (confirmation.entered_at_end) confirmation = confirmation.heldBack();
  }
}

RemovedNode readRemoved(const std::filesystem::path& directory, const NodeRecord& record) {
  // Only a hierarchy gives a node its transform: hang it into one of its own and take it out again.
  MapHierarchy scratch(labels::background, NodeMap(record.resolution, record.occupancy));
  setState(
      scratch.restore(record.id, record.label, readNodeMap(directory, record), record.parent_T_node, kRootId),
      record);
  return {scratch.remove(record.id), record.world_T_node, record.removed_scan.value_or(0)};
}

}  // namespace

std::vector<FileRecord> Manifest::files() const {
  std::vector<FileRecord> all{config, events, existence};
  if (scan_table) all.push_back(*scan_table);
  if (seams) all.push_back(*seams);
  if (index) all.push_back(*index);
  if (scene) all.push_back(*scene);
  for (const auto* list : {&nodes, &removed, &waiting}) {
    for (const NodeRecord& node : *list) {
      all.push_back(node.ot);
      all.push_back(node.bt);
    }
  }
  return all;
}

const NodeRecord* Manifest::find(NodeId id) const {
  const auto found =
      std::find_if(nodes.begin(), nodes.end(), [&](const auto& node) { return node.id == id; });
  return found == nodes.end() ? nullptr : &*found;
}

Manifest readManifest(const std::filesystem::path& directory, std::optional<std::uint64_t> at_scan) {
  requireMap(directory);
  Manifest current = readManifestFile(directory / kManifestName);
  const auto snapshot = snapshotAt(directory, current.scans, at_scan);
  if (!snapshot) return current;
  Manifest kept = readManifestFile(directory / snapshotName(*snapshot));
  endLog(kept);
  return kept;
}

StoredMap readMap(const std::filesystem::path& directory, const MapReadOptions& options) {
  Manifest manifest = readManifest(directory, options.at_scan);
  MapHierarchy hierarchy = readHierarchy(directory, manifest, options.damage);
  const bool all_state = options.to_go_on || options.to_edit;
  if (all_state) addWaiting(directory, manifest, hierarchy);
  if (options.to_go_on) holdBack(hierarchy);
  SeamVotes seams;
  if (all_state && manifest.seams) {
    seams = parseSeams(readChecked(directory, *manifest.seams, false),
                       (directory / manifest.seams->path).string());
  }
  std::vector<RemovedNode> removed;
  if (options.removed) {
    for (const NodeRecord& record : manifest.removed) removed.push_back(readRemoved(directory, record));
  }
  return {std::move(manifest), std::move(hierarchy), std::move(removed), std::move(seams)};
}

}  // namespace hoctomap
