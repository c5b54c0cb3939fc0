// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/tabletop/PlaneSearch.h"

namespace hoctomap {

class ScanBlocks;

/// A set of cells of a grid.
using CellMask = std::vector<std::uint8_t>;

/// What one scan says of a horizontal plane, cell by cell (seen from above, world x and y). Every beam
/// crosses the plane in one cell: there it ends (surface), or it ended before (hidden), or it passes on
/// (open).
class SurfaceGrid {
 public:
  enum class Cell : std::uint8_t { unseen, open, hidden, surface };

  /// @param region part of the plane to look at; enlarged to whole cells.
  SurfaceGrid(const ScanBlocks& scan, const Plane& plane, const Eigen::AlignedBox2d& region,
              const TabletopSegmentationConfig& config);

  [[nodiscard]] double cellSize() const { return cell_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] Cell at(std::size_t cell) const { return cells_[cell]; }

  /// Cell below or above a point, `size()` if it is outside.
  [[nodiscard]] std::size_t cellOf(double x, double y) const {
    const double dx = x - corner_.x();
    const double dy = y - corner_.y();
    // Far outside, as most points of a scan are: spares the divisions.
    if (!(dx >= 0.0 && dy >= 0.0 && dx <= reach_.x() && dy <= reach_.y())) return size();
    const double column = dx / cell_;
    const double row = dy / cell_;
    if (!(column < columns_ && row < rows_)) return size();
    return static_cast<std::size_t>(static_cast<int>(row)) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(static_cast<int>(column));
  }
  [[nodiscard]] Eigen::Vector2d center(std::size_t cell) const;
  /// Holds all cells, a little larger.
  [[nodiscard]] Eigen::AlignedBox2d bounds() const { return {corner_, corner_ + reach_}; }

  /// Patches of surface of at least `least_cells` cells, largest first. Two cells are of one patch if a gap
  /// of at most `gap` metres parts them, or one of at most `hidden_gap` metres that is hidden from the
  /// sensor.
  [[nodiscard]] std::vector<CellMask> patches(double gap, double hidden_gap, std::size_t least_cells) const;

  /// Where the surface of a patch may be as far as the scan can tell: the patch, its holes, and the hidden
  /// and unseen cells within its convex hull. What is open to view is left out, so that neither the notch of
  /// an L nor the room beyond a table's edge is part of it.
  [[nodiscard]] CellMask extent(const CellMask& patch) const;

  /// The cells whose centres lie within the convex hull of a mask's, and the mask itself.
  [[nodiscard]] CellMask hull(const CellMask& mask) const;

  /// The mask grown by `distance` metres (in steps of a cell, to 8 neighbours).
  [[nodiscard]] CellMask dilated(const CellMask& mask, double distance) const;

 private:
  template <typename Visit>
  void forNeighbours(std::size_t cell, const Visit& visit) const;
  double cell_;
  Eigen::Vector2d corner_;
  int columns_ = 0;
  int rows_ = 0;
  Eigen::Vector2d reach_;  ///< m, from the corner: no less than the extent of the cells
  std::vector<Cell> cells_;
};

/// Number of cells in a mask.
[[nodiscard]] std::size_t count(const CellMask& mask);

}  // namespace hoctomap
