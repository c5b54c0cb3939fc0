// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "hoctomap/hierarchy/NodeSource.h"
#include "hoctomap/io/Manifest.h"

namespace hoctomap {

/// A map directory opened for questions: of a map with an index (docs/decisions/0057) nothing but the index
/// is read, and an octree when it is asked for first; of another one everything. Every file that is read is
/// checked against its size and hash, and octrees are validated before OctoMap sees them.
class OpenMap final : public NodeSource {
 public:
  /// @param at_scan as in readManifest
  /// @throws MapError naming the file; FileError if a file cannot be read.
  explicit OpenMap(std::filesystem::path directory, std::optional<std::uint64_t> at_scan = std::nullopt);
  ~OpenMap() override;

  [[nodiscard]] std::uint64_t scans() const { return scans_; }  ///< see Manifest::scans

  [[nodiscard]] const std::vector<NodePlace>& places() const override;
  [[nodiscard]] Label label(std::size_t index) const override { return record(index).label; }
  [[nodiscard]] std::shared_ptr<const NodeMap> map(std::size_t index) const override;
  /// What the manifest says of the node.
  [[nodiscard]] NodeRecord record(std::size_t index) const;

 private:
  struct Stored;
  void readAll(const Manifest& manifest);

  std::filesystem::path directory_;
  std::uint64_t scans_ = 0;
  std::unique_ptr<Stored> stored_;
};

/// What a map says of one node.
struct FoundNode {
  std::uint64_t scans = 0;         ///< Manifest::scans of the state
  std::optional<NodeRecord> node;  ///< none if its tree has no such node
};

/// Reads no more than that, of a map with an index.
/// @throws as OpenMap
[[nodiscard]] FoundNode findNode(const std::filesystem::path& directory, NodeId id,
                                 std::optional<std::uint64_t> at_scan = std::nullopt);

}  // namespace hoctomap
