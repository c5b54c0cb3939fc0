// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/exploration/KnowledgeGrid.h"
#include "hoctomap/exploration/Robot.h"

namespace hoctomap {

enum class GainMeasure : std::uint8_t {
  entropy,     ///< Eq. 14-15 in the paper's closed form: unknown cells on each ray times dH
  swept_cells  ///< how many *distinct* unknown cells the whole measurement sweeps
};

enum class UnknownSpace : std::uint8_t {
  transparent,  ///< the paper: beams go on through unknown cells
  occluding     ///< they get through with a probability that falls with the way: exp(-way / attenuation)
};

struct GainConfig {
  GainMeasure measure = GainMeasure::swept_cells;
  UnknownSpace unknown_space = UnknownSpace::occluding;
  double attenuation = 0.15;  ///< m of unknown space
  int columns = 48;           ///< rays of a view: a coarse image of the camera's
  int rows = 36;
  OccupancyModel sensor;  ///< dH of `entropy` comes from it
};

/// What counts as to be found out.
enum class Wanted : std::uint8_t { boxes, everything };

/// I(M_t; v) of Eq. 15, by rays from the viewpoint over the sensor's field of view.
///
/// All rays pass through free cells and end at occupied ones, at the table, or at the sensor's range.
/// `entropy` counts unknown cells along each ray, times the change of entropy that the sensor model makes of
/// one. `swept_cells` sums (pixel z)^2 dz / r^3 over the rays' ways dz through unknown cells of resolution r:
/// the volume that a pixel of a ray sweeps, in cells. So a cell counts once however many rays meet it, and
/// cells of different size by their number.
class ExpectedInformationGain {
 public:
  ExpectedInformationGain(const GainConfig& config, const RobotModel& robot);

  /// @return bits (`entropy`) or cells (`swept_cells`).
  [[nodiscard]] double operator()(const KnowledgeGrid& knowledge, const Viewpoint& v, Wanted wanted) const;

  /// Change of entropy that one measurement makes of an unknown cell, bits: of a hit and a miss with equal
  /// probability.
  [[nodiscard]] static double entropyChange(const OccupancyModel& sensor);

 private:
  GainConfig config_;
  RobotModel robot_;
};

}  // namespace hoctomap
