// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <unordered_map>

#include "hoctomap/geometry/PointCloud.h"

namespace hoctomap {

/// What all scans so far say of where one object ends and the next begins (docs/decisions/0023): for places
/// of the surface a short step apart, how many scans put them into one segment, and how many into two. A
/// single view may join what touches, or part what is one; what most views say decides, in whatever order
/// they come.
///
/// Places are cells of the world. Votes for cutting are counted by pair of cells, scans that show a cell by
/// cell: a pair that two cells make has been joined by the scans that showed both and did not cut between
/// them.
class SeamVotes {
 public:
  static constexpr float kCell =
      0.015F;  ///< m; the pairs are two cells apart, so that seams may be off by one

  struct Cell {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t z = 0;
    auto operator<=>(const Cell&) const = default;
  };
  using Cells = std::set<Cell>;

  /// What the scans say of the seam between two sets of cells; both 0 if these do not meet.
  struct Verdict {
    double joined = 0.0;  ///< pairs times scans
    double apart = 0.0;
    double pairs = 0.0;
  };

  [[nodiscard]] static Cell cellOf(const Eigen::Vector3f& world_point);
  [[nodiscard]] static Cells cellsOf(std::span<const Eigen::Vector3f> world_points);

  /// Takes the votes of one scan. @param segments  its clusters, world points
  void add(std::span<const PointCloud* const> segments);
  /// Forgets what is known of these cells: their object has gone.
  void forget(const Cells& cells);
  /// What has moved as one is one: the cells are where an object stands now, `scans` of which showed it
  /// whole.
  void assume(const Cells& cells, std::uint16_t scans);

  [[nodiscard]] Verdict between(const Cells& a, const Cells& b) const;

  bool operator==(const SeamVotes&) const = default;

  /// Of one cell: scans that show it, and of these the ones that cut between it and the cell in direction d.
  struct Votes {
    std::uint16_t shown = 0;
    std::array<std::uint16_t, 13> cut{};
    bool operator==(const Votes&) const = default;
  };
  /// All votes, by cell; for writing and reading them.
  [[nodiscard]] const std::map<Cell, Votes>& all() const { return votes_; }
  void set(const Cell& cell, const Votes& votes) { votes_[cell] = votes; }

 private:
  std::map<Cell, Votes> votes_;
};

}  // namespace hoctomap
