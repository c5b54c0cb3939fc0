// SPDX-License-Identifier: BSD-3-Clause
#include "BeamDensity.h"

#include <bit>
#include <cmath>

namespace hoctomap::engine {

namespace {

constexpr int kMaxCells = 64;  // an axis
constexpr int kMinEdge = 8;    // voxels
constexpr double kStep = 0.5;  // of a cell's edge
constexpr double kCrossings =
    1.5;  // voxels that a beam of mean direction visits on one voxel edge of its length

/// Bytes of the nodes in a cube of 2^(3 levels) voxels with so many visits each: beams of one sensor are
/// nearly parallel within a node, so a node 2^l voxels wide shows 4^l columns to them.
double nodeBytes(double visits_a_voxel, unsigned levels) {
  constexpr double kNode = sizeof(octomap::OcTreeNode);
  constexpr double kChildren = 8 * sizeof(void*);
  // Beams of an image are spread more evenly than by chance: the square says by how much (calibrated).
  const double hit = -std::expm1(-visits_a_voxel - 0.5 * visits_a_voxel * visits_a_voxel);
  const auto full = [&](unsigned level) { return std::pow(hit, 1.5 * std::exp2(2.0 * level)); };
  double bytes = 0.0;
  for (unsigned level = 0; level < levels; ++level) {
    const double nodes = std::exp2(3.0 * (levels - level));
    const double met = -std::expm1(-visits_a_voxel * std::exp2(2.0 * level));
    bytes += nodes * kNode * std::max(0.0, met - full(level + 1));  // a full parent is one leaf
    if (level > 0) bytes += nodes * kChildren * std::max(0.0, met - full(level));
  }
  return bytes;
}

}  // namespace

BeamDensity::BeamDensity(const ScanBeams& scan, const KeyBox& box, Points hits, Points passing,
                         double max_samples)
    : box_(box), edge_(kMinEdge), stride_(1), hits_(hits.size()) {
  int extent = 1;
  for (std::size_t i = 0; i < 3; ++i) extent = std::max(extent, box.max[i] - box.min[i] + 1);
  while (extent > edge_ * kMaxCells) edge_ *= 2;
  levels_ = static_cast<unsigned>(std::countr_zero(static_cast<unsigned>(edge_)));
  for (std::size_t i = 0; i < 3; ++i) size_[i] = (box.max[i] - box.min[i]) / edge_ + 1;
  samples_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                  static_cast<std::size_t>(size_[2]));
  const double samples = static_cast<double>(hits.size() + passing.size()) * extent / (kStep * edge_);
  stride_ = static_cast<std::size_t>(samples / max_samples) + 1;
  for (const Points points : {hits, passing}) {
    for (std::size_t i = 0; i < points.size(); i += stride_) add(scan, points[i]);
  }
}

void BeamDensity::add(const ScanBeams& scan, const Eigen::Vector3f& point) {
  const Eigen::Vector3f end = scan.isTooLong(point) ? scan.cut(point) : point;
  const double cells_per_metre = scan.grid().cellsPerMetre();
  std::array<double, 3> start{};
  std::array<double, 3> way{};
  double first = 0.0;
  double last = 1.0;
  double length = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const auto cell = [&](float x) {
      return (static_cast<double>(x) * cells_per_metre + kKeyOffset - box_.min[i]) / edge_;
    };
    start[i] = cell(scan.origin()[axis]);
    way[i] = cell(end[axis]) - start[i];
    length += way[i] * way[i];
    const double a = -start[i] / way[i];
    const double b = (size_[i] - start[i]) / way[i];
    if (way[i] == 0.0 && (start[i] < 0.0 || start[i] >= size_[i])) return;
    if (way[i] == 0.0) continue;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  const double step = kStep / std::sqrt(length);
  if (!(step > 0.0) || !(first < last)) return;
  for (double t = first + 0.5 * std::min(step, last - first); t < last; t += step) {
    std::size_t cell = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int at = std::clamp(static_cast<int>(start[i] + t * way[i]), 0, size_[i] - 1);
      cell = cell * static_cast<std::size_t>(size_[i]) + static_cast<std::size_t>(at);
    }
    ++samples_[cell];
  }
}

double BeamDensity::visits(std::uint32_t samples) const {
  return static_cast<double>(samples) * static_cast<double>(stride_) * kStep * edge_ * kCrossings;
}

double BeamDensity::pages() const {
  constexpr double kPageEdge = 1U << (kPageCodeBits / 3);
  const double pages_a_cell = std::pow(edge_ / kPageEdge, 3.0);
  double pages = 0.0;
  for (const std::uint32_t s : samples_) {
    if (s == 0) continue;
    // Small cells: a page counts by its parts. Large ones: the beams may leave pages out.
    const double met = visits(s) / (kPageEdge * pages_a_cell);
    pages += pages_a_cell <= 1.0 ? pages_a_cell : -pages_a_cell * std::expm1(-met);
  }
  return pages;
}

double BeamDensity::treeBytes() const {
  // Every occupied voxel keeps the nodes around it apart: with seven siblings at each level, shared by its
  // neighbours on the surface.
  constexpr double kBytesAHit = 100.0;
  const double voxels = std::pow(edge_, 3.0);
  double bytes = 0.0;
  double surface = 0.0;
  for (const std::uint32_t s : samples_) {
    if (s == 0) continue;
    bytes += nodeBytes(visits(s) / voxels, levels_);
    surface += 1.0;
  }
  const double surface_voxels = surface * edge_ * edge_;
  return 1.1 * bytes + kBytesAHit * std::min(static_cast<double>(hits_), surface_voxels);
}

}  // namespace hoctomap::engine
