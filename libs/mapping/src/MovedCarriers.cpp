// SPDX-License-Identifier: BSD-3-Clause
#include "MovedCarriers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "SurfacePoints.h"

namespace hoctomap {

namespace {

constexpr double kOneMotion = 0.02;        // m, between where two children say that a third one went
constexpr std::size_t kMostPoints = 2000;  // of the carrier's surface
constexpr double kLeastContradicted =
    0.02;  // of the carrier's surface where it was: less is the noise of edges
constexpr double kLessContradicted = 0.5;  // of that, where it is now

using Children = std::vector<const MovedObject*>;

Eigen::Vector3d centreOf(const MapHierarchy& hierarchy, NodeId id) {
  return toIsometry(hierarchy.world_T_node(id)).translation();
}

/// Whether the scan clearly shows a child that did not move: in its place may be another one.
bool someChildStays(const MapHierarchy& hierarchy, NodeId carrier, const Children& moved,
                    const std::map<NodeId, Evidence>& support, double least_present) {
  const auto& children = hierarchy.node(carrier).children();
  return std::any_of(children.begin(), children.end(), [&](NodeId child) {
    const auto found = support.find(child);
    const bool is_moved =
        std::any_of(moved.begin(), moved.end(), [&](const MovedObject* m) { return m->node == child; });
    return !is_moved && found != support.end() && found->second.informative &&
           found->second.presentShare() >= least_present;
  });
}

/// The turn about the vertical and the shift that fit where all the children went: a child alone says less of
/// the turn, a round one nothing.
Eigen::Isometry3d jointMotion(const MapHierarchy& hierarchy, const Children& children,
                              const Eigen::Isometry3d& first) {
  Eigen::Vector3d mean_before = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_after = Eigen::Vector3d::Zero();
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> centres;
  for (const MovedObject* child : children) {
    const Eigen::Vector3d centre = centreOf(hierarchy, child->node);
    centres.emplace_back(centre, child->registration.motion * centre);
    mean_before += centres.back().first / static_cast<double>(children.size());
    mean_after += centres.back().second / static_cast<double>(children.size());
  }
  double along = 0.0;
  double across = 0.0;
  double spread = 0.0;
  for (const auto& [before, after] : centres) {
    const Eigen::Vector3d a = before - mean_before;
    const Eigen::Vector3d b = after - mean_after;
    along += a.x() * b.x() + a.y() * b.y();
    across += a.x() * b.y() - a.y() * b.x();
    spread = std::max(spread, a.head<2>().norm());
  }
  constexpr double kLeastSpread = 0.1;  // m; below it the turn of a child is better known
  if (spread < kLeastSpread) return first;
  return Eigen::Translation3d(mean_after) *
         Eigen::AngleAxisd(std::atan2(across, along), Eigen::Vector3d::UnitZ()) *
         Eigen::Translation3d(-mean_before);
}

/// Share of the surface that the scan sees through, of what it shows.
double contradictedShare(const PointCloud& world_surface, const Eigen::Isometry3d& motion,
                         const ScanSight& sight) {
  const Eigen::Isometry3f m = motion.cast<float>();
  std::size_t shown = 0;
  std::size_t through = 0;
  const std::size_t step = std::max<std::size_t>(1, world_surface.size() / kMostPoints);
  for (std::size_t i = 0; i < world_surface.size(); i += step) {
    const Sight s = sight(m * world_surface[i]);
    shown += s == Sight::hidden ? 0U : 1U;
    through += s == Sight::seen_through ? 1U : 0U;
  }
  return shown == 0 ? 1.0 : static_cast<double>(through) / static_cast<double>(shown);
}

/// The children that a motion takes to where they were found, each once.
Children followers(const MapHierarchy& hierarchy, const Children& children, const Eigen::Isometry3d& motion) {
  std::map<NodeId, std::pair<double, const MovedObject*>> nearest;
  for (const MovedObject* child : children) {
    const Eigen::Vector3d centre = centreOf(hierarchy, child->node);
    const double off = (motion * centre - child->registration.motion * centre).norm();
    if (off >= kOneMotion) continue;
    const auto [found, is_new] = nearest.try_emplace(child->node, off, child);
    if (!is_new && off < found->second.first) found->second = {off, child};
  }
  Children agree;
  for (const auto& [id, child] : nearest) agree.push_back(child.second);
  return agree;
}

}  // namespace

std::vector<MovedCarrier> findMovedCarriers(const MapHierarchy& hierarchy,
                                            std::span<const MovedObject> objects,
                                            const std::map<NodeId, Evidence>& support, const ScanSight& sight,
                                            const ReidentificationConfig& config) {
  if (!config.enabled || !sight.hasImage()) return {};
  std::map<NodeId, Children> by_carrier;
  for (const MovedObject& object : objects) {
    const NodeId carrier = hierarchy.node(object.node).parent().value_or(kRootId);
    if (carrier != kRootId) by_carrier[carrier].push_back(&object);
  }
  std::vector<MovedCarrier> carriers;
  for (const auto& [carrier, children] : by_carrier) {
    if (someChildStays(hierarchy, carrier, children, support, config.most_present)) continue;
    const PointCloud surface = worldSurface(hierarchy, carrier);
    const double at_rest = contradictedShare(surface, Eigen::Isometry3d::Identity(), sight);
    if (at_rest < kLeastContradicted) continue;
    MovedCarrier best{carrier, Eigen::Isometry3d::Identity(), 0.0};
    double least = kLessContradicted * at_rest;
    std::size_t most = 0;
    for (const MovedObject* child : children)
      most = std::max(most, followers(hierarchy, children, child->registration.motion).size());
    for (const MovedObject* child : children) {
      const Children agree = followers(hierarchy, children, child->registration.motion);
      if (agree.size() < most) continue;
      const Eigen::Isometry3d motion = jointMotion(hierarchy, agree, child->registration.motion);
      const double contradicted = contradictedShare(surface, motion, sight);
      if (contradicted >= least) continue;
      least = contradicted;
      best.motion = motion;
      best.score = child->registration.score;
    }
    if (best.score > 0.0) carriers.push_back(best);
  }
  return carriers;
}

}  // namespace hoctomap
