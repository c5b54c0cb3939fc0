// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/octree/TreeBytes.h"

#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "TreeAccess.h"

namespace hoctomap {
namespace {

using engine::kOctants;
using engine::kTreeLevels;

constexpr std::size_t kNodeBytes = sizeof(float) + 1;

void append(const engine::Node& node, TreeBytes& out) {
  auto* const* children = engine::NodeAccess::childrenOf(node);
  const float log_odds = node.getValue();
  std::array<char, kNodeBytes> own{};
  std::memcpy(own.data(), &log_odds, sizeof log_odds);
  unsigned mask = 0;
  for (unsigned octant = 0; children != nullptr && octant < kOctants; ++octant)
    mask |= (children[octant] != nullptr ? 1U : 0U) << octant;
  own.back() = static_cast<char>(mask);
  out.bytes.append(own.data(), own.size());
  out.leaves += mask == 0;
  for (unsigned octant = 0; octant < kOctants; ++octant)
    if ((mask >> octant & 1U) != 0) append(static_cast<const engine::Node&>(*children[octant]), out);
}

/// The nodes of an `.ot` file by their place in it.
class OtNodes {
 public:
  OtNodes(const TreeBytes& ot, float occupied_from) : bytes_(ot.bytes), occupied_from_(occupied_from) {}

  [[nodiscard]] std::size_t size() const { return bytes_.size() / kNodeBytes; }
  [[nodiscard]] bool isOccupied(std::size_t place) const {
    float log_odds = 0.0F;
    std::memcpy(&log_odds, bytes_.data() + place * kNodeBytes, sizeof log_odds);
    return log_odds >= occupied_from_;
  }
  [[nodiscard]] unsigned children(std::size_t place) const {
    return static_cast<unsigned char>(bytes_[(place + 1) * kNodeBytes - 1]);
  }

 private:
  const std::string& bytes_;
  float occupied_from_;
};

/// Writes the maximum-likelihood tree. OctoMap prunes it level by level from below and stops at the first
/// level at which there is nothing to prune; the root is never pruned.
class BtWriter {
 public:
  explicit BtWriter(const OtNodes& nodes) : nodes_(nodes) {
    if (nodes.size() == 0) return;
    seen_.reserve(nodes.size());
    look(0);
    for (unsigned depth = kTreeLevels - 1; depth > 0 && prunable_[depth] > 0; --depth) pruned_from_ = depth;
    out_.bytes.reserve(nodes.size() / 2);
    out_.nodes = 1;
    write(0, 0);
  }

  [[nodiscard]] TreeBytes take() && { return std::move(out_); }

 private:
  struct Seen {
    bool prunable = false;  ///< all eight children are leaves, or prunable, of one value
    bool occupied = false;
    std::uint32_t next = 0;  ///< place of the first that is not below it
  };

  /// The value that the next node has as a leaf, or would have if it was pruned.
  std::optional<bool> look(unsigned depth) {
    const std::size_t place = seen_.size();
    seen_.emplace_back();
    const unsigned children = nodes_.children(place);
    unsigned leaves = 0;
    unsigned occupied = 0;
    for (unsigned octant = 0; octant < kOctants; ++octant) {
      if ((children >> octant & 1U) == 0) continue;
      const auto value = look(depth + 1);
      leaves += value.has_value();
      occupied += value.value_or(false);
    }
    Seen& seen = seen_[place];
    seen.next = static_cast<std::uint32_t>(seen_.size());
    seen.prunable = leaves == kOctants && (occupied == 0 || occupied == kOctants);
    prunable_[depth] += seen.prunable;
    seen.occupied = seen.prunable ? occupied > 0 : nodes_.isOccupied(place);
    if (children != 0 && !seen.prunable) return std::nullopt;
    return seen.occupied;
  }

  void write(std::size_t place, unsigned depth) {
    const unsigned children = nodes_.children(place);
    unsigned kinds = 0;
    std::array<std::size_t, kOctants> inner{};  // places; 0, that of the root: none
    std::size_t next = place + 1;
    for (unsigned octant = 0; octant < kOctants; ++octant) {
      if ((children >> octant & 1U) == 0) continue;
      const Seen& seen = seen_[next];
      const bool is_leaf = seen.next == next + 1 || (seen.prunable && depth + 1 >= pruned_from_);
      kinds |= (!is_leaf ? kInner : seen.occupied ? kOccupied : kFree) << (2 * octant);
      if (!is_leaf) inner[octant] = next;
      next = seen.next;
      ++out_.nodes;
    }
    out_.bytes.push_back(static_cast<char>(kinds & 0xFFU));
    out_.bytes.push_back(static_cast<char>(kinds >> 8U));
    for (const std::size_t child : inner)
      if (child != 0) write(child, depth + 1);
  }

  static constexpr unsigned kFree = 1;
  static constexpr unsigned kOccupied = 2;
  static constexpr unsigned kInner = 3;

  const OtNodes& nodes_;
  std::vector<Seen> seen_;
  std::array<std::uint64_t, kTreeLevels + 1> prunable_{};  ///< by depth
  unsigned pruned_from_ = kTreeLevels;                     ///< nodes of this depth and deeper are pruned
  TreeBytes out_;
};

class ExtentWalk {
 public:
  ExtentWalk(const OtNodes& nodes, double resolution) : nodes_(nodes), resolution_(resolution) {
    if (nodes.size() > 0) walk(kTreeLevels, octomap::OcTreeKey(0, 0, 0));
  }
  [[nodiscard]] const VoxelExtent& extent() const { return extent_; }

 private:
  void walk(unsigned level, const octomap::OcTreeKey& first) {
    const std::size_t place = next_++;
    const unsigned children = nodes_.children(place);
    if (children == 0) add(level, first, nodes_.isOccupied(place));
    for (unsigned octant = 0; octant < kOctants; ++octant)
      if ((children >> octant & 1U) != 0) walk(level - 1, engine::childKey(first, level, octant));
  }

  void add(unsigned level, const octomap::OcTreeKey& first, bool occupied) {
    constexpr double kMiddle = 1U << (kTreeLevels - 1);  // key of the first voxel behind the origin
    const auto edge = std::uint64_t{1} << level;
    const Eigen::Array3d low = Eigen::Array3d(first[0], first[1], first[2]) - kMiddle;
    const Eigen::AlignedBox3d cube(resolution_ * low.matrix(),
                                   resolution_ * (low + static_cast<double>(edge)).matrix());
    extent_.known.extend(cube);
    if (occupied) extent_.occupied.extend(cube);
    (occupied ? extent_.voxels.occupied : extent_.voxels.free) += edge * edge * edge;
  }

  const OtNodes& nodes_;
  double resolution_;
  std::size_t next_ = 0;
  VoxelExtent extent_;
};

}  // namespace

TreeBytes otNodes(const octomap::OcTree& tree) {
  TreeBytes out;
  out.nodes = tree.size();
  out.bytes.reserve(tree.size() * kNodeBytes);
  if (const engine::Node* root = tree.getRoot()) append(*root, out);
  return out;
}

TreeBytes btNodes(const TreeBytes& ot, float occupied_from) {
  const OtNodes nodes(ot, occupied_from);
  return BtWriter(nodes).take();
}

VoxelExtent extentOf(const TreeBytes& ot, double resolution, float occupied_from) {
  const OtNodes nodes(ot, occupied_from);
  return ExtentWalk(nodes, resolution).extent();
}

}  // namespace hoctomap
