// SPDX-License-Identifier: BSD-3-Clause
// Points and rays: of the nodes that know a place the first in order decides.
#include "hoctomap/query/HierarchyQuery.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "QueryNodes.h"
#include "RayWalk.h"

namespace hoctomap {

namespace {

std::vector<std::size_t> placesInOrder(const std::vector<NodePlace>& places, const QueryConfig& config) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].existence >= config.min_existence && !places[i].extent.known.isEmpty()) order.push_back(i);
  }
  // Finer ones decide, of equally fine ones the deeper.
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    const NodePlace& a = places[i];
    const NodePlace& b = places[j];
    return std::tuple(a.resolution, b.depth, a.id) < std::tuple(b.resolution, a.depth, b.id);
  });
  return order;
}

/// In the world.
std::vector<Eigen::AlignedBox3d> boxesOf(const std::vector<NodePlace>& places,
                                         const std::vector<std::size_t>& order,
                                         Eigen::AlignedBox3d VoxelExtent::*which) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(order.size());
  for (const std::size_t i : order) {
    const Eigen::AlignedBox3d& box = places[i].extent.*which;
    boxes.push_back(box.isEmpty() ? box : worldBounds({places[i].world_T_node, box}));
  }
  return boxes;
}

}  // namespace

HierarchyQuery::Nodes::Nodes(std::shared_ptr<const NodeSource> source, const QueryConfig& config)
    : source_(std::move(source)),
      places_(placesInOrder(source_->places(), config)),
      nodes_(places_.size()),
      known(boxesOf(source_->places(), places_, &VoxelExtent::known)),
      occupied(boxesOf(source_->places(), places_, &VoxelExtent::occupied)) {
  for (const auto& box : boxesOf(source_->places(), places_, &VoxelExtent::known)) anything.extend(box);
}

const QueryNode& HierarchyQuery::Nodes::load(std::size_t i) const {
  const std::lock_guard lock(loading_);
  Slot& slot = nodes_[i];
  if (!slot.node) {
    slot.node.emplace(place(i), source_->map(places_[i]));
    slot.ready.store(true, std::memory_order_release);
  }
  return *slot.node;
}

HierarchyQuery::HierarchyQuery(const MapHierarchy& map, const QueryConfig& config)
    : HierarchyQuery(std::make_shared<const HierarchyNodes>(map), config) {}
HierarchyQuery::HierarchyQuery(std::shared_ptr<const NodeSource> source, const QueryConfig& config)
    : nodes_(std::make_unique<const Nodes>(std::move(source), config)) {}
HierarchyQuery::~HierarchyQuery() = default;
HierarchyQuery::HierarchyQuery(HierarchyQuery&&) noexcept = default;
HierarchyQuery& HierarchyQuery::operator=(HierarchyQuery&&) noexcept = default;

PointAnswer HierarchyQuery::at(const Eigen::Vector3d& world_point) const {
  const Nodes& nodes = *nodes_;
  std::size_t first = nodes.size();
  const octomap::OcTreeNode* voxel = nullptr;
  const auto look = [&](std::size_t i) {
    if (i > first) return;
    const octomap::OcTreeNode* here = nodes[i].voxelAt(nodes[i].node_T_world * world_point);
    if (here == nullptr) return;
    first = i;
    voxel = here;
  };
  std::vector<std::size_t> not_loaded;
  nodes.known.at(world_point, [&](std::size_t i) {
    if (nodes.isLoaded(i)) {
      look(i);
    } else {
      not_loaded.push_back(i);
    }
  });
  // In order: those that another one decides before need not be read.
  std::sort(not_loaded.begin(), not_loaded.end());
  for (const std::size_t i : not_loaded) look(i);
  if (voxel == nullptr) return {};
  const QueryNode& node = nodes[first];
  PointAnswer answer;
  answer.state = voxel->getLogOdds() >= node.occupied_log_odds ? Occupancy::occupied : Occupancy::free;
  answer.probability = 0.5 + node.existence * (voxel->getOccupancy() - 0.5);
  answer.node = node.id;
  return answer;
}

void HierarchyQuery::at(std::span<const Eigen::Vector3d> world_points, std::span<PointAnswer> answers) const {
  if (world_points.size() != answers.size()) {
    throw std::invalid_argument("there must be as many answers as points");
  }
  std::transform(world_points.begin(), world_points.end(), answers.begin(),
                 [this](const Eigen::Vector3d& p) { return at(p); });
}

RayAnswer HierarchyQuery::castRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  const RayOptions& options) const {
  const double length = direction.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw std::invalid_argument("the direction of a ray must be finite and not zero");
  }
  const Eigen::Vector3d along = direction / length;
  const auto end = [&](RayAnswer::End what, double t, std::optional<NodeId> node = std::nullopt) {
    return RayAnswer{what, t, std::isfinite(t) ? Eigen::Vector3d(origin + t * along) : origin, node};
  };

  // From here to there something may be known.
  double enter = 0.0;
  double leave = options.max_range;
  const Eigen::AlignedBox3d& anything = nodes_->anything;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (anything.min()[axis] - origin[axis]) / along[axis];
    const double b = (anything.max()[axis] - origin[axis]) / along[axis];
    if (along[axis] != 0.0) {
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    } else if (origin[axis] < anything.min()[axis] || origin[axis] > anything.max()[axis]) {
      leave = -1.0;
    }
  }
  std::vector<std::size_t> met;
  if (enter <= leave) {
    nodes_->known.along(origin + enter * along, origin + leave * along,
                        [&met](std::size_t i) { met.push_back(i); });
  }
  std::sort(met.begin(), met.end());
  std::vector<RayWalk> walks;
  walks.reserve(met.size());
  for (const std::size_t i : met) walks.emplace_back((*nodes_)[i], origin, along);

  double t = 0.0;
  while (t < leave) {
    double next = leave;
    Occupancy state = Occupancy::unknown;
    const RayWalk* decides = nullptr;
    for (auto walk = walks.begin(); walk != walks.end() && decides == nullptr; ++walk) {
      const RayWalk::Piece piece = walk->at(t);
      next = std::min(next, piece.leave);
      if (piece.state == Occupancy::unknown) continue;
      state = piece.state;
      decides = &*walk;
    }
    if (state == Occupancy::occupied) return end(RayAnswer::End::hit, t, decides->node().id);
    if (state == Occupancy::unknown && !options.ignore_unknown) return end(RayAnswer::End::unknown, t);
    t = next;
  }
  if (!options.ignore_unknown && t < options.max_range) return end(RayAnswer::End::unknown, t);
  return end(RayAnswer::End::nothing, options.max_range);
}

double HierarchyQuery::unknownShare(const Obb& box, double step) const {
  if (box.box.isEmpty()) throw std::invalid_argument("an empty box has no unknown share");
  if (!(step > 0.0)) {
    nodes_->known.meeting(worldBounds(box), [&](std::size_t i) {
      const double resolution = nodes_->place(i).resolution;
      step = step > 0.0 ? std::min(step, resolution) : resolution;
    });
    if (!(step > 0.0)) return 1.0;  // no node is near
  }
  constexpr double kMostCells = 100.0;  // along an edge
  const Eigen::Array3d cells = (box.box.sizes().array() / step - 1e-9).ceil().max(1.0).min(kMostCells);
  const Eigen::Array3d cell = box.box.sizes().array() / cells;
  std::size_t unknown = 0;
  for (double x = 0.5; x < cells.x(); ++x) {
    for (double y = 0.5; y < cells.y(); ++y) {
      for (double z = 0.5; z < cells.z(); ++z) {
        const Eigen::Vector3d p = box.box.min() + (Eigen::Array3d(x, y, z) * cell).matrix();
        unknown += at(box.world_T_frame * p).state == Occupancy::unknown ? 1U : 0U;
      }
    }
  }
  return static_cast<double>(unknown) / cells.prod();
}

}  // namespace hoctomap
