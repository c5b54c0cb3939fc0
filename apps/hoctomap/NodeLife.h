// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hoctomap/io/Manifest.h"
#include "hoctomap/io/MapTables.h"

namespace hoctomap {

/// All that a map directory knows of one node, living or not.
struct NodeLife {
  NodeRecord record;
  bool in_map = true;  ///< false: removed, or merged into another node
  double prior = 0.5;  ///< P(n) of its label: what a scan says that says nothing
  std::vector<EventRow> events;
  std::vector<EventRow> absorbed;  ///< the events in which other nodes were merged into this one
  std::vector<ExistenceRow> evidence;

  /// Its probability of existence when it was created.
  [[nodiscard]] double firstExistence() const;
};

/// @throws MapError if there never was such a node in this state of the map.
[[nodiscard]] NodeLife readNodeLife(const std::filesystem::path& directory, const Manifest& manifest,
                                    NodeId node);

/// What a scan's evidence amounts to, in a word or two.
[[nodiscard]] std::string verdict(const ExistenceRow& row, double prior);

/// Why the node is no longer in the map, in a sentence; empty if it is.
[[nodiscard]] std::string whyGone(const NodeLife& life);

[[nodiscard]] std::string lifeText(const NodeLife& life);
[[nodiscard]] std::string lifeJson(const NodeLife& life);

}  // namespace hoctomap
