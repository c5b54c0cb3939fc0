// SPDX-License-Identifier: BSD-3-Clause
#include "MovedObjects.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "BeamTraces.h"
#include "SurfacePoints.h"

namespace hoctomap {

namespace {

/// A node that the scan supports less than it should.
struct DoubtfulNode {
  NodeId id;
  bool contradicted = false;
  PointCloud world_voxels;
};

double presentShare(const Evidence& e) {
  return static_cast<double>(e.present) / std::max(1.0, static_cast<double>(e.present + e.absent));
}

std::vector<DoubtfulNode> doubtfulNodes(const MapHierarchy& hierarchy,
                                        std::span<const SegmentInQuestion> segments,
                                        const std::map<NodeId, Evidence>& support, double most_present) {
  std::vector<DoubtfulNode> doubtful;
  for (const auto& [id, evidence] : support) {
    if (!evidence.informative || presentShare(evidence) >= most_present) continue;
    const Label& label = hierarchy.node(id).label();
    if (std::none_of(segments.begin(), segments.end(), [&](const auto& s) { return s.label == label; }))
      continue;
    DoubtfulNode node{id, evidence.contradicts(), worldSurface(hierarchy, id)};
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
    for (std::size_t n = 0; n < doubtful.size(); ++n) {
      for (std::size_t s = 0; s < segments.size(); ++s) {
        if (!isInQuestion(doubtful[n], segments[s], segments)) continue;
        const Registration r = registered(doubtful[n], segments[s]);
        if (r.verdict == Match::same && hasMoved(r, doubtful[n], segments[s])) {
          fits.push_back({n, s, r});
        } else if (r.verdict == Match::ambiguous && !segments[s].node) {
          result.ambiguous.push_back(sentence(doubtful[n], segments[s], "may be", r));
        }
      }
    }
    for (const Fit& fit : fits) {
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
  /// New segments, and the only segment in the node's own box: objects often move within it.
  [[nodiscard]] bool isInQuestion(const DoubtfulNode& node, const SegmentInQuestion& segment,
                                  std::span<const SegmentInQuestion> segments) const {
    if (segment.label != hierarchy_.node(node.id).label()) return false;
    if (segment.node) return *segment.node == node.id;
    return node.contradicted ||
           std::none_of(segments.begin(), segments.end(), [&](const auto& s) { return s.node == node.id; });
  }

  [[nodiscard]] Registration registered(const DoubtfulNode& node, const SegmentInQuestion& segment) const {
    const double range =
        (segment.world_points->front().cast<double>() - origin_).norm();  // all points are about as far
    const auto config = registrationAt(config_, hierarchy_.node(node.id).map().resolution(), range);
    const BeamTraces own(hierarchy_, node.id);
    const BeamTraces root(hierarchy_, kRootId);
    const auto was_shown = [&](const Eigen::Vector3f& p) { return own.isKnown(p) || root.isFree(p); };
    return registerPoints(node.world_voxels, *segment.world_points, config, sight_, was_shown);
  }

  [[nodiscard]] bool hasMoved(const Registration& r, const DoubtfulNode& node,
                              const SegmentInQuestion& segment) const {
    const Eigen::Vector3d centre =
        toIsometry(hierarchy_.world_T_node(node.id)).translation();  // of the first segment's points
    const double shift = (r.motion * centre - centre).norm();
    const double turn = Eigen::AngleAxisd(r.motion.rotation()).angle();
    const double least_shift = std::max(config_.least_shift, hierarchy_.node(node.id).map().resolution());
    if (shift < least_shift && turn < config_.least_turn) return false;
    return !segment.node || r.score >= r.rest_score + config_.least_gain;
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
  const auto doubtful = doubtfulNodes(hierarchy, segments, support, config.most_present);
  if (doubtful.empty()) return {};
  return Finder(hierarchy, origin, sight, config).find(segments, doubtful);
}

}  // namespace hoctomap
