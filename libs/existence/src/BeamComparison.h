// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "RangeBuffer.h"
#include "hoctomap/existence/BeamExistenceModel.h"
#include "hoctomap/existence/RangeView.h"

namespace hoctomap {

/// Compares where beams should end on one node with where they did end.
class BeamComparison {
 public:
  /// @param node     the node's voxels, rendered
  /// @param support  what is mapped behind it; null: nothing
  BeamComparison(const BeamExistenceConfig& config, const RangeView& view, const RangeBuffer& node,
                 const RangeBuffer* support, double resolution);

  [[nodiscard]] Evidence evidence(double share_in_view, const ExistenceParameters& parameters) const;

 private:
  /// A beam that should meet the node.
  struct Beam {
    int u;
    int v;
    float expected;  ///< range of the node's surface
    float nearest;   ///< least and greatest expected range in the neighbourhood of the beam
    float farthest;
    float tolerance;
  };
  /// An error of the node's pose as seen by the sensor.
  struct Offset {
    int du = 0;
    int dv = 0;
    float depth = 0.0F;
  };
  struct Counts {
    std::uint32_t present = 0;
    std::uint32_t absent = 0;
    std::uint32_t occluded = 0;
    std::uint32_t no_return = 0;
  };

  void collectBeams(const RangeBuffer& node, const RangeBuffer* support, double resolution);
  /// Where the beams did end, if the node is off by (du, dv) pixels; 0: no return.
  void measure(const std::vector<Beam>& beams, int du, int dv, std::vector<float>& measured) const;
  [[nodiscard]] static Counts count(const std::vector<Beam>& beams, const std::vector<float>& measured,
                                    float depth);
  /// @param scratch  reused from call to call
  [[nodiscard]] float depthOffset(const std::vector<Beam>& beams, const std::vector<float>& measured,
                                  std::vector<float>& scratch) const;
  [[nodiscard]] Offset bestOffset() const;

  const BeamExistenceConfig& config_;
  const RangeView& view_;
  std::vector<Beam> beams_;
  std::uint32_t uninformative_ = 0;  ///< beams that would end at the same range without the node
};

}  // namespace hoctomap
