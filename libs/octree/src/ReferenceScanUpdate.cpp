// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "hoctomap/octree/ScanUpdate.h"

namespace hoctomap {

namespace {

using octomap::KeyRay;
using octomap::KeySet;
using octomap::OcTree;
using octomap::OcTreeKey;
using octomap::point3d;

point3d toOctomap(const Eigen::Vector3f& p) {
  return {p.x(), p.y(), p.z()};
}

/// Inclusive range of keys; all keys if there are no bounds.
struct KeyBox {
  OcTreeKey min{0, 0, 0};
  OcTreeKey max{0xFFFF, 0xFFFF, 0xFFFF};

  [[nodiscard]] bool contains(const OcTreeKey& k) const {
    for (unsigned i = 0; i < 3; ++i) {
      if (k[i] < min[i] || k[i] > max[i]) return false;
    }
    return true;
  }
};

/// Keys of the corners; corners beyond the key range mean its end.
KeyBox keyBox(const OcTree& tree, const std::optional<Eigen::AlignedBox3d>& bounds) {
  KeyBox box;
  if (!bounds) return box;
  const double cells_per_metre = 1.0 / tree.getResolution();  // as in coordToKey, to the last bit
  const auto key = [cells_per_metre](double coordinate) {
    constexpr double kHalf = 32768.0;
    const double cell = std::floor(cells_per_metre * coordinate) + kHalf;
    return static_cast<octomap::key_type>(std::clamp(cell, 0.0, 2.0 * kHalf - 1.0));
  };
  for (unsigned i = 0; i < 3; ++i) {
    box.min[i] = key(bounds->min()[static_cast<int>(i)]);
    box.max[i] = key(bounds->max()[static_cast<int>(i)]);
  }
  return box;
}

/// The keys that one scan touches.
class ScanKeys {
 public:
  ScanKeys(const OcTree& tree, const Beams& beams)
      : tree_(tree),
        box_(keyBox(tree, beams.bounds)),
        origin_(toOctomap(beams.origin)),
        max_range_(beams.max_range) {
    for (const auto& p : beams.hits) addBeam(toOctomap(p), true);
    for (const auto& p : beams.passing) addBeam(toOctomap(p), false);
    for (const auto& p : beams.endpoints) addEndpoint(toOctomap(p));
  }

  [[nodiscard]] const KeySet& free() const { return free_; }
  [[nodiscard]] const KeySet& occupied() const { return occupied_; }
  [[nodiscard]] const ScanUpdateReport& report() const { return report_; }

 private:
  // As stock insertPointCloud: a beam that is too long is cut and has no endpoint.
  void addBeam(const point3d& end, bool is_hit) {
    if (isTooLong(end)) {
      carve(origin_ + (end - origin_).normalized() * static_cast<float>(max_range_));
      return;
    }
    carve(end);
    if (is_hit) addEndpoint(end);
  }

  [[nodiscard]] bool isTooLong(const point3d& end) const {
    return max_range_ >= 0.0 && (end - origin_).norm() > max_range_;
  }

  /// As coordToKeyChecked, which casts to int what may be beyond that, too.
  [[nodiscard]] bool isInRange(const point3d& p) const {
    const auto isKey = [&](double coordinate) {
      const double cell = std::floor(1.0 / tree_.getResolution() * coordinate);
      return cell >= -32768.0 && cell < 32768.0;
    };
    return isKey(p.x()) && isKey(p.y()) && isKey(p.z());
  }

  void addEndpoint(const point3d& end) {
    if (isTooLong(end)) return;
    if (!isInRange(end)) {
      ++report_.beyond_key_range;
    } else if (const OcTreeKey key = tree_.coordToKey(end); box_.contains(key)) {
      occupied_.insert(key);
    }
  }

  void carve(const point3d& end) {
    // computeRayKeys would complain on stderr.
    if (!isInRange(origin_) || !isInRange(end)) return;
    if (!tree_.computeRayKeys(origin_, end, ray_)) return;
    for (const OcTreeKey& key : ray_) {
      if (box_.contains(key)) free_.insert(key);
    }
  }

  const OcTree& tree_;
  KeyBox box_;
  point3d origin_;
  double max_range_;
  KeyRay ray_;
  KeySet free_;
  KeySet occupied_;
  ScanUpdateReport report_;
};

class ReferenceScanUpdate : public ScanUpdate {
 public:
  ScanUpdateReport apply(OcTree& tree, const Beams& beams) const override {
    const ScanKeys keys(tree, beams);
    for (const OcTreeKey& key : keys.free()) {
      if (keys.occupied().count(key) == 0) tree.updateNode(key, false);
    }
    for (const OcTreeKey& key : keys.occupied()) tree.updateNode(key, true);
    return keys.report();
  }
};

}  // namespace

std::unique_ptr<ScanUpdate> makeReferenceScanUpdate() {
  return std::make_unique<ReferenceScanUpdate>();
}

}  // namespace hoctomap
