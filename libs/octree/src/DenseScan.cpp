// SPDX-License-Identifier: BSD-3-Clause
#include "DenseScan.h"

#include <cmath>
#include <vector>

namespace hoctomap::engine {

bool hasDirection(const Eigen::Vector3f& way) {
  constexpr float kFar = 1e30F;  // metres, beyond any key; not infinite
  const float length = std::fabs(way[0]) + std::fabs(way[1]) + std::fabs(way[2]);
  return length > 0.0F && length < kFar;
}

bool isDense(const ScanBeams& scan, std::span<const Eigen::Vector3f> points) {
  // Measured: where the beams are fewer or shorter, looking up costs more than it saves.
  constexpr std::size_t kManyBeams = 4096;
  constexpr std::size_t kStride = 16;
  constexpr double kBeamsADirection = 2.5;  // in the sample, a grid cell of 2^-6: 40 in the scan
  constexpr double kCellsABeam = 80.0;
  if (points.size() < kManyBeams) return false;
  constexpr unsigned kShift = 4;
  std::vector<bool> met(std::size_t{6} << (2 * kDirectionBits - kShift));
  double beams = 0.0;
  double directions = 0.0;
  double cells = 0.0;
  for (std::size_t i = 0; i < points.size(); i += kStride) {
    const Eigen::Vector3f way = scan.end(points[i]) - scan.origin();
    if (!hasDirection(way)) continue;
    auto&& here = met[directionOf(way) >> kShift];
    directions += here ? 0.0 : 1.0;
    here = true;
    beams += 1.0;
    cells += static_cast<double>(way.lpNorm<1>()) * scan.grid().cellsPerMetre();
  }
  return beams > kBeamsADirection * directions && cells > kCellsABeam * beams;
}

}  // namespace hoctomap::engine
