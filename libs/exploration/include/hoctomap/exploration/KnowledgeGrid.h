// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "hoctomap/exploration/ClearedSpace.h"

namespace hoctomap {

/// What the hierarchy knows of a cell.
enum class Knowledge : std::uint8_t {
  free,
  occupied,
  unknown_in_box,  ///< in the box of an object, or between it and the table
  unknown          ///< elsewhere over the table
};

/// The space over a table, taken down from the octrees in their own frames to one dense grid that beams can
/// go through fast, with a coarse grid of all that stands around it. Taken once a step.
class KnowledgeGrid {
 public:
  /// @param cell m, of the dense grid: of the finest unknown that counts. @param range m: how far around the
  /// table the coarse grid reaches.
  KnowledgeGrid(const MapHierarchy& map, const TableArea& table, const ClearedSpace& cleared, double cell,
                double range);

  /// A regular grid of bytes in the world.
  struct Grid {
    Eigen::Vector3d corner = Eigen::Vector3d::Zero();
    double cell = 0.0;
    std::array<int, 3> size{};
    std::vector<std::uint8_t> cells;  ///< x fastest

    [[nodiscard]] std::size_t index(int x, int y, int z) const {
      return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y)) *
                 static_cast<std::size_t>(size[0]) +
             static_cast<std::size_t>(x);
    }
    [[nodiscard]] Eigen::AlignedBox3d box() const;
    /// The grid of such cells that covers a box, all zero.
    static Grid around(const Eigen::AlignedBox3d& world, double cell);
    [[nodiscard]] Eigen::Vector3d center(int x, int y, int z) const {
      return corner + cell * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
    }
    /// Cells whose centres lie in a box: calls `visit(x, y, z)`.
    template <class Visit>
    void forEachIn(const Eigen::AlignedBox3d& world, Visit&& visit) const {
      std::array<int, 3> first{};
      std::array<int, 3> last{};
      for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        first[axis] = std::max(0, static_cast<int>(std::ceil((world.min()[i] - corner[i]) / cell - 0.5)));
        last[axis] =
            std::min(size[axis] - 1, static_cast<int>(std::floor((world.max()[i] - corner[i]) / cell - 0.5)));
      }
      for (int z = first[2]; z <= last[2]; ++z) {
        for (int y = first[1]; y <= last[1]; ++y) {
          for (int x = first[0]; x <= last[0]; ++x) visit(x, y, z);
        }
      }
    }
  };

  [[nodiscard]] const Grid& fine() const { return fine_; }      ///< `Knowledge` of the space over the table
  [[nodiscard]] const Grid& coarse() const { return coarse_; }  ///< 1: something stands there
  /// The edge of the voxels, m, that a kind of unknown space is counted in (see ExpectedInformationGain): of
  /// the finest object in boxes, of the cleared space elsewhere.
  [[nodiscard]] double resolutionOf(Knowledge unknown) const {
    return unknown == Knowledge::unknown_in_box ? box_resolution_ : open_resolution_;
  }
  [[nodiscard]] std::size_t count(Knowledge knowledge) const;
  /// Shannon entropy of the fine cells, bits; unknown: 1.
  [[nodiscard]] double entropy() const { return entropy_; }

 private:
  void takeCleared(const ClearedSpace& cleared, std::vector<float>& bits);
  void takeNode(const MapHierarchy& map, NodeId id, const TableArea& table, std::vector<float>& bits);
  void takeSurroundings(const MapHierarchy& map, const TableArea& table, double range);

  Grid fine_;
  Grid coarse_;
  double box_resolution_ = 0.0;
  double open_resolution_ = 0.0;
  double entropy_ = 0.0;
};

}  // namespace hoctomap
