// SPDX-License-Identifier: BSD-3-Clause
#include "MovedObjects.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>

#include "BeamTraces.h"
#include "SurfaceRegistration.h"
#include "hoctomap/existence/ScanShift.h"
#include "hoctomap/geometry/ForEachIndex.h"

namespace hoctomap {

namespace {

/// A node that the scan supports less than it should.
struct DoubtfulNode {
  NodeId id;
  bool contradicted = false;
  Eigen::Vector3d common_shift;  ///< m, by which the scan shows other nodes off their places
  PointCloud world_voxels;
};

std::vector<DoubtfulNode> doubtfulNodes(const MapHierarchy& hierarchy,
                                        std::span<const SegmentInQuestion> segments,
                                        const std::map<NodeId, Evidence>& support,
                                        const ReidentificationConfig& config) {
  std::vector<DoubtfulNode> doubtful;
  for (const auto& [id, evidence] : support) {
    if (!evidence.informative) continue;
    const auto common = commonShift(hierarchy, support, id, config.most_present);
    // Beams may end on a node that has moved by little as they would with an error of the pose; but that
    // error is the same for all.
    const bool is_off = common && (evidence.shift - *common).norm() > 0.5 * config.least_shift;
    if (evidence.presentShare() >= config.most_present && !is_off) continue;
    const Label& label = hierarchy.node(id).label();
    if (std::none_of(segments.begin(), segments.end(), [&](const auto& s) { return s.label == label; }))
      continue;
    DoubtfulNode node{id, evidence.contradicts(), common.value_or(Eigen::Vector3d::Zero()),
                      worldSurface(hierarchy, id)};
    doubtful.push_back(std::move(node));
  }
  return doubtful;
}

struct Fit {
  std::size_t node = 0;  ///< index of the doubtful node
  std::size_t segment = 0;
  Registration registration;
};

/// Whether another fit of the same node or the same segment is as good.
bool hasRival(const Fit& fit, const std::vector<Fit>& fits, double margin) {
  return std::any_of(fits.begin(), fits.end(), [&](const Fit& other) {
    const bool shares = (other.node == fit.node) != (other.segment == fit.segment);
    return shares && other.registration.score > fit.registration.score - margin;
  });
}

/// A node and a segment that may show it.
struct Trial {
  std::size_t node;
  std::size_t segment;
};

class Finder {
 public:
  Finder(const MapHierarchy& hierarchy, const Eigen::Vector3d& origin, const ScanSight& sight,
         const ReidentificationConfig& config)
      : hierarchy_(hierarchy), origin_(origin), config_(config) {
    if (sight.hasImage()) sight_ = std::cref(sight);
  }

  [[nodiscard]] MovedObjects find(std::span<const SegmentInQuestion> segments,
                                  const std::vector<DoubtfulNode>& doubtful) const {
    MovedObjects result;
    std::vector<Fit> fits;
    const std::vector<Trial> trials = trialsOf(segments, doubtful);
    const std::vector<Registration> registrations = registered(trials, segments, doubtful);
    for (std::size_t k = 0; k < trials.size(); ++k) {
      const auto& [n, s] = trials[k];
      const Registration& r = registrations[k];
      if (r.verdict == Match::same && hasMoved(r, doubtful[n], segments[s])) {
        fits.push_back({n, s, r});
      } else if (r.verdict == Match::ambiguous && !segments[s].node) {
        result.ambiguous.push_back(sentence(doubtful[n], segments[s], "may be", r));
      }
    }
    for (const Fit& fit : fits) {
      result.candidates.push_back({doubtful[fit.node].id, fit.segment, fit.registration});
      if (hasRival(fit, fits, config_.rival_score)) {
        result.ambiguous.push_back(sentence(doubtful[fit.node], segments[fit.segment],
                                            "is one of several that may be", fit.registration));
      } else if (isBest(fit, fits)) {
        result.found.push_back({doubtful[fit.node].id, fit.segment, fit.registration});
      }
    }
    return result;
  }

 private:
  [[nodiscard]] std::vector<Trial> trialsOf(std::span<const SegmentInQuestion> segments,
                                            const std::vector<DoubtfulNode>& doubtful) const {
    std::vector<Trial> trials;
    for (std::size_t n = 0; n < doubtful.size(); ++n) {
      for (std::size_t s = 0; s < segments.size(); ++s) {
        if (isInQuestion(doubtful[n], segments[s], segments)) trials.push_back({n, s});
      }
    }
    return trials;
  }

  /// New segments, and the only segment in the node's own box, unless it lies where the node does: objects
  /// often move within it.
  [[nodiscard]] bool isInQuestion(const DoubtfulNode& node, const SegmentInQuestion& segment,
                                  std::span<const SegmentInQuestion> segments) const {
    if (segment.label != hierarchy_.node(node.id).label()) return false;
    if (segment.node) return *segment.node == node.id && !liesAtRest(node, *segment.world_points);
    return node.contradicted ||
           std::none_of(segments.begin(), segments.end(), [&](const auto& s) { return s.node == node.id; });
  }

  /// Whether a segment lies at a node's surface, and the scan shows all of that: asked of few points, because
  /// most nodes in doubt are.
  [[nodiscard]] bool liesAtRest(const DoubtfulNode& node, const PointCloud& world_points) const {
    constexpr std::size_t kSample = 200;
    const RegistrationConfig config = configFor(node, world_points);
    const BeamTraces own(hierarchy_, node.id);
    std::size_t asked = 0;
    std::size_t near = 0;
    for (std::size_t i = 0; i < world_points.size();
         i += std::max<std::size_t>(1, world_points.size() / kSample)) {
      ++asked;
      near += own.mayBeNearSurface(world_points[i], config.near + config.tolerance) ? 1U : 0U;
    }
    if (static_cast<double>(near) < config.at_rest * static_cast<double>(asked)) return false;
    if (!sight_) return false;
    std::size_t shown = 0;
    std::size_t there = 0;
    const PointCloud& voxels = node.world_voxels;
    for (std::size_t i = 0; i < voxels.size(); i += std::max<std::size_t>(1, voxels.size() / kSample)) {
      const Sight sight = sight_(voxels[i]);
      shown += sight == Sight::hidden ? 0U : 1U;
      there += sight == Sight::surface ? 1U : 0U;
    }
    return static_cast<double>(there) >= config.at_rest * static_cast<double>(shown);
  }

  [[nodiscard]] RegistrationConfig configFor(const DoubtfulNode& node, const PointCloud& world_points) const {
    const double range =
        (world_points.front().cast<double>() - origin_).norm();  // all points are about as far
    return registrationAt(config_, hierarchy_.node(node.id).map().resolution(), range);
  }

  /// Each surface is made ready once. In parallel: what comes out does not depend on the order.
  [[nodiscard]] std::vector<Registration> registered(const std::vector<Trial>& trials,
                                                     std::span<const SegmentInQuestion> segments,
                                                     const std::vector<DoubtfulNode>& doubtful) const {
    const double spacing = config_.registration.spacing;
    std::vector<std::unique_ptr<RegistrationSurface>> models(doubtful.size());
    std::vector<std::unique_ptr<RegistrationSurface>> seen(segments.size());
    std::vector<RegistrationSight> sights;
    for (const DoubtfulNode& node : doubtful) sights.push_back(sightFor(node.id));
    std::set<std::size_t> nodes_asked;
    std::set<std::size_t> segments_asked;
    for (const auto& [n, s] : trials) {
      nodes_asked.insert(n);
      segments_asked.insert(s);
    }
    std::vector<std::function<void()>> preparations;
    for (const std::size_t n : nodes_asked) {
      preparations.emplace_back([&, n] {
        models[n] = std::make_unique<RegistrationSurface>(doubtful[n].world_voxels, spacing);
        orientModel(*models[n], sights[n]);
      });
    }
    for (const std::size_t s : segments_asked) {
      preparations.emplace_back([&, s] {
        seen[s] = std::make_unique<RegistrationSurface>(*segments[s].world_points, spacing);
        orientSeen(*seen[s], RegistrationSight{nullptr, origin_});
      });
    }
    forEachIndex(preparations.size(), [&](std::size_t k) { preparations[k](); });
    std::vector<Registration> result(trials.size());
    forEachIndex(trials.size(), [&](std::size_t k) {
      const auto& [n, s] = trials[k];
      const DoubtfulNode& node = doubtful[n];
      MotionNeeds needs;
      if (segments[s].node) needs = [&](const Registration& rest) { return neededInPlace(node, rest); };
      result[k] = registerSurfaces(*models[n], *seen[s], configFor(node, *segments[s].world_points),
                                   sights[n], needs);
    });
    return result;
  }

  [[nodiscard]] RegistrationSight sightFor(NodeId id) const {
    const BeamTraces own(hierarchy_, id);
    const BeamTraces root(hierarchy_, kRootId);
    RegistrationSight sight;
    sight.now = sight_;
    sight.origin = origin_;
    sight.was_free = [root](const Eigen::Vector3f& p) { return root.isFree(p); };
    sight.beside = 0.7 * root.voxelDiagonal();
    sight.was_shown = [own, root](const Eigen::Vector3f& p) { return own.isKnown(p) || root.isFree(p); };
    return sight;
  }

  [[nodiscard]] bool hasMoved(const Registration& r, const DoubtfulNode& node,
                              const SegmentInQuestion& segment) const {
    constexpr std::size_t kSample = 200;
    const Eigen::Isometry3d motion = Eigen::Translation3d(-node.common_shift) * r.motion;
    double sum = 0.0;
    double up = 0.0;
    std::size_t asked = 0;
    const PointCloud& voxels = node.world_voxels;
    for (std::size_t i = 0; i < voxels.size();
         i += std::max<std::size_t>(1, voxels.size() / kSample), ++asked) {
      const Eigen::Vector3d p = voxels[i].cast<double>();
      const Eigen::Vector3d moved = motion * p - p;
      sum += moved.norm();
      up += moved.z();
    }
    const double least_shift = std::max(config_.least_shift, hierarchy_.node(node.id).map().resolution());
    if (sum < least_shift * static_cast<double>(asked)) return false;
    if (!segment.node) return true;
    // Within its place it still stands on what it stood on.
    if (std::abs(up) > config_.registration.near * static_cast<double>(asked)) return false;
    return r.score >= leastInPlace(node, r.rest_score);
  }

  /// The same before it is known, and whether there can be one: where hardly a beam goes through a thing, it
  /// is where it was, and what is seen besides is other sides of it. A box turned by a half would explain
  /// them.
  [[nodiscard]] std::optional<double> neededInPlace(const DoubtfulNode& node,
                                                    const Registration& rest) const {
    constexpr double kAtItsEdges = 0.05;  // share of the surface that is shown; motions left 0.1 and more
    if (sight_ && !node.contradicted && rest.seen_through < kAtItsEdges) return std::nullopt;
    return leastInPlace(node, rest.score);
  }

  /// The score that a motion within the node's own box needs.
  [[nodiscard]] double leastInPlace(const DoubtfulNode& node, double rest_score) const {
    constexpr double kMisfitLeft = 1.0 / 3.0;
    const double gain = rest_score + config_.least_gain;
    if (node.contradicted) return gain;
    // Where most beams still end on the node, its views may just differ.
    return std::max(gain, std::min(config_.least_in_place, 1.0 - kMisfitLeft * (1.0 - rest_score)));
  }

  static bool isBest(const Fit& fit, const std::vector<Fit>& fits) {
    return std::none_of(fits.begin(), fits.end(), [&](const Fit& other) {
      const bool shares = (other.node == fit.node) != (other.segment == fit.segment);
      return shares && other.registration.score > fit.registration.score;
    });
  }

  [[nodiscard]] static std::string sentence(const DoubtfulNode& node, const SegmentInQuestion& segment,
                                            const std::string& verb, const Registration& r) {
    return "a segment of " + std::to_string(segment.world_points->size()) + " points " + verb + " node " +
           std::to_string(node.id.value) + " (overlap " + std::to_string(r.score).substr(0, 4) +
           "): not taken for it";
  }

  const MapHierarchy& hierarchy_;
  Eigen::Vector3d origin_;
  const ReidentificationConfig& config_;
  std::function<Sight(const Eigen::Vector3f&)> sight_;  ///< none: the scan shows its own points only
};

}  // namespace

RegistrationConfig registrationAt(const ReidentificationConfig& config, double resolution, double range) {
  RegistrationConfig registration = config.registration;
  // Half a voxel, and what the noise has more than that of a camera at a metre.
  registration.tolerance = 0.5 * resolution + std::max(0.0, config.noise.sigma(range) - 0.0015);
  return registration;
}

MovedObjects findMovedObjects(const MapHierarchy& hierarchy, const Eigen::Vector3d& origin,
                              const ScanSight& sight, std::span<const SegmentInQuestion> segments,
                              const std::map<NodeId, Evidence>& support,
                              const ReidentificationConfig& config) {
  if (!config.enabled || segments.empty()) return {};
  const auto doubtful = doubtfulNodes(hierarchy, segments, support, config);
  if (doubtful.empty()) return {};
  return Finder(hierarchy, origin, sight, config).find(segments, doubtful);
}

}  // namespace hoctomap
