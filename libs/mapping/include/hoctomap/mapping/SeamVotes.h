// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <bitset>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "hoctomap/geometry/PointCloud.h"

namespace hoctomap {

struct ScanSeams;

/// What all scans so far say of where one object ends and the next begins (docs/decisions/0028): for places
/// of the surface a short step apart, how much speaks for their being parts of two things. A single view may
/// join what touches, or part what is one; what all views say decides, in whatever order they come.
///
/// Places are cells of the world. Evidence is kept by pair of cells, two cells apart, so that a seam may be
/// off by one. What a scan says of a pair is whether S put the two into one segment, weighed by how the
/// surface goes from one to the other: only where a seam would show is it news that S found none, and only
/// where there is a crease or a step is it news that it cut.
class SeamVotes {
 public:
  static constexpr float kCell = 0.015F;          ///< m
  static constexpr std::size_t kDirections = 49;  ///< to the pairs of a cell, without the opposite ones

  struct Cell {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t z = 0;
    auto operator<=>(const Cell&) const = default;
  };
  using Cells = std::set<Cell>;

  [[nodiscard]] static Cell cellOf(const Eigen::Vector3f& world_point);
  [[nodiscard]] static Cells cellsOf(std::span<const Eigen::Vector3f> world_points);
  /// The other cell of pair number `direction`.
  [[nodiscard]] static Cell partner(const Cell& cell, std::size_t direction, int sign = 1);

  /// Takes the votes of one scan.
  /// @returns the cells of clusters that it shows
  Cells add(const ScanSeams& scan);
  /// Forgets what is known of these cells: their object has gone.
  void forget(const Cells& cells);
  /// What has moved as one is one: the cells are where an object stands now.
  void assume(const Cells& cells);

  /// Whether some scan has shown cells of both that make a pair.
  [[nodiscard]] bool meet(const Cells& a, const Cells& b) const;

  /// Of one cell: what speaks for a seam between it and the cell in each direction; negative: for none.
  struct Votes {
    bool is_object = false;          ///< some scan has shown an object here
    std::bitset<kDirections> known;  ///< some scan has shown both
    std::array<std::int16_t, kDirections> evidence{};
    bool operator==(const Votes&) const = default;
  };

  using Entry = std::pair<const Cell, Votes>;
  /// The cells of objects that may hang together with those of `seeds`, in order: what is farther away costs
  /// nothing. Some that do not are among them.
  [[nodiscard]] std::vector<const Entry*> objectsAround(const Cells& seeds) const;

  bool operator==(const SeamVotes&) const = default;

  /// All votes, by cell; for writing and reading them.
  [[nodiscard]] const std::map<Cell, Votes>& all() const { return votes_; }
  void set(const Cell& cell, const Votes& votes) { votes_[cell] = votes; }

 private:
  std::map<Cell, Votes> votes_;
};

}  // namespace hoctomap
