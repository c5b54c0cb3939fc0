// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelBytes.h"

#include <cmath>

namespace hoctomap {

namespace {

enum Child : unsigned { kUnknown = 0, kFree = 1, kOccupied = 2, kInner = 3 };

class Writer {
 public:
  explicit Writer(const octomap::OcTree& tree) : tree_(tree) {}

  void descend(const octomap::OcTreeNode& node) {
    const std::size_t at = children_.size();
    children_.append(2, '\0');
    unsigned bits = 0;
    for (unsigned i = 0; i < 8; ++i) {
      if (!tree_.nodeChildExists(&node, i)) continue;
      const octomap::OcTreeNode& child = *tree_.getNodeChild(&node, i);
      const Child kind = tree_.nodeHasChildren(&child)  ? kInner
                         : tree_.isNodeOccupied(&child) ? kOccupied
                                                        : kFree;
      bits |= kind << 2U * i;
      if (kind == kInner) descend(child);
      if (kind == kOccupied) probabilities_ += static_cast<char>(std::lround(255.0 * child.getOccupancy()));
    }
    children_[at] = static_cast<char>(bits & 255U);
    children_[at + 1] = static_cast<char>(bits >> 8U);
  }

  [[nodiscard]] std::string bytes() const {
    std::string out;
    for (unsigned i = 0; i < 4; ++i) out += static_cast<char>(children_.size() / 2 >> 8U * i & 255U);
    return out + children_ + probabilities_;
  }

 private:
  const octomap::OcTree& tree_;
  std::string children_;
  std::string probabilities_;
};

}  // namespace

std::string voxelBytes(const NodeMap& map) {
  Writer writer(map.tree());
  const octomap::OcTreeNode* root = map.tree().getRoot();
  // A root that is a leaf would be one state for all that can be addressed: no map of measurements.
  if (root != nullptr && map.tree().nodeHasChildren(root)) writer.descend(*root);
  return writer.bytes();
}

}  // namespace hoctomap
