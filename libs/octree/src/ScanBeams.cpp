// SPDX-License-Identifier: BSD-3-Clause
#include "ScanBeams.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "RayTraversal.h"

namespace hoctomap::engine {

using Eigen::Vector3f;

namespace {

// A cell beyond an endpoint may come from rounding, never a second one.
constexpr int kMargin = 2;

/// The smallest box of coordinates around the origin and the ends of the beams.
struct Extent {
  explicit Extent(const Vector3f& origin) : low(origin), high(origin) {}
  void add(const Vector3f& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }

  Vector3f low;
  Vector3f high;
};

/// Keys that the beams of a scan can reach, wrapping aside.
KeyBox reachOf(const ScanBeams& scan) {
  const VoxelGrid& grid = scan.grid();
  Extent extent(scan.origin());
  const auto points = {scan.beams().hits, scan.beams().passing, scan.beams().endpoints};
  for (const auto list : points) {
    for (const Vector3f& p : list) extent.add(p);
  }
  Key key;
  if (!grid.checkedKey(extent.low, key) || !grid.checkedKey(extent.high, key)) {
    // Leave out what no key can address: such ends are dropped, and without the origin there are no beams.
    extent.low.setConstant(std::numeric_limits<float>::max());
    extent.high = -extent.low;
    if (grid.checkedKey(scan.origin(), key)) extent.add(scan.origin());
    for (const auto list : points) {
      for (const Vector3f& p : list) {
        const Vector3f end = scan.isTooLong(p) ? scan.cut(p) : p;
        if (grid.checkedKey(end, key)) extent.add(end);
      }
    }
  }
  KeyBox box;
  if ((extent.low.array() > extent.high.array()).any()) {  // nothing at all
    box.max = {-1, -1, -1};
    return box;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    box.min[i] = std::max(grid.clampedKey(extent.low[axis]) - kMargin, 0);
    box.max[i] = std::min(grid.clampedKey(extent.high[axis]) + kMargin, kMaxKey);
  }
  return box;
}

/// True if a cell next to the box would be beyond the key range.
bool touchesEnd(const KeyBox& box) {
  bool touches = false;
  for (std::size_t i = 0; i < 3; ++i) touches |= box.min[i] == 0 || box.max[i] == kMaxKey;
  return touches;
}

}  // namespace

ScanBeams::ScanBeams(const VoxelGrid& grid, const Beams& beams) : grid_(grid), beams_(beams) {
  const KeyBox reach = reachOf(*this);
  const KeyBox bounds = grid.keyBox(beams.bounds);
  box_ = reach.intersection(bounds);
  if (touchesEnd(reach) || !allAddressable()) findOddities(reach, bounds);
}

bool ScanBeams::allAddressable() const {
  // Not the last voxel's border: rounding is no matter here.
  const auto limit = static_cast<float>((kKeyOffset - 1) * grid_.resolution());
  bool beyond = false;  // or not a number
  for (const auto list : {beams_.hits, beams_.endpoints}) {
    for (const Vector3f& p : list) {
      beyond |= !(std::fabs(p[0]) <= limit) | !(std::fabs(p[1]) <= limit) | !(std::fabs(p[2]) <= limit);
    }
  }
  return !beyond;
}

void ScanBeams::findOddities(const KeyBox& reach, const KeyBox& bounds) {
  const RayCaster caster(grid_, beams_.origin);
  const auto findStrays = [&](const Vector3f& end, const Key& key) {
    if (!caster.originValid() || key == caster.originKey()) return;
    const Ray ray = caster.prepare(end, key);
    if (isRegular(ray)) return;
    walkAsOctomap(ray, [&](const Key& k) {
      if (bounds.contains(k) && !reach.contains(k)) strays_.push_back(k);
    });
  };
  Key key;
  for (const Vector3f& p : beams_.hits) {
    const bool too_long = isTooLong(p);
    const Vector3f end = too_long ? cut(p) : p;
    if (grid_.checkedKey(end, key)) {
      findStrays(end, key);
    } else if (!too_long) {
      ++beyond_key_range_;
    }
  }
  for (const Vector3f& p : beams_.passing) {
    const Vector3f end = isTooLong(p) ? cut(p) : p;
    if (grid_.checkedKey(end, key)) findStrays(end, key);
  }
  beyond_key_range_ += static_cast<std::size_t>(
      std::count_if(beams_.endpoints.begin(), beams_.endpoints.end(),
                    [&](const Vector3f& p) { return !isTooLong(p) && !grid_.checkedKey(p, key); }));
  std::sort(strays_.begin(), strays_.end());
  strays_.erase(std::unique(strays_.begin(), strays_.end()), strays_.end());
}

Vector3f ScanBeams::cut(const Vector3f& end) const {
  Vector3f direction = end - beams_.origin;
  const double length = norm(direction);
  if (length > 0.0) direction /= static_cast<float>(length);
  return beams_.origin + direction * static_cast<float>(beams_.max_range);
}

}  // namespace hoctomap::engine
