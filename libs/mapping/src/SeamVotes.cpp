// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/SeamVotes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "CellKey.h"
#include "SeamEvidence.h"

namespace hoctomap {

namespace {

using Cell = SeamVotes::Cell;

/// The cells two steps away along some axis, one of each opposite two.
std::array<Cell, SeamVotes::kDirections> directions() {
  std::array<Cell, SeamVotes::kDirections> found;
  std::size_t n = 0;
  for (std::int32_t x = -2; x <= 2; ++x) {
    for (std::int32_t y = -2; y <= 2; ++y) {
      for (std::int32_t z = -2; z <= 2; ++z) {
        const bool is_two_away = std::max({std::abs(x), std::abs(y), std::abs(z)}) == 2;
        if (is_two_away && Cell{x, y, z} > Cell{}) found[n++] = {x, y, z};
      }
    }
  }
  return found;
}

const auto kDirection = directions();

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

SeamVotes::Cell SeamVotes::cellOf(const Eigen::Vector3f& world_point) {
  const Eigen::Array3i cell = (world_point / kCell).array().floor().cast<int>();
  return {cell.x(), cell.y(), cell.z()};
}

SeamVotes::Cells SeamVotes::cellsOf(std::span<const Eigen::Vector3f> world_points) {
  std::vector<Cell> cells;
  cells.reserve(world_points.size());
  for (const auto& p : world_points) {
    const Cell cell = cellOf(p);
    if (cells.empty() || cells.back() != cell) cells.push_back(cell);  // neighbours often share one
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return {cells.begin(), cells.end()};
}

SeamVotes::Cell SeamVotes::partner(const Cell& cell, std::size_t direction, int sign) {
  const Cell& d = kDirection[direction];
  return {cell.x + sign * d.x, cell.y + sign * d.y, cell.z + sign * d.z};
}

SeamVotes::Cells SeamVotes::add(std::span<const PointCloud* const> segments,
                                std::span<const PointCloud* const> ground, const Eigen::Vector3d& origin) {
  constexpr int kMost = 1000;
  const std::vector<SeenCell> cells = seenCells(segments, ground);
  std::vector<SurfacePiece> surface;
  std::unordered_map<std::uint64_t, std::size_t> index;
  for (const SeenCell& seen : cells) {
    index[cellKey(seen.cell)] = surface.size();
    surface.push_back(seen.surface(cornerOf(seen.cell), origin));
  }
  Cells shown;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool is_object = cells[i].owner != kGround;
    Votes& votes = votes_[cells[i].cell];
    if (is_object) {
      shown.insert(shown.end(), cells[i].cell);
      votes.is_object = true;
    }
    for (std::size_t d = 0; d < kDirections; ++d) {
      const auto found = index.find(cellKey(partner(cells[i].cell, d)));
      if (found == index.end()) continue;
      const std::size_t j = found->second;
      if (!is_object && cells[j].owner == kGround) continue;
      const int evidence = seamEvidence(passage(surface[i], surface[j]), cells[i].owner != cells[j].owner);
      votes.known.set(d);
      votes.evidence[d] = static_cast<std::int16_t>(std::clamp(votes.evidence[d] + evidence, -kMost, kMost));
    }
  }
  return shown;
}

void SeamVotes::forget(const Cells& cells) {
  for (const Cell& cell : cells) {
    votes_.erase(cell);
    for (std::size_t d = 0; d < kDirections; ++d) {
      const auto other = votes_.find(partner(cell, d, -1));
      if (other == votes_.end()) continue;
      other->second.known.reset(d);
      other->second.evidence[d] = 0;
    }
  }
}

void SeamVotes::assume(const Cells& cells) {
  constexpr std::int16_t kWhole = -6;  // three scans that join what is smooth
  forget(cells);
  for (const Cell& cell : cells) {
    Votes& votes = votes_[cell];
    votes.is_object = true;
    for (std::size_t d = 0; d < kDirections; ++d) {
      if (!cells.contains(partner(cell, d))) continue;
      votes.known.set(d);
      votes.evidence[d] = kWhole;
    }
  }
}

bool SeamVotes::meet(const Cells& a, const Cells& b) const {
  const auto reaches = [this](const Cells& from, const Cells& to) {
    return std::any_of(from.begin(), from.end(), [&](const Cell& cell) {
      const auto found = votes_.find(cell);
      if (found == votes_.end()) return false;
      for (std::size_t d = 0; d < kDirections; ++d) {
        if (found->second.known[d] && to.contains(partner(cell, d))) return true;
      }
      return false;
    });
  };
  return reaches(a, b) || reaches(b, a);
}

}  // namespace hoctomap
