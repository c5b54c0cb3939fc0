// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/existence/BeamExistenceModel.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "BeamComparison.h"
#include "RangeBuffer.h"
#include "hoctomap/existence/RangeView.h"

namespace hoctomap {

namespace {

/// A node as the sensor would see it.
struct Silhouette {
  RangeBuffer nearest;
  double share_in_view = 0.0;  ///< of the node's voxels
};

/// Renders the node's occupied voxels; nothing if none of them is in view.
std::optional<Silhouette> render(const MapHierarchy& hierarchy, NodeId id, const RangeView& view) {
  const NodeMap& map = hierarchy.node(id).map();
  const Eigen::Isometry3f world_T_node = toIsometry(hierarchy.world_T_node(id)).cast<float>();
  std::vector<RangeView::Pixel> pixels;
  Eigen::AlignedBox2f field;
  for (const auto& voxel : map.occupiedVoxels()) {
    const auto pixel = view.project(world_T_node * voxel);
    if (!pixel ||
        !view.contains(static_cast<int>(std::floor(pixel->u)), static_cast<int>(std::floor(pixel->v)))) {
      continue;
    }
    pixels.push_back(*pixel);
    field.extend(Eigen::Vector2f(pixel->u, pixel->v));
  }
  if (pixels.empty()) return std::nullopt;
  const int margin = 2;
  Silhouette s{RangeBuffer(std::max(0, static_cast<int>(field.min().x()) - margin),
                           std::max(0, static_cast<int>(field.min().y()) - margin),
                           std::min(view.width() - 1, static_cast<int>(field.max().x()) + margin),
                           std::min(view.height() - 1, static_cast<int>(field.max().y()) + margin)),
               static_cast<double>(pixels.size()) / static_cast<double>(map.occupiedVoxels().size())};
  for (const auto& pixel : pixels) s.nearest.splat(pixel, view.focal(), static_cast<float>(map.resolution()));
  return s;
}

/// Renders what stands behind the nodes in question: all nodes that have a child, and the root.
RangeBuffer renderSupport(const MapHierarchy& hierarchy, const RangeView& view) {
  RangeBuffer support(0, 0, view.width() - 1, view.height() - 1);
  for (const NodeId id : hierarchy.ids()) {
    const MapNode& node = hierarchy.node(id);
    if (id != kRootId && node.children().empty()) continue;
    const Eigen::Isometry3f world_T_node = toIsometry(hierarchy.world_T_node(id)).cast<float>();
    for (const auto& voxel : node.map().occupiedVoxels()) {
      const auto pixel = view.project(world_T_node * voxel);
      if (pixel) support.splat(*pixel, view.focal(), static_cast<float>(node.map().resolution()));
    }
  }
  return support;
}

}  // namespace

std::vector<Evidence> BeamExistenceModel::evidence(const MapHierarchy& hierarchy,
                                                   const Measurement& measurement,
                                                   const std::vector<NodeId>& nodes,
                                                   const std::vector<ExistenceParameters>& parameters) const {
  std::vector<Evidence> result(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) result[i].p_measurement = parameters[i].prior;
  const RangeView view(measurement);
  if (nodes.empty() || view.width() == 0) return result;

  const RangeBuffer support = renderSupport(hierarchy, view);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto silhouette = render(hierarchy, nodes[i], view);
    if (!silhouette) continue;
    const double resolution = hierarchy.node(nodes[i]).map().resolution();
    // A supporting node must not be its own background.
    const bool is_support = !hierarchy.node(nodes[i]).children().empty();
    const BeamComparison comparison(config_, view, silhouette->nearest, is_support ? nullptr : &support,
                                    resolution);
    result[i] = comparison.evidence(silhouette->share_in_view, parameters[i]);
  }
  return result;
}

}  // namespace hoctomap
