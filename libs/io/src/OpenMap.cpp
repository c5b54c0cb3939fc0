// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/OpenMap.h"

#include <algorithm>
#include <map>
#include <utility>

#include "MapFiles.h"
#include "MapNames.h"
#include "hoctomap/io/OctreeFile.h"

namespace hoctomap {

namespace {

/// A state of a map, of which no more was read than its index.
struct IndexedState {
  std::uint64_t scans = 0;
  NodeIndex index;
};

/// Nothing if there is no index, or one that does not say how the state would have ended (endLog).
std::optional<IndexedState> readIndexedState(const std::filesystem::path& directory,
                                             std::optional<std::uint64_t> at_scan) {
  auto head = readManifestHead(directory / kManifestName);
  if (!head) return std::nullopt;
  const auto snapshot = snapshotAt(directory, head->manifest.scans, at_scan);
  if (snapshot) head = readManifestHead(directory / snapshotName(*snapshot));
  if (!head) return std::nullopt;
  auto index = readIndex(directory, *head);
  if (!index || (snapshot && index->hasWaiting())) return std::nullopt;
  return IndexedState{head->manifest.scans, *std::move(index)};
}

std::shared_ptr<const NodeMap> readNodeMap(const std::filesystem::path& directory, const NodeRecord& node) {
  const std::string bytes = readChecked(directory, node.ot, false);
  return std::make_shared<const NodeMap>(parseOt(bytes, node.resolution, (directory / node.ot.path).string()),
                                         node.occupancy);
}

}  // namespace

struct OpenMap::Stored {
  std::optional<NodeIndex> index;
  // Without an index:
  std::vector<NodePlace> places;
  std::vector<NodeRecord> records;
  std::vector<std::shared_ptr<const NodeMap>> maps;
};

OpenMap::OpenMap(std::filesystem::path directory, std::optional<std::uint64_t> at_scan)
    : directory_(std::move(directory)), stored_(std::make_unique<Stored>()) {
  requireMap(directory_);
  if (auto state = readIndexedState(directory_, at_scan)) {
    scans_ = state->scans;
    stored_->index = std::move(state->index);
  } else {
    readAll(readManifest(directory_, at_scan));
  }
}

OpenMap::~OpenMap() = default;

void OpenMap::readAll(const Manifest& manifest) {
  scans_ = manifest.scans;
  std::map<NodeId, std::size_t> depths;
  for (const NodeRecord& node : manifest.nodes)  // parents first
    depths[node.id] = node.parent ? depths.at(*node.parent) + 1 : 0;
  stored_->records = manifest.nodes;
  std::ranges::sort(stored_->records, {}, &NodeRecord::id);
  for (const NodeRecord& node : stored_->records) {
    const auto& map = stored_->maps.emplace_back(readNodeMap(directory_, node));
    stored_->places.push_back({node.id, depths.at(node.id), node.resolution, node.existence,
                               toIsometry(node.world_T_node), map->extent()});
  }
}

const std::vector<NodePlace>& OpenMap::places() const {
  return stored_->index ? stored_->index->places() : stored_->places;
}

NodeRecord OpenMap::record(std::size_t index) const {
  return stored_->index ? stored_->index->record(index) : stored_->records.at(index);
}

std::shared_ptr<const NodeMap> OpenMap::map(std::size_t index) const {
  return stored_->index ? readNodeMap(directory_, record(index)) : stored_->maps.at(index);
}

FoundNode findNode(const std::filesystem::path& directory, NodeId id, std::optional<std::uint64_t> at_scan) {
  requireMap(directory);
  if (const auto state = readIndexedState(directory, at_scan)) {
    const auto& places = state->index.places();
    const auto found = std::ranges::lower_bound(places, id, {}, &NodePlace::id);
    if (found == places.end() || found->id != id) return {state->scans, std::nullopt};
    return {state->scans, state->index.record(static_cast<std::size_t>(found - places.begin()))};
  }
  const Manifest manifest = readManifest(directory, at_scan);
  const NodeRecord* found = manifest.find(id);
  return {manifest.scans, found == nullptr ? std::nullopt : std::optional(*found)};
}

}  // namespace hoctomap
