// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/StockMap.h"

namespace hoctomap {

namespace {

using octomap::KeySet;
using octomap::OcTree;
using octomap::OcTreeKey;

octomap::point3d toOctomap(const Eigen::Vector3f& p) {
  return {p.x(), p.y(), p.z()};
}

class StockBoxUpdate : public ScanUpdate {
 public:
  ScanUpdateReport apply(OcTree& tree, const Beams& beams) const override {
    octomap::Pointcloud points;
    points.reserve(beams.hits.size());
    for (const auto& p : beams.hits) points.push_back(toOctomap(p));
    KeySet free;
    KeySet occupied;
    tree.computeUpdate(points, toOctomap(beams.origin), free, occupied, beams.max_range);
    const Eigen::AlignedBox3d& box = *beams.bounds;
    const OcTreeKey low = tree.coordToKey(box.min().x(), box.min().y(), box.min().z());
    const OcTreeKey high = tree.coordToKey(box.max().x(), box.max().y(), box.max().z());
    for (const OcTreeKey& key : free) {
      if (inside(key, low, high)) tree.updateNode(key, false);
    }
    for (const OcTreeKey& key : occupied) {
      if (inside(key, low, high)) tree.updateNode(key, true);
    }
    return {};
  }

 private:
  static bool inside(const OcTreeKey& key, const OcTreeKey& low, const OcTreeKey& high) {
    for (unsigned i = 0; i < 3; ++i) {
      if (key[i] < low[i] || key[i] > high[i]) return false;
    }
    return true;
  }
};

}  // namespace

StockScan toStock(const Measurement& z) {
  StockScan scan;
  scan.points.reserve(z.world_points.size());
  for (const auto& p : z.world_points) scan.points.push_back(toOctomap(p));
  scan.origin = toOctomap(z.origin().cast<float>());
  return scan;
}

void insertStock(OcTree& tree, const StockScan& scan, double max_range) {
  tree.insertPointCloud(scan.points, scan.origin, max_range, false, false);
}

std::unique_ptr<ScanUpdate> makeStockBoxUpdate() {
  return std::make_unique<StockBoxUpdate>();
}

ScanCells countCells(const OcTree& tree, const StockScan& scan, double max_range) {
  ScanCells cells;
  octomap::KeyRay ray;
  for (const auto& end : scan.points) {
    const bool cut = max_range >= 0.0 && (end - scan.origin).norm() > max_range;
    const auto last =
        cut ? scan.origin + (end - scan.origin).normalized() * static_cast<float>(max_range) : end;
    if (tree.computeRayKeys(scan.origin, last, ray)) cells.visits += ray.size();
  }
  KeySet free;
  KeySet occupied;
  OcTree scratch(tree.getResolution());
  scratch.computeUpdate(scan.points, scan.origin, free, occupied, max_range);
  cells.updates = free.size() + occupied.size();
  return cells;
}

}  // namespace hoctomap
