// SPDX-License-Identifier: BSD-3-Clause
#include "vi_b/CellSet.h"

#include <cmath>

namespace hoctomap {

namespace {

std::int64_t index(double coordinate, double size) {
  return static_cast<std::int64_t>(std::floor(coordinate / size));
}

/// 21 bits an axis: 2 km at 1 mm.
std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto part = [](std::int64_t i) { return static_cast<std::uint64_t>(i) & 0x1FFFFF; };
  return part(x) << 42 | part(y) << 21 | part(z);
}

}  // namespace

void CellSet::insert(const Eigen::Vector3d& p) {
  cells_.insert(key(index(p.x(), size_), index(p.y(), size_), index(p.z(), size_)));
}

bool CellSet::anyNear(const Eigen::Vector3d& p, double reach) const {
  // Centres of cells are rounded; a cell that is only touched does not count.
  const double inside = reach - 0.01 * size_;
  for (auto x = index(p.x() - inside, size_); x <= index(p.x() + inside, size_); ++x) {
    for (auto y = index(p.y() - inside, size_); y <= index(p.y() + inside, size_); ++y) {
      for (auto z = index(p.z() - inside, size_); z <= index(p.z() + inside, size_); ++z) {
        if (cells_.contains(key(x, y, z))) return true;
      }
    }
  }
  return false;
}

}  // namespace hoctomap
