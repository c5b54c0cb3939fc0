// SPDX-License-Identifier: BSD-3-Clause
#include "MapSide.h"

#include <algorithm>
#include <cmath>

namespace hoctomap {

namespace {

constexpr std::size_t kSample = 1500;
constexpr double kSquare = 0.2;       // m
constexpr double kThickness = 0.015;  // m, of what counts as one level

double median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

std::pair<int, int> squareOf(const Eigen::Vector2d& xy) {
  return {static_cast<int>(std::floor(xy.x() / kSquare)), static_cast<int>(std::floor(xy.y() / kSquare))};
}

/// Mean of the voxels about the median: a voxel alone knows the height to half its edge only.
double levelOf(const std::vector<float>& heights) {
  const double middle = median(heights);
  double sum = 0.0;
  std::size_t count = 0;
  for (const float z : heights) {
    if (std::abs(static_cast<double>(z) - middle) > kThickness) continue;
    sum += static_cast<double>(z);
    ++count;
  }
  return sum / static_cast<double>(count);
}

std::map<std::pair<int, int>, double> heightsOf(const PointCloud& points) {
  std::map<std::pair<int, int>, std::vector<float>> squares;
  for (const auto& p : points) squares[squareOf(p.head<2>().cast<double>())].push_back(p.z());
  std::map<std::pair<int, int>, double> heights;
  for (const auto& [square, values] : squares) heights[square] = levelOf(values);
  return heights;
}

Thing makeThing(const MapHierarchy& map, const MapNode& node, const Eigen::Isometry3d& a_T_node) {
  Thing thing;
  thing.id = node.id();
  thing.label = node.label();
  if (node.parent() && *node.parent() != kRootId) thing.parent = node.parent();
  thing.resolution = node.map().resolution();
  const PointCloud& voxels = node.map().occupiedVoxels();
  thing.voxels.reserve(voxels.size());
  for (const auto& voxel : voxels) {
    const Eigen::Vector3d p = a_T_node * voxel.cast<double>();
    thing.voxels.push_back(p.cast<float>());
    thing.bounds.extend(p);
    thing.position += p / static_cast<double>(voxels.size());
  }
  // Octree order runs through space, so that every k-th voxel is a fair sample.
  const std::size_t step = (voxels.size() + kSample - 1) / kSample;
  for (std::size_t i = 0; i < voxels.size(); i += step) thing.sample.push_back(thing.voxels[i]);
  std::vector<float> heights;
  for (const auto& voxel : thing.voxels) heights.push_back(voxel.z());
  thing.height = levelOf(heights);
  thing.heights = heightsOf(thing.voxels);
  thing.box = Obb{a_T_node, map.node(node.id()).map().occupiedBox()};
  thing.tree = VoxelTree(thing.voxels);
  return thing;
}

Eigen::AlignedBox3d knownBox(const octomap::OcTree& tree) {
  Eigen::AlignedBox3d box;
  if (tree.size() == 0) return box;
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  tree.getMetricMin(low.x(), low.y(), low.z());
  tree.getMetricMax(high.x(), high.y(), high.z());
  return {low, high};
}

}  // namespace

MapSide::MapSide(const MapHierarchy& map, const Eigen::Isometry3d& a_T_world, double fine_resolution)
    : fine_resolution_(fine_resolution) {
  for (const NodeId id : map.ids()) {
    const MapNode& node = map.node(id);
    const Eigen::Isometry3d a_T_node = a_T_world * toIsometry(map.world_T_node(id));
    volumes_.push_back({&node, a_T_node.inverse(), knownBox(node.map().tree()), node.map().occupiedBox()});
    if (id != kRootId && !node.map().occupiedVoxels().empty()) {
      things_.push_back(makeThing(map, node, a_T_node));
    }
  }
}

double Thing::heightNear(const Eigen::Vector2d& xy) const {
  const auto found = heights.find(squareOf(xy));
  return found == heights.end() ? height : found->second;
}

std::optional<std::size_t> MapSide::find(NodeId id) const {
  const auto found =
      std::find_if(things_.begin(), things_.end(), [id](const Thing& thing) { return thing.id == id; });
  if (found == things_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - things_.begin());
}

Place MapSide::lookUp(const Volume& volume, const Eigen::Vector3d& p) {
  const Eigen::Vector3d local = volume.node_T_a * p;
  if (!volume.known.contains(local)) return Place::unknown;
  const octomap::OcTree& tree = volume.node->map().tree();
  octomap::OcTreeKey key;
  if (!tree.coordToKeyChecked(local.x(), local.y(), local.z(), key)) return Place::unknown;
  const auto* voxel = tree.search(key);
  if (voxel == nullptr) return Place::unknown;
  return tree.isNodeOccupied(voxel) ? Place::occupied : Place::free;
}

bool MapSide::sidesKnown(const Volume& volume, const Eigen::Vector3d& p) const {
  const double r = volume.node->map().resolution();
  for (const double dx : {-r, 0.0, r}) {
    for (const double dy : {-r, 0.0, r}) {
      if (lookUp(volume, p + Eigen::Vector3d(dx, dy, 0.0)) == Place::unknown) return false;
    }
  }
  return true;
}

Place MapSide::at(const Eigen::Vector3d& p, Trust trust) const {
  Place place = Place::unknown;
  for (const Volume& volume : volumes_) {
    const Place here = lookUp(volume, p);
    if (here == Place::unknown) continue;
    const bool coarse = volume.node->map().resolution() > fine_resolution_;
    if (coarse && trust == Trust::fine) continue;
    if (coarse && trust == Trust::sure && !sidesKnown(volume, p)) continue;
    if (here == Place::occupied) return here;
    place = here;
  }
  return place;
}

bool MapSide::surfaceIn(const Label& label, const Eigen::Vector2d& xy, double top, double bottom) const {
  for (const Volume& volume : volumes_) {
    if (volume.node->label() != label || volume.occupied.isEmpty()) continue;
    const double step = 0.5 * volume.node->map().resolution();
    for (double z = top; z >= bottom; z -= step) {
      const Eigen::Vector3d p(xy.x(), xy.y(), z);
      if (volume.occupied.contains(volume.node_T_a * p) && lookUp(volume, p) == Place::occupied) return true;
    }
  }
  return false;
}

}  // namespace hoctomap
