// SPDX-License-Identifier: BSD-3-Clause
#include "vi_b/NodeHistory.h"

#include <set>

namespace hoctomap {

namespace {

std::set<NodeId> removedObjects(const std::filesystem::path& directory, const Manifest& manifest) {
  std::set<NodeId> ids;
  for (const EventRow& row : readEvents(directory, manifest)) {
    if (row.event == "removed" && row.label == labels::object) ids.insert(row.node);
  }
  return ids;
}

}  // namespace

std::vector<NodeState> historyOf(const std::filesystem::path& map, const Manifest& manifest, NodeId node) {
  std::vector<NodeState> history(manifest.scans);
  for (std::uint64_t scan = 0; scan < manifest.scans; ++scan) history[scan].scan = scan;
  std::uint64_t first = manifest.scans;
  std::uint64_t end = manifest.scans;
  for (const EventRow& row : readEvents(map, manifest)) {
    if (row.node != node) continue;
    if (row.event == "created") first = row.scan;
    if (row.event == "created") history.at(row.scan).existence = row.existence;
    if (row.event == "removed" || row.event == "merged") end = row.scan;
  }
  for (const ExistenceRow& row : readExistence(map, manifest)) {
    if (row.node != node) continue;
    history.at(row.scan).existence = row.p_posterior;
    history.at(row.scan).evidence = row;
  }
  for (std::uint64_t scan = first; scan < end; ++scan) {
    history[scan].in_map = true;
    if (!history[scan].existence) history[scan].existence = history[scan - 1].existence;
  }
  return history;
}

const RemovedNode* largestRemovedObject(const std::filesystem::path& directory, const StoredMap& map) {
  const std::set<NodeId> gone = removedObjects(directory, map.manifest);
  const RemovedNode* largest = nullptr;
  const auto size = [](const RemovedNode& removed) { return removed.node.map().occupiedVoxels().size(); };
  for (const RemovedNode& removed : map.removed) {
    if (!gone.contains(removed.node.id())) continue;
    if (largest == nullptr || size(removed) > size(*largest)) largest = &removed;
  }
  return largest;
}

std::size_t countRemovedObjects(const std::filesystem::path& directory, const Manifest& manifest) {
  return removedObjects(directory, manifest).size();
}

}  // namespace hoctomap
