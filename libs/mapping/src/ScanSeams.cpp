// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/ScanSeams.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "CellKey.h"
#include "SeamEvidence.h"

namespace hoctomap {

namespace {

using Cell = SeamVotes::Cell;

/// The points of a scan in one cell.
struct SeenCell {
  Cell cell;
  std::size_t owner = 0;  ///< segment that has most of the points
  std::uint32_t most = 0;
  std::size_t segment = 0;  ///< that is being counted
  std::uint32_t in_segment = 0;
  std::uint32_t points = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< relative to the cell's corner
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(std::size_t s, const Eigen::Vector3d& p) {
    if (s != segment) {
      segment = s;
      in_segment = 0;
    }
    if (++in_segment > most) {
      most = in_segment;
      owner = s;
    }
    ++points;
    sum += p;
    squares.noalias() += p * p.transpose();
  }

  [[nodiscard]] SurfacePiece surface(const Eigen::Vector3d& corner, const Eigen::Vector3d& origin) const {
    constexpr std::uint32_t kLeastPoints = 6;
    constexpr double kLeastSpread = 0.002;  // m, standard deviation along the second axis
    SurfacePiece piece;
    if (points < kLeastPoints) return piece;
    const Eigen::Vector3d mean = sum / points;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    axes.computeDirect(squares / points - mean * mean.transpose());
    if (axes.eigenvalues()[1] < kLeastSpread * kLeastSpread) return piece;
    piece.center = corner + mean;
    piece.normal = axes.eigenvectors().col(0);
    if (piece.normal.dot(origin - piece.center) < 0.0) piece.normal = -piece.normal;
    return piece;
  }
};

Eigen::Vector3d cornerOf(const Cell& cell) {
  return Eigen::Vector3d(cell.x, cell.y, cell.z) * static_cast<double>(SeamVotes::kCell);
}

constexpr std::size_t kGround = std::numeric_limits<std::size_t>::max();  // owner of what is no segment's

/// Of ground that lies near a segment: its cells in which no segment has a point.
void addGround(std::span<const PointCloud* const> ground,
               std::unordered_map<std::uint64_t, SeenCell>& by_key) {
  std::unordered_set<std::uint64_t> near;  // cells of pairs with a segment's
  Eigen::AlignedBox3f around;              // of these, m
  for (const auto& [key, seen] : by_key) {
    for (std::size_t d = 0; d < SeamVotes::kDirections; ++d) {
      for (const int sign : {1, -1}) near.insert(cellKey(SeamVotes::partner(seen.cell, d, sign)));
    }
    around.extend(cornerOf(seen.cell).cast<float>());
  }
  const Eigen::Array3f margin = Eigen::Array3f::Constant(3.0F * SeamVotes::kCell);
  around = {around.min().array() - margin, around.max().array() + margin};
  std::uint64_t last_key = 0;
  SeenCell* last = nullptr;
  for (const PointCloud* points : ground) {
    for (const auto& p : *points) {
      if (!around.contains(p)) continue;
      const Cell cell = SeamVotes::cellOf(p);
      const std::uint64_t key = cellKey(cell);
      if (last == nullptr || key != last_key) {  // points come in rows
        last_key = key;
        last = nullptr;
        if (!near.contains(key)) continue;
        SeenCell& seen = by_key[key];
        if (seen.points > 0 && seen.owner != kGround) continue;
        seen.cell = cell;
        last = &seen;
      }
      last->add(kGround, p.cast<double>() - cornerOf(cell));
    }
  }
}

/// Cells with enough points to belong to a segment or the ground, in order.
std::vector<SeenCell> seenCells(std::span<const PointCloud* const> segments,
                                std::span<const PointCloud* const> ground) {
  constexpr std::uint32_t kLeastPoints = 3;  // fewer may be strays
  std::unordered_map<std::uint64_t, SeenCell> by_key;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    for (const auto& p : *segments[s]) {
      const Cell cell = SeamVotes::cellOf(p);
      SeenCell& seen = by_key[cellKey(cell)];
      seen.cell = cell;
      seen.add(s, p.cast<double>() - cornerOf(cell));
    }
  }
  addGround(ground, by_key);
  std::vector<SeenCell> cells;
  for (const auto& [key, seen] : by_key) {
    if (seen.most >= kLeastPoints) cells.push_back(seen);
  }
  std::sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
  return cells;
}

}  // namespace

ScanSeams scanSeams(std::span<const PointCloud* const> segments, std::span<const PointCloud* const> ground,
                    const Eigen::Vector3d& origin) {
  const std::vector<SeenCell> seen = seenCells(segments, ground);
  ScanSeams found;
  std::vector<SurfacePiece> surface;
  for (const SeenCell& s : seen) {
    found.cells.push_back(s.cell);
    found.is_object.push_back(s.owner != kGround);
    surface.push_back(s.surface(cornerOf(s.cell), origin));
  }
  for (std::size_t d = 0; d < SeamVotes::kDirections; ++d) {
    forCellPairs(found.cells, SeamVotes::partner({}, d), [&](std::uint32_t i, std::uint32_t j) {
      if (seen[i].owner == kGround && seen[j].owner == kGround) return;
      const int evidence = seamEvidence(passage(surface[i], surface[j]), seen[i].owner != seen[j].owner);
      found.pairs.push_back({i, static_cast<std::uint8_t>(d), static_cast<std::int16_t>(evidence)});
    });
  }
  return found;
}

}  // namespace hoctomap
