// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
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
  };

  [[nodiscard]] const Grid& fine() const { return fine_; }      ///< `Knowledge` of the space over the table
  [[nodiscard]] const Grid& coarse() const { return coarse_; }  ///< 1: something stands there
  /// Of the fine cells in the boxes of objects, m: the resolution that counts them (see
  /// ExpectedInformationGain).
  [[nodiscard]] double boxResolution() const { return box_resolution_; }
  [[nodiscard]] std::size_t count(Knowledge knowledge) const;
  /// Shannon entropy of the fine cells, bits; unknown: 1.
  [[nodiscard]] double entropy() const { return entropy_; }

 private:
  void takeCleared(const ClearedSpace& cleared);
  void takeNode(const MapHierarchy& map, NodeId id, const TableArea& table);
  void takeSurroundings(const MapHierarchy& map, const TableArea& table, double range);

  Grid fine_;
  Grid coarse_;
  double box_resolution_ = 0.0;
  double entropy_ = 0.0;
  std::vector<float> bits_;  ///< entropy by fine cell
};

}  // namespace hoctomap
