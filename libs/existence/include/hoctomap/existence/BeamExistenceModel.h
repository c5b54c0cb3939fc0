// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/existence/InverseExistenceModel.h"

namespace hoctomap {

/// Range noise: sigma(z) = noise_constant + noise_quadratic z^2, metres.
struct RangeNoise {
  double constant = 0.0;      ///< metres
  double quadratic = 1.5e-3;  ///< 1/m
  [[nodiscard]] double sigma(double range) const { return constant + quadratic * range * range; }
};

/// Parameters of the visibility model.
struct BeamExistenceConfig {
  double pose_shift = 0.02;   ///< m, largest sideways error of a node or scan pose that is searched out
  double pose_depth = 0.01;   ///< m, the same along the beam
  double window = 0.003;      ///< m, half width of the neighbourhood a beam is compared with
  double tolerance = 0.004;   ///< m, added to 0.87 voxels and 3 sigma of the range
  int min_beams = 10;         ///< present + absent beams below which a scan says nothing
  double min_visible = 0.10;  ///< share of the node's beams that must be informative
  double min_in_view = 0.35;  ///< share of the node that must be inside the image
  int max_beams = 400;        ///< beams used a node (strided)
  RangeNoise noise;

  /// The same for a node that was mapped from where the sensor still is: a third of the errors is left, for
  /// what the noise of the range does to edges.
  [[nodiscard]] BeamExistenceConfig forSameView() const {
    BeamExistenceConfig config = *this;
    config.pose_shift *= 0.3;
    config.pose_depth *= 0.3;
    return config;
  }

  /// Metres by which the end of a beam may miss a node's voxels at this range and still be on them.
  [[nodiscard]] double rangeTolerance(double resolution, double range) const {
    return tolerance + 0.87 * resolution + 3.0 * noise.sigma(range);
  }
};

/// The visibility model of docs/decisions/0006: a z-buffer of the node's occupied voxels against the scan's
/// own range image, with the error of the pose searched out per node. Nodes are compared in parallel.
class BeamExistenceModel : public InverseExistenceModel {
 public:
  explicit BeamExistenceModel(const BeamExistenceConfig& config) : config_(config) {}

  [[nodiscard]] std::vector<Evidence> evidence(const MapHierarchy& hierarchy, const Measurement& measurement,
                                               const std::vector<NodeInQuestion>& nodes) const override;

  /// As far as the scan's farthest return: what lies beyond is hidden at best.
  [[nodiscard]] Eigen::AlignedBox3d reach(const Measurement& measurement) const override;

 private:
  BeamExistenceConfig config_;
};

}  // namespace hoctomap
