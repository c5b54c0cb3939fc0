// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hoctomap/hierarchy/NodeSource.h"
#include "hoctomap/io/Manifest.h"

namespace hoctomap {

/// The bytes of `nodes/index-NNNNNN.bin` (docs/map-format.md): where the nodes of a manifest are, and all
/// that the manifest says of them, for readers who need a few of many. Same manifest, same bytes.
/// @param nodes_text the manifest's text of its nodes: what the index is bound to
/// @param extents  of the octrees of the nodes of the tree
[[nodiscard]] std::string nodeIndexBytes(const Manifest& manifest, const std::string& nodes_text,
                                         const std::map<NodeId, VoxelExtent>& extents);

/// An index, taken apart as far as it is asked for.
class NodeIndex {
 public:
  /// @throws MapError, beginning with `name`.
  NodeIndex(std::string bytes, std::string name);

  [[nodiscard]] std::uint64_t nodesBytes() const { return nodes_bytes_; }
  [[nodiscard]] const std::string& nodesSha256() const { return nodes_sha256_; }
  [[nodiscard]] bool hasWaiting() const { return waiting_ > 0; }
  /// Of the nodes of the tree, by id.
  [[nodiscard]] const std::vector<NodePlace>& places() const { return places_; }
  /// What the manifest says of the node with this place, checked.
  [[nodiscard]] NodeRecord record(std::size_t place) const;
  /// Adds all nodes to a manifest's head.
  /// @throws MapError if they are no tree, LimitError if they are too many or too deep.
  void addNodes(Manifest& manifest) const;

 private:
  [[nodiscard]] NodeRecord recordAt(std::size_t& at) const;

  std::string bytes_;
  std::string name_;
  std::uint64_t nodes_bytes_ = 0;
  std::string nodes_sha256_;
  std::uint32_t nodes_ = 0;
  std::uint32_t removed_ = 0;
  std::uint32_t waiting_ = 0;
  std::vector<NodePlace> places_;
  std::vector<std::size_t> records_;  ///< where the record of a place begins
  std::size_t first_record_ = 0;
};

}  // namespace hoctomap
