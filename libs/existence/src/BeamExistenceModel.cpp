// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/existence/BeamExistenceModel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "BeamComparison.h"
#include "RangeBuffer.h"
#include "hoctomap/existence/RangeView.h"
#include "hoctomap/existence/ScanShift.h"
#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap {

namespace {

constexpr double kClearlyPresent = 0.85;  // share of a node's beams
constexpr std::size_t kLeastOthers = 2;   // nodes that agree on the error of a scan's pose

/// Range beyond which no node can be told from one that is hidden: the farthest return, a pose error and the
/// tolerance of a voxel there.
double reachOf(const RangeView& view, const BeamExistenceConfig& config, double resolution) {
  const double farthest = view.farthest() + config.pose_depth;
  double reach = farthest;
  for (int step = 0; step < 4; ++step) reach = farthest + config.rangeTolerance(resolution, reach);
  return 1.01 * reach;
}

/// A node as the sensor would see it.
struct Silhouette {
  RangeBuffer nearest;
  double share_in_view = 0.0;     ///< of the node's voxels
  double background_range = 0.0;  ///< m; what stands farther behind the node does not matter
};

/// The pixels of the node's occupied voxels that are inside the image.
std::vector<RangeView::Pixel> pixelsOf(const NodeMap& map, const Pose& world_T_node, const RangeView& view) {
  const Eigen::Isometry3f world_T = toIsometry(world_T_node).cast<float>();
  std::vector<RangeView::Pixel> pixels;
  for (const auto& voxel : map.occupiedVoxels()) {
    const auto pixel = view.project(world_T * voxel);
    if (pixel &&
        view.contains(static_cast<int>(std::floor(pixel->u)), static_cast<int>(std::floor(pixel->v)))) {
      pixels.push_back(*pixel);
    }
  }
  return pixels;
}

/// Renders the node's occupied voxels; nothing if none of them is in view.
std::optional<Silhouette> render(const MapHierarchy& hierarchy, NodeId id, const RangeView& view,
                                 const BeamExistenceConfig& config) {
  const NodeMap& map = hierarchy.node(id).map();
  if (!view.mayShow(hierarchy.box(id), reachOf(view, config, map.resolution()))) return std::nullopt;
  const auto pixels = pixelsOf(map, hierarchy.world_T_node(id), view);
  if (pixels.empty()) return std::nullopt;
  Eigen::AlignedBox2f field;
  float farthest = 0.0F;
  for (const auto& pixel : pixels) {
    field.extend(Eigen::Vector2f(pixel.u, pixel.v));
    farthest = std::max(farthest, pixel.range);
  }
  const int margin = 2;
  Silhouette s{RangeBuffer(std::max(0, static_cast<int>(field.min().x()) - margin),
                           std::max(0, static_cast<int>(field.min().y()) - margin),
                           std::min(view.width() - 1, static_cast<int>(field.max().x()) + margin),
                           std::min(view.height() - 1, static_cast<int>(field.max().y()) + margin)),
               static_cast<double>(pixels.size()) / static_cast<double>(map.occupiedVoxels().size()),
               farthest + 2.0 * config.rangeTolerance(map.resolution(), farthest) + config.pose_depth};
  for (const auto& pixel : pixels) s.nearest.splat(pixel, view.focal(), static_cast<float>(map.resolution()));
  return s;
}

/// What stands behind the nodes in question: all nodes that have a child, and the root. Their voxels are
/// coarse: one that is not clearly behind a node's surface says nothing of what a beam would meet if the node
/// was gone.
Support renderSupport(const MapHierarchy& hierarchy, const RangeView& view,
                      const std::vector<NodeInQuestion>& nodes,
                      const std::vector<std::optional<Silhouette>>& silhouettes,
                      const BeamExistenceConfig& config) {
  Eigen::AlignedBox2i field;
  double range = 0.0;
  for (const auto& s : silhouettes) {
    if (!s) continue;
    field.extend(Eigen::Vector2i(s->nearest.u0(), s->nearest.v0()));
    field.extend(Eigen::Vector2i(s->nearest.u1(), s->nearest.v1()));
    range = std::max(range, s->background_range);
  }
  RangeBuffer front(field.min().x(), field.min().y(), field.max().x(), field.max().y());
  Support support{front, front};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (silhouettes[i] && hierarchy.node(nodes[i].id).children().empty())
      front.overlay(silhouettes[i]->nearest);
  }
  const double pixels = 2.0 * range / view.focal();  // that a voxel's square may stick out
  const Eigen::AlignedBox3d seen = view.worldBounds(range);
  const Eigen::AlignedBox3d bounds(seen.min().array() - pixels, seen.max().array() + pixels);
  for (const NodeId id : hierarchy.idsNear(bounds)) {
    const MapNode& node = hierarchy.node(id);
    if (id != kRootId && node.children().empty()) continue;
    const double edge = node.map().resolution();
    if (!view.mayShow(hierarchy.box(id).padded(edge + pixels), range)) continue;
    const Eigen::Isometry3d world_T_node = toIsometry(hierarchy.world_T_node(id));
    // Half a diagonal: by as much a coarse voxel errs.
    const bool is_exact = 0.87 * edge <= config.pose_depth + config.tolerance;
    // The root may be a building: of it what is in view.
    const PointCloud of_root = id == kRootId
                                   ? node.map().occupiedVoxelsIn(bounds.transformed(world_T_node.inverse()))
                                   : PointCloud{};
    const PointCloud& voxels = id == kRootId ? of_root : node.map().occupiedVoxels();
    RangeBuffer& buffer = is_exact ? support.exact : support.behind;
    const Eigen::Isometry3f world_T_voxels = world_T_node.cast<float>();
    for (const auto& voxel : voxels) {
      if (const auto pixel = view.project(world_T_voxels * voxel))
        buffer.splatBehind(front, *pixel, view.focal(), static_cast<float>(edge), is_exact);
    }
  }
  support.behind.overlay(support.exact);
  return support;
}

}  // namespace

Eigen::AlignedBox3d BeamExistenceModel::reach(const Measurement& measurement) const {
  constexpr double kCoarsest = 1.0;  // m, no node is coarser
  const RangeView view(measurement);
  if (view.width() == 0) return {};
  return view.worldBounds(reachOf(view, config_, kCoarsest));
}

std::vector<Evidence> BeamExistenceModel::evidence(const MapHierarchy& hierarchy,
                                                   const Measurement& measurement,
                                                   const std::vector<NodeInQuestion>& nodes) const {
  std::vector<Evidence> result(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) result[i].p_measurement = nodes[i].parameters.prior;
  const RangeView view(measurement);
  if (nodes.empty() || view.width() == 0) return result;

  std::vector<std::optional<Silhouette>> silhouettes(nodes.size());
  forEachIndex(nodes.size(),
               [&](std::size_t i) { silhouettes[i] = render(hierarchy, nodes[i].id, view, config_); });
  if (std::none_of(silhouettes.begin(), silhouettes.end(), [](const auto& s) { return s.has_value(); }))
    return result;
  const Support support = renderSupport(hierarchy, view, nodes, silhouettes, config_);
  const BeamExistenceConfig same_view = config_.forSameView();
  const auto compare = [&](std::size_t i, const BeamExistenceConfig& config, const Eigen::Vector3d& shift) {
    const MapNode& node = hierarchy.node(nodes[i].id);
    // A supporting node must not be its own background.
    const BeamComparison comparison(config, view, silhouettes[i]->nearest,
                                    node.children().empty() ? &support : nullptr, node.map().resolution());
    return comparison.evidence(silhouettes[i]->share_in_view, nodes[i].parameters, shift);
  };
  forEachIndex(nodes.size(), [&](std::size_t i) {
    if (silhouettes[i])
      result[i] = compare(i, nodes[i].same_view ? same_view : config_, Eigen::Vector3d::Zero());
  });
  // The error is the scan's. Where others show it, a node in doubt has to be explained by it, too.
  std::map<NodeId, Evidence> first;
  for (std::size_t i = 0; i < nodes.size(); ++i) first[nodes[i].id] = result[i];
  forEachIndex(nodes.size(), [&](std::size_t i) {
    if (!result[i].informative || nodes[i].same_view || result[i].presentShare() >= kClearlyPresent) return;
    if (const auto shift = commonShift(hierarchy, first, nodes[i].id, kClearlyPresent, kLeastOthers))
      result[i] = compare(i, same_view, *shift);
  });
  return result;
}

}  // namespace hoctomap
