// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "RangeBuffer.h"
#include "hoctomap/existence/BeamExistenceModel.h"
#include "hoctomap/existence/RangeView.h"

namespace hoctomap {

/// What is mapped behind nodes, rendered.
struct Support {
  RangeBuffer behind;  ///< clearly behind their surfaces
  RangeBuffer exact;   ///< behind and beside them, as far as voxels are small enough to say where a beam ends
};

/// Compares where beams should end on one node with where they did end.
class BeamComparison {
 public:
  /// @param node     the node's voxels, rendered
  /// @param support  null: nothing. Must outlive this object.
  BeamComparison(const BeamExistenceConfig& config, const RangeView& view, const RangeBuffer& node,
                 const Support* support, double resolution);

  /// @param scan_shift  m in the world, by which the scan shows all off its place: errors are searched about
  /// it
  [[nodiscard]] Evidence evidence(double share_in_view, const ExistenceParameters& parameters,
                                  const Eigen::Vector3d& scan_shift) const;

 private:
  /// A beam that should meet the node.
  struct Beam {
    int u;
    int v;
    float expected;  ///< range of the node's surface
    float nearest;   ///< least and greatest expected range in the neighbourhood of the beam
    float farthest;
    float tolerance;
    bool clear;  ///< what is mapped behind the node is so far behind that no error of the pose hides it
  };
  /// An error of the node's pose as seen by the sensor.
  struct Offset {
    int du = 0;
    int dv = 0;
    float depth = 0.0F;
    double doubt = 0.0;  ///< share of the beams by which it must explain more than no error at all
  };
  struct Counts {
    std::uint32_t present = 0;  ///< clear beams only
    std::uint32_t absent = 0;
    std::uint32_t unclear_present = 0;  ///< they may end on what is right behind the node as well
    std::uint32_t unclear_absent = 0;
    std::uint32_t nearer_to_node = 0;  ///< all that end on the node rather than on what is behind it
    std::uint32_t occluded = 0;
    std::uint32_t no_return = 0;

    [[nodiscard]] std::uint32_t present_at_most() const { return present + unclear_present; }
    [[nodiscard]] std::uint32_t reached() const { return present_at_most() + absent + unclear_absent; }
  };
  /// The end of a beam.
  struct End {
    float measured;    ///< 0: no return
    float background;  ///< range of what is mapped there anyway
  };

  void collectBeams(const RangeBuffer& node, double resolution);
  /// Where the beams did end, if the node is off by (du, dv) pixels.
  void measure(const std::vector<Beam>& beams, int du, int dv, std::vector<End>& ends) const;
  [[nodiscard]] static Counts count(const std::vector<Beam>& beams, const std::vector<End>& ends,
                                    float depth);
  /// @param scratch  reused from call to call
  [[nodiscard]] float depthOffset(const std::vector<Beam>& beams, const std::vector<End>& ends, float about,
                                  std::vector<float>& scratch) const;
  [[nodiscard]] Offset bestOffset(const Offset& about) const;
  /// What an offset is in the world, m, and the other way round.
  [[nodiscard]] Eigen::Vector3d shiftOf(const Offset& offset) const;
  [[nodiscard]] Offset offsetOf(const Eigen::Vector3d& shift) const;

  const BeamExistenceConfig& config_;
  const RangeView& view_;
  const Support* support_;
  std::vector<Beam> beams_;
};

}  // namespace hoctomap
