// SPDX-License-Identifier: BSD-3-Clause
#include "NodeRegions.h"

#include <algorithm>

#include "SurfacePoints.h"

namespace hoctomap {

namespace {

using Region = SurfaceRegions::Region;

}  // namespace

NodeRegions::NodeRegions(const MapHierarchy& hierarchy, std::span<const NodeId> nodes,
                         const SurfaceRegions& regions) {
  for (const NodeId id : nodes) {
    std::map<Region, std::vector<SeamVotes::Cell>> cells;
    for (const SeamVotes::Cell& cell : SeamVotes::cellsOf(worldSurface(hierarchy, id))) {
      if (const auto region = regions.at(cell)) cells[*region].push_back(cell);
    }
    if (cells.empty()) continue;
    Held& held = held_[id];
    held.main = std::max_element(cells.begin(), cells.end(), [](const auto& a, const auto& b) {
                  return a.second.size() < b.second.size();
                })->first;
    for (const auto& [region, in_region] : cells) {
      if (region == *held.main) continue;
      const auto away = std::count_if(in_region.begin(), in_region.end(),
                                      [&](const auto& cell) { return !regions.isBeside(cell, *held.main); });
      if (2 * static_cast<std::size_t>(away) >= kFragmentCells) held.others.insert(region);
    }
  }
}

std::vector<NodeId> NodeRegions::nodes() const {
  std::vector<NodeId> nodes;
  for (const auto& [id, held] : held_) nodes.push_back(id);
  return nodes;
}

std::optional<Region> NodeRegions::mainOf(NodeId node) const {
  const auto found = held_.find(node);
  return found == held_.end() ? std::nullopt : found->second.main;
}

std::vector<NodeId> NodeRegions::ownersOf(Region region) const {
  std::vector<NodeId> owners;
  for (const auto& [id, held] : held_) {
    if (held.main == region) owners.push_back(id);
  }
  return owners;
}

bool NodeRegions::isHeld(Region region) const {
  return std::any_of(held_.begin(), held_.end(), [region](const auto& entry) {
    return entry.second.main == region || entry.second.others.contains(region);
  });
}

std::set<Region> NodeRegions::othersOf(NodeId node) const {
  const auto found = held_.find(node);
  return found == held_.end() ? std::set<Region>{} : found->second.others;
}

void NodeRegions::merge(NodeId whole, NodeId piece) {
  const Held gone = held_[piece];
  held_.erase(piece);
  held_[whole].others.insert(gone.others.begin(), gone.others.end());
}

void NodeRegions::give(NodeId from, NodeId to, Region region) {
  held_[from].others.erase(region);
  Held& taker = held_[to];
  if (!taker.main) taker.main = region;
}

}  // namespace hoctomap
