// SPDX-License-Identifier: BSD-3-Clause
#include "BeamOrder.h"

#include <cmath>
#include <utility>

namespace hoctomap::engine {

namespace {

constexpr unsigned kDigitBits = (kDirectionCodeBits + 1) / 2;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

struct Aim {
  Direction direction;
  std::uint32_t point;
};

/// Where the elements with each digit go, from their numbers.
using Places = std::array<std::uint32_t, kDigits>;
void addUp(Places& places) {
  std::uint32_t sum = 0;
  for (std::uint32_t& place : places) sum += std::exchange(place, sum);
}

/// Not for beams that end at the origin, or nowhere: they mark nothing.
bool hasDirection(const Eigen::Vector3f& way) {
  constexpr float kFar = 1e30F;  // metres, beyond any key; not infinite
  const float length = std::fabs(way[0]) + std::fabs(way[1]) + std::fabs(way[2]);
  return length > 0.0F && length < kFar;
}

}  // namespace

bool isDense(const ScanBeams& scan, std::span<const Eigen::Vector3f> points) {
  // Measured: where the beams are fewer or shorter, ordering them costs more than it saves.
  constexpr std::size_t kManyBeams = 4096;
  constexpr std::size_t kStride = 16;
  constexpr double kBeamsADirection = 2.5;  // in the sample, a grid cell of 2^-6: 40 in the scan
  constexpr double kCellsABeam = 200.0;
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

std::vector<AimedBeam> orderByDirection(const ScanBeams& scan, std::span<const Eigen::Vector3f> points) {
  // Radix sort: by the lower half of the code, then, stably, by the upper one.
  std::vector<Aim> aims;
  aims.reserve(points.size());
  Places low{};
  Places high{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f way = points[i] - scan.origin();
    if (!hasDirection(way)) continue;
    aims.push_back({directionOf(way), static_cast<std::uint32_t>(i)});
    ++low[aims.back().direction % kDigits];
    ++high[aims.back().direction / kDigits];
  }
  addUp(low);
  addUp(high);
  std::vector<Aim> half_sorted(aims.size());
  for (const Aim& aim : aims) half_sorted[low[aim.direction % kDigits]++] = aim;
  std::vector<AimedBeam> beams(aims.size());
  for (const Aim& aim : half_sorted) {
    beams[high[aim.direction / kDigits]++] = {scan.end(points[aim.point]), aim.direction};
  }
  return beams;
}

}  // namespace hoctomap::engine
