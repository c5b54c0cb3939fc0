// SPDX-License-Identifier: BSD-3-Clause
#include "vi_b/Pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hoctomap/io/MapDirectory.h"
#include "measuring/Figures.h"
#include "measuring/OwnProcess.h"

namespace hoctomap {

namespace {

constexpr double kBeside = 0.18;     // m; objects that near belong in the picture
constexpr double kElevation = 25.0;  // degrees

Eigen::AlignedBox3d padded(const Eigen::AlignedBox3d& box, double pad) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(pad);
  return {box.min() - margin, box.max() + margin};
}

/// An occupied voxel at each of the points. Of a map that is only looked at, one hit a voxel is enough.
NodeMap mapOf(const PointCloud& centers, double resolution, const OccupancyModel& model) {
  auto tree = std::make_unique<octomap::OcTree>(resolution);
  model.applyTo(*tree);
  for (const Eigen::Vector3f& p : centers) tree->setNodeValue(p.x(), p.y(), p.z(), 1.0F, true);
  tree->updateInnerOccupancy();
  return {std::move(tree), model};
}

bool contains(const octomap::OcTree& tree, const Eigen::Vector3f& p) {
  return tree.search(p.x(), p.y(), p.z()) != nullptr;
}

/// The part of a node in the frame, without the ghosts; in the node's frame.
PointCloud cutOf(const MapHierarchy& map, NodeId id, const octomap::OcTree& ghosts,
                 const Eigen::AlignedBox3d& box) {
  const Eigen::Isometry3d world_T_node = toIsometry(map.world_T_node(id));
  PointCloud cut;
  for (const Eigen::Vector3f& voxel : map.node(id).map().occupiedVoxels()) {
    const Eigen::Vector3d world = world_T_node * voxel.cast<double>();
    if (box.contains(world) && !contains(ghosts, world.cast<float>())) cut.push_back(voxel);
  }
  return cut;
}

MapHierarchy cutMap(const MapHierarchy& map, const PointCloud& ghosts, const Eigen::AlignedBox3d& box) {
  const NodeMap& root = map.root().map();
  MapHierarchy cut(labels::background, NodeMap(root.resolution(), root.model()));
  double finest = root.resolution();
  for (const NodeId id : map.ids()) finest = std::min(finest, map.node(id).map().resolution());
  NodeMap ghost_map = mapOf(ghosts, finest, root.model());
  for (const NodeId id : map.preorder()) {
    const MapNode& node = map.node(id);
    const PointCloud part = cutOf(map, id, ghost_map.tree(), box);
    if (part.empty()) continue;
    cut.add(node.label(), mapOf(part, node.map().resolution(), node.map().model()), map.world_T_node(id),
            kRootId);
  }
  if (!ghosts.empty()) cut.add(Label{"ghost"}, std::move(ghost_map), Pose(), kRootId);
  return cut;
}

}  // namespace

PictureFrame frameAround(const RemovedNode& gone, const MapHierarchy& now, const Eigen::Vector3d& sensor) {
  const Eigen::AlignedBox3d object =
      worldBounds({toIsometry(gone.world_T_node), gone.node.map().occupiedBox()});
  const Eigen::AlignedBox3d beside = padded(object, kBeside);
  PictureFrame frame;
  frame.box = beside;
  for (const NodeId id : now.ids()) {
    if (now.node(id).label() != labels::object) continue;
    const Eigen::AlignedBox3d other = worldBounds(now.box(id));
    if (other.isEmpty() || !beside.intersects(other)) continue;
    frame.box.max().z() = std::max(frame.box.max().z(), other.max().z());
  }
  const Eigen::Vector3d behind = object.center() - sensor;
  // Somewhat aside, so that the object in front is not all hidden.
  frame.azimuth = std::atan2(behind.y(), behind.x()) * 180.0 / std::numbers::pi + 30.0;
  return frame;
}

void renderCut(const MapHierarchy& map, const PointCloud& ghosts, const PictureFrame& frame,
               const Settings& settings, const std::filesystem::path& file) {
  const std::filesystem::path directory = file.string() + "_cut";
  {
    MapDirectory writer(directory,
                        {MapOpenMode::overwrite, toIni(settings), "hoctomap-experiments vi-b", {}});
    writer.commit({.hierarchy = cutMap(map, ghosts, frame.box), .removed = {}, .scans = 1});
  }
  const std::string view = numberText(std::round(frame.azimuth)) + "," + numberText(kElevation);
  static_cast<void>(runApart(findHoctomap(), {"render", directory.string(), "-o", file.string() + ".png",
                                              "--size", "1000x700", "--view", view}));
}

}  // namespace hoctomap
