// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/SurfaceGrid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ScanBlocks.h"

namespace hoctomap {
namespace {

/// What the beams that end or cross in one cell say; counted up to 65535.
struct Votes {
  std::uint16_t on = 0;       ///< points of the surface
  std::uint16_t beside = 0;   ///< points just above or below the surface, over or under this cell
  std::uint16_t passing = 0;  ///< beams that cross the plane here and end farther on
  std::uint16_t stopped = 0;  ///< beams that would cross here and end before
};

void vote(std::uint16_t& counter) {
  counter = static_cast<std::uint16_t>(counter + (counter != 0xFFFF));
}

/// Convex hull by monotone chain, counterclockwise.
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Eigen::Vector2d> hull;
  const auto chain = [&hull](auto first, auto last) {
    const std::size_t base = hull.size();
    for (auto it = first; it != last; ++it) {
      while (hull.size() >= base + 2) {
        const Eigen::Vector2d a = hull[hull.size() - 1] - hull[hull.size() - 2];
        const Eigen::Vector2d b = *it - hull[hull.size() - 1];
        if (a.x() * b.y() - a.y() * b.x() > 0.0) break;
        hull.pop_back();
      }
      hull.push_back(*it);
    }
    hull.pop_back();  // the next chain begins there
  };
  if (points.size() < 3) return points;
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

bool inside(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& p) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    const Eigen::Vector2d to = p - hull[i];
    if (edge.x() * to.y() - edge.y() * to.x() < -1e-12) return false;
  }
  return true;
}

}  // namespace

SurfaceGrid::SurfaceGrid(const ScanBlocks& scan, const Plane& plane, const Eigen::AlignedBox2d& region,
                         const TabletopSegmentationConfig& config)
    : cell_(config.outline_cell),
      corner_((region.min() / cell_).array().floor() * cell_),
      columns_(static_cast<int>(std::ceil((region.max().x() - corner_.x()) / cell_)) + 1),
      rows_(static_cast<int>(std::ceil((region.max().y() - corner_.y()) / cell_)) + 1),
      reach_(cell_ * Eigen::Vector2d(columns_ + 1, rows_ + 1)) {
  constexpr double kBeside = 0.05;  // m above and below the surface where a wall or a chair would show
  std::vector<Votes> votes(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  cells_.assign(votes.size(), Cell::unseen);
  const Eigen::Vector3d origin = scan.z().origin();
  const double sensor_height = plane.signedDistance(origin);
  const auto mayMatter = [&, region = bounds()](const Eigen::AlignedBox3d& box) {
    return region.intersects(inPlan(box)) || region.intersects(crossings(plane, origin, box));
  };
  scan.visit(mayMatter, [&](std::uint32_t i) {
    const Eigen::Vector3d p = scan.z().world_points[i].cast<double>();
    const double height = plane.signedDistance(p);
    if (std::abs(height) <= config.largestTolerance((p - origin).squaredNorm()) + kBeside) {
      const double tolerance = config.surfaceTolerance((p - origin).norm(), sensor_height - height);
      if (std::abs(height) <= tolerance) {
        if (const auto cell = cellOf(p.x(), p.y()); cell < size()) vote(votes[cell].on);
        return;
      }
      if (std::abs(height) < tolerance + kBeside) {
        if (const auto cell = cellOf(p.x(), p.y()); cell < size()) vote(votes[cell].beside);
      }
    }
    if (height >= sensor_height) return;  // rises: never crosses
    const Eigen::Vector3d crossing = origin + (p - origin) * (sensor_height / (sensor_height - height));
    const auto cell = cellOf(crossing.x(), crossing.y());
    if (cell < size()) vote(height < 0.0 ? votes[cell].passing : votes[cell].stopped);
  });
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Votes& v = votes[i];
    // What goes on above or below is the slice of a wall or of a chair's back, or the foot of an object.
    if (v.on > v.beside && v.on >= v.passing)
      cells_[i] = Cell::surface;
    else if (v.passing > v.stopped)
      cells_[i] = Cell::open;
    else if (v.stopped > 0)
      cells_[i] = Cell::hidden;
  }
}

Eigen::Vector2d SurfaceGrid::center(std::size_t cell) const {
  const auto columns = static_cast<std::size_t>(columns_);
  return corner_ + cell_ * Eigen::Vector2d(static_cast<double>(cell % columns) + 0.5,
                                           static_cast<double>(cell / columns) + 0.5);
}

template <typename Visit>
void SurfaceGrid::forNeighbours(std::size_t cell, const Visit& visit) const {
  const int column = static_cast<int>(cell % static_cast<std::size_t>(columns_));
  const int row = static_cast<int>(cell / static_cast<std::size_t>(columns_));
  for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(columns_ - 1, column + 1); ++c) {
      if (r != row || c != column) {
        visit(static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c));
      }
    }
  }
}

std::vector<CellMask> SurfaceGrid::patches(double gap, double hidden_gap, std::size_t least_cells) const {
  // Grow the surface by half a gap, farther through hidden cells, and take what then touches as one.
  const int steps = static_cast<int>(gap / 2.0 / cell_ + 1e-9);
  const int hidden_steps = static_cast<int>(hidden_gap / 2.0 / cell_ + 1e-9);
  CellMask grown(size(), 0);
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < size(); ++i) {
    if (cells_[i] != Cell::surface) continue;
    grown[i] = 1;
    front.push_back(i);
  }
  for (int step = 1; step <= std::max(steps, hidden_steps); ++step) {
    std::vector<std::size_t> next;
    for (const auto cell : front) {
      forNeighbours(cell, [&](std::size_t n) {
        if (grown[n] || (step > steps && cells_[n] != Cell::hidden)) return;
        grown[n] = 1;
        next.push_back(n);
      });
    }
    front = std::move(next);
  }
  std::vector<CellMask> found;
  std::vector<std::size_t> sizes;
  for (std::size_t seed = 0; seed < size(); ++seed) {
    if (!grown[seed]) continue;
    CellMask patch(size(), 0);
    std::size_t cells = 0;
    std::vector<std::size_t> stack{seed};
    grown[seed] = 0;
    while (!stack.empty()) {
      const auto cell = stack.back();
      stack.pop_back();
      if (cells_[cell] == Cell::surface) {
        patch[cell] = 1;
        ++cells;
      }
      forNeighbours(cell, [&](std::size_t n) {
        if (!grown[n]) return;
        grown[n] = 0;
        stack.push_back(n);
      });
    }
    if (cells < least_cells) continue;
    const auto at = std::upper_bound(sizes.begin(), sizes.end(), cells, std::greater<>()) - sizes.begin();
    sizes.insert(sizes.begin() + at, cells);
    found.insert(found.begin() + at, std::move(patch));
  }
  return found;
}

CellMask SurfaceGrid::hull(const CellMask& mask) const {
  struct Row {
    int first = 0;
    int last = -1;
  };
  // The ends of each row are enough.
  std::vector<Eigen::Vector2d> ends;
  std::vector<Row> held(static_cast<std::size_t>(rows_));
  const auto cell = [&](int row, int column) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  };
  for (int row = 0; row < rows_; ++row) {
    auto& [first, last] = held[static_cast<std::size_t>(row)];
    while (first < columns_ && !mask[cell(row, first)]) ++first;
    if (first == columns_) continue;
    last = columns_ - 1;
    while (!mask[cell(row, last)]) --last;
    ends.push_back(center(cell(row, first)));
    ends.push_back(center(cell(row, last)));
  }
  const auto polygon = convexHull(std::move(ends));
  CellMask result = mask;
  for (int row = 0; row < rows_; ++row) {
    const auto isInside = [&](int column) { return inside(polygon, center(cell(row, column))); };
    auto [first, last] = held[static_cast<std::size_t>(row)];
    if (first == columns_) {  // between rows that hold something, or beyond them
      for (first = 0; first < columns_ && !isInside(first);) ++first;
      last = first - 1;
    }
    while (first > 0 && isInside(first - 1)) --first;
    while (last + 1 < columns_ && isInside(last + 1)) ++last;
    for (int column = first; column <= last; ++column) result[cell(row, column)] = 1;
  }
  return result;
}

CellMask SurfaceGrid::extent(const CellMask& patch) const {
  CellMask result = hull(patch);
  for (std::size_t i = 0; i < size(); ++i) {
    result[i] = patch[i] || (result[i] && (cells_[i] == Cell::hidden || cells_[i] == Cell::unseen));
  }
  // Holes: what cannot be reached from the border of the grid.
  CellMask outside(size(), 0);
  std::vector<std::size_t> stack;
  const auto enter = [&](std::size_t cell) {
    if (outside[cell] || result[cell]) return;
    outside[cell] = 1;
    stack.push_back(cell);
  };
  const auto columns = static_cast<std::size_t>(columns_);
  for (std::size_t c = 0; c < columns; ++c) enter(c), enter(size() - 1 - c);
  for (std::size_t i = 0; i < size(); i += columns) enter(i), enter(i + columns - 1);
  while (!stack.empty()) {
    const auto cell = stack.back();
    stack.pop_back();
    forNeighbours(cell, enter);
  }
  for (std::size_t i = 0; i < size(); ++i) result[i] = outside[i] ? 0 : 1;
  return result;
}

CellMask SurfaceGrid::dilated(const CellMask& mask, double distance) const {
  CellMask result = mask;
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < size(); ++i) {
    if (mask[i]) front.push_back(i);
  }
  for (int step = 0; step < static_cast<int>(std::lround(distance / cell_)); ++step) {
    std::vector<std::size_t> next;
    for (const auto cell : front) {
      forNeighbours(cell, [&](std::size_t n) {
        if (result[n]) return;
        result[n] = 1;
        next.push_back(n);
      });
    }
    front = std::move(next);
  }
  return result;
}

std::size_t count(const CellMask& mask) {
  return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 1));
}

}  // namespace hoctomap
