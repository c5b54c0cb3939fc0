// SPDX-License-Identifier: BSD-3-Clause
#include "RayWalk.h"

#include <algorithm>

namespace hoctomap {

RayWalk::RayWalk(const QueryNode& node, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
    : node_(&node), origin_(node.node_T_world * origin), direction_(node.node_T_world.linear() * direction) {
  push(node.top);
  advance();
}

/// Puts a cell on the stack if a part of the ray lies in it.
void RayWalk::push(const OctreeCell& cell) {
  if (cell.node == nullptr) return;
  double enter = 0.0;
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double low = node_->resolution * cell.low[axis];
    const double high = node_->resolution * (cell.low[axis] + cell.edge);
    if (direction_[axis] == 0.0) {
      if (origin_[axis] < low || origin_[axis] >= high) return;
      continue;
    }
    const double a = (low - origin_[axis]) / direction_[axis];
    const double b = (high - origin_[axis]) / direction_[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter < leave) ahead_.push_back({cell, enter, leave});
}

/// Opens the nearest cell until it is a leaf.
void RayWalk::advance() {
  while (!ahead_.empty() && !ahead_.back().cell.isLeaf(*node_->tree)) {
    const OctreeCell cell = ahead_.back().cell;
    ahead_.pop_back();
    const auto first = static_cast<std::ptrdiff_t>(ahead_.size());
    for (unsigned octant = 0; octant < OctreeCell::kOctants; ++octant) {
      push(cell.child(*node_->tree, octant));
    }
    std::sort(ahead_.begin() + first, ahead_.end(),
              [](const Step& a, const Step& b) { return a.enter > b.enter; });
  }
}

RayWalk::Piece RayWalk::at(double t) {
  while (!ahead_.empty() && ahead_.back().leave <= t) {
    ahead_.pop_back();
    advance();
  }
  if (ahead_.empty()) return {};
  const Step& leaf = ahead_.back();
  if (t < leaf.enter) return {Occupancy::unknown, leaf.enter};
  return {node_->isOccupied(leaf.cell) ? Occupancy::occupied : Occupancy::free, leaf.leave};
}

}  // namespace hoctomap
