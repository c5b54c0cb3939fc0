// SPDX-License-Identifier: BSD-3-Clause
#include "TableRelief.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hoctomap {
namespace {

// m, half the widths over which the surface is averaged, one after the other: wider than a thing first, so
// that a large one does not pass for the table, and as narrow as bends at last.
constexpr std::array kReaches{0.5, 0.5, 0.25, 0.25, 0.12, 0.12, 0.12, 0.12};
constexpr double kFewestCells = 6;  // of surface, for an average that is not one-sided
constexpr int kFewestPoints = 3;    // that tell a cell's height

/// Sums over rectangles of a grid.
class Sums {
 public:
  Sums(int columns, int rows) : columns_(columns), rows_(rows), sum_(index(columns, rows) + 1, 0.0) {}

  template <typename Value>
  void fill(const Value& value) {
    std::size_t cell = 0;
    for (int r = 0; r < rows_; ++r) {
      double row = 0.0;
      for (int c = 0; c < columns_; ++c) {
        row += value(cell++);
        sum_[index(c + 1, r + 1)] = sum_[index(c + 1, r)] + row;
      }
    }
  }
  /// Over the cells at most `reach` columns and rows away.
  [[nodiscard]] double around(int column, int row, int reach) const {
    const int c0 = std::max(0, column - reach);
    const int r0 = std::max(0, row - reach);
    const int c1 = std::min(columns_, column + reach + 1);
    const int r1 = std::min(rows_, row + reach + 1);
    return sum_[index(c1, r1)] - sum_[index(c0, r1)] - sum_[index(c1, r0)] + sum_[index(c0, r0)];
  }

 private:
  [[nodiscard]] std::size_t index(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_ + 1) + static_cast<std::size_t>(c);
  }
  int columns_;
  int rows_;
  std::vector<double> sum_;
};

}  // namespace

TableRelief::TableRelief(const TableSurface& table, std::span<const Candidate> near)
    : grid_(table.grid), level_(table.grid.size(), 0.0F) {
  struct Cell {
    double height = 0.0;
    double least_rise = 0.0;  ///< sum over the points
    int points = 0;
  };
  std::vector<Cell> cells(grid_.size());
  for (const auto& c : near) {
    auto& cell = cells[c.cell];
    cell.height += c.height;
    cell.least_rise += c.least_rise;
    ++cell.points;
  }
  for (auto& cell : cells) {
    if (cell.points < kFewestPoints) continue;
    cell.height /= cell.points;
    cell.least_rise /= cell.points;
  }
  Sums heights(grid_.columns(), grid_.rows());
  Sums weights(grid_.columns(), grid_.rows());
  for (const double reach : kReaches) {
    const auto isSurface = [&](std::size_t i) {
      return cells[i].points >= kFewestPoints &&
             std::abs(cells[i].height - static_cast<double>(level_[i])) < cells[i].least_rise;
    };
    heights.fill([&](std::size_t i) { return isSurface(i) ? cells[i].height : 0.0; });
    weights.fill([&](std::size_t i) { return isSurface(i) ? 1.0 : 0.0; });
    const int narrow = std::max(1, static_cast<int>(std::lround(reach / grid_.cellSize())));
    const int widest = static_cast<int>(std::lround(kReaches.front() / grid_.cellSize()));
    auto next = level_;
    std::size_t i = 0;
    for (int r = 0; r < grid_.rows(); ++r) {
      for (int c = 0; c < grid_.columns(); ++c, ++i) {
        for (int wide = narrow; wide <= std::max(narrow, widest); wide *= 2) {
          const double weight = weights.around(c, r, wide);
          if (weight < kFewestCells) continue;
          next[i] = static_cast<float>(heights.around(c, r, wide) / weight);
          break;
        }
      }
    }
    level_ = std::move(next);
  }
}

double TableRelief::at(double x, double y) const {
  const double half = grid_.cellSize() / 2.0;
  const auto first = grid_.cellOf(x - half, y - half);
  const auto columns = static_cast<std::size_t>(grid_.columns());
  if (first >= grid_.size() || first % columns + 1 >= columns || first + columns + 1 >= grid_.size()) {
    const auto cell = grid_.cellOf(x, y);
    return cell < grid_.size() ? static_cast<double>(level_[cell]) : 0.0;
  }
  const Eigen::Vector2d corner = grid_.center(first);
  const double s = (x - corner.x()) / grid_.cellSize();
  const double t = (y - corner.y()) / grid_.cellSize();
  const auto level = [&](std::size_t cell) { return static_cast<double>(level_[cell]); };
  return (1.0 - t) * ((1.0 - s) * level(first) + s * level(first + 1)) +
         t * ((1.0 - s) * level(first + columns) + s * level(first + columns + 1));
}

}  // namespace hoctomap
