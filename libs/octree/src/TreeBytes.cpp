// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/octree/TreeBytes.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "TreeAccess.h"

namespace hoctomap {
namespace {

using engine::kOctants;
using engine::kTreeLevels;

constexpr std::size_t kNodeBytes = sizeof(float) + 1;

/// Octants of a mask, ascending.
template <typename Visit>
void forEachOctant(unsigned mask, const Visit& visit) {
  for (; mask != 0; mask &= mask - 1) visit(static_cast<unsigned>(std::countr_zero(mask)));
}

/// Writes the `.ot` nodes of a tree, parents first.
class OtWriter {
 public:
  explicit OtWriter(const octomap::OcTree& tree) {
    out_.nodes = tree.size();
    out_.bytes.resize(tree.size() * kNodeBytes);
    if (tree.getRoot() != nullptr) write(*tree.getRoot());
    if (end_ != out_.bytes.size()) throw std::logic_error("a tree has other nodes than it counts");
  }
  [[nodiscard]] TreeBytes take() && { return std::move(out_); }

 private:
  void write(const engine::Node& node) {
    const auto* const* children = engine::NodeAccess::childrenOf(node);
    unsigned mask = 0;
    for (unsigned octant = 0; children != nullptr && octant < kOctants; ++octant) {
      if (children[octant] == nullptr) continue;
      mask |= 1U << octant;
      __builtin_prefetch(
          children[octant]);  // they lie anywhere in memory, and are wanted one after the other
    }
    put(node.getValue(), mask);
    forEachOctant(mask, [&](unsigned octant) { write(static_cast<const engine::Node&>(*children[octant])); });
  }

  void put(float log_odds, unsigned mask) {
    if (end_ + kNodeBytes > out_.bytes.size()) throw std::logic_error("a tree has more nodes than it counts");
    char* const at = out_.bytes.data() + end_;
    std::memcpy(at, &log_odds, sizeof log_odds);
    at[sizeof log_odds] = static_cast<char>(mask);
    end_ += kNodeBytes;
    out_.leaves += mask == 0;
  }

  TreeBytes out_;
  std::size_t end_ = 0;  ///< of what is written
};

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
  enum class Value : unsigned char { free, occupied, none };
  Value look(unsigned depth) {
    const std::size_t place = seen_.size();
    seen_.emplace_back();
    const unsigned children = nodes_.children(place);
    unsigned leaves = 0;
    unsigned occupied = 0;
    forEachOctant(children, [&](unsigned) {
      const Value value = look(depth + 1);
      leaves += value != Value::none;
      occupied += value == Value::occupied;
    });
    Seen& seen = seen_[place];
    seen.next = static_cast<std::uint32_t>(seen_.size());
    seen.prunable = leaves == kOctants && (occupied == 0 || occupied == kOctants);
    prunable_[depth] += seen.prunable;
    seen.occupied = seen.prunable ? occupied > 0 : nodes_.isOccupied(place);
    if (children != 0 && !seen.prunable) return Value::none;
    return seen.occupied ? Value::occupied : Value::free;
  }

  void write(std::size_t place, unsigned depth) {
    unsigned kinds = 0;
    std::array<std::size_t, kOctants> inner{};  // places; 0, that of the root: none
    std::size_t next = place + 1;
    forEachOctant(nodes_.children(place), [&](unsigned octant) {
      const Seen& seen = seen_[next];
      const bool is_leaf = seen.next == next + 1 || (seen.prunable && depth + 1 >= pruned_from_);
      kinds |= (!is_leaf ? kInner : seen.occupied ? kOccupied : kFree) << (2 * octant);
      if (!is_leaf) inner[octant] = next;
      next = seen.next;
      ++out_.nodes;
    });
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

/// Least and greatest keys of cubes of voxels.
struct KeyExtent {
  Eigen::Array3i low = Eigen::Array3i::Constant(1 << kTreeLevels);
  Eigen::Array3i high = -low;  ///< behind the last voxel

  void extend(const octomap::OcTreeKey& first, int edge) {
    const Eigen::Array3i key(first[0], first[1], first[2]);
    low = low.min(key);
    high = high.max(key + edge);
  }
  [[nodiscard]] Eigen::AlignedBox3d box(double resolution) const {
    if ((low > high).any()) return {};
    constexpr int kMiddle = 1 << (kTreeLevels - 1);  // key of the first voxel behind the origin
    const auto corner = [&](const Eigen::Array3i& key) -> Eigen::Vector3d {
      return resolution * (key - kMiddle).cast<double>().matrix();
    };
    return {corner(low), corner(high)};
  }
};

class ExtentWalk {
 public:
  explicit ExtentWalk(const OtNodes& nodes) : nodes_(nodes) {
    if (nodes.size() > 0) walk(kTreeLevels, octomap::OcTreeKey(0, 0, 0));
  }
  [[nodiscard]] VoxelExtent extent(double resolution) const {
    return {known_.box(resolution), occupied_.box(resolution), voxels_};
  }

 private:
  void walk(unsigned level, const octomap::OcTreeKey& first) {
    const std::size_t place = next_++;
    const unsigned children = nodes_.children(place);
    if (children == 0) add(level, first, nodes_.isOccupied(place));
    forEachOctant(children,
                  [&](unsigned octant) { walk(level - 1, engine::childKey(first, level, octant)); });
  }

  void add(unsigned level, const octomap::OcTreeKey& first, bool occupied) {
    const int edge = 1 << level;
    known_.extend(first, edge);
    if (occupied) occupied_.extend(first, edge);
    (occupied ? voxels_.occupied : voxels_.free) += std::uint64_t{1} << (3 * level);
  }

  const OtNodes& nodes_;
  std::size_t next_ = 0;
  KeyExtent known_;
  KeyExtent occupied_;
  VoxelCounts voxels_;
};

}  // namespace

TreeBytes otNodes(const octomap::OcTree& tree) {
  return OtWriter(tree).take();
}

TreeBytes btNodes(const TreeBytes& ot, float occupied_from) {
  const OtNodes nodes(ot, occupied_from);
  return BtWriter(nodes).take();
}

VoxelExtent extentOf(const TreeBytes& ot, double resolution, float occupied_from) {
  const OtNodes nodes(ot, occupied_from);
  return ExtentWalk(nodes).extent(resolution);
}

}  // namespace hoctomap
