// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/SurfaceNormals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hoctomap {

namespace {

constexpr double kLeastPoints = 6.0;
constexpr double kLine = 1e-3;  // of the largest variance: less in two directions is a line

/// Cells are told apart by one number, whose order is that of x, then y, then z.
using CellKey = std::int64_t;
constexpr std::array<CellKey, 3> kStride{CellKey{1} << 42, CellKey{1} << 21, 1};

/// Sums over points, from the first point of the cloud.
struct Moments {
  double count = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();  // lower triangle

  void add(const Eigen::Vector3d& p) {
    count += 1.0;
    sum += p;
    products.triangularView<Eigen::Lower>() += p * p.transpose();
  }
  void add(const Moments& other) {
    count += other.count;
    sum += other.sum;
    products += other.products;
  }

  [[nodiscard]] Eigen::Vector3f normal() const {
    if (count < kLeastPoints) return Eigen::Vector3f::Zero();
    const Eigen::Vector3d mean = sum / count;
    Eigen::Matrix3d covariance = products / count;
    covariance.triangularView<Eigen::Lower>() -= mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    if (solver.eigenvalues()[1] < kLine * solver.eigenvalues()[2]) return Eigen::Vector3f::Zero();
    return solver.eigenvectors().col(0).cast<float>();
  }
};

struct Cell {
  CellKey key = 0;
  std::size_t first = 0;  ///< of its points in the sorted list
  std::size_t last = 0;   ///< past the end
  Moments moments;
};

/// The cells that hold points, in the order of their keys.
class Cells {
 public:
  Cells(std::span<const Eigen::Vector3f> points, double cell) {
    sorted_.reserve(points.size());
    Eigen::Vector3f low = points.front();
    for (const auto& p : points) low = low.cwiseMin(p);
    const auto per_metre = static_cast<float>(1.0 / cell);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3f c = (points[i] - low) * per_metre;
      CellKey key = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        constexpr float kLargest = 2e6F;  // within 21 bits, with a neighbour
        const float at = std::min(c[static_cast<Eigen::Index>(a)], kLargest);
        key += (static_cast<CellKey>(at) + 1) * kStride[a];
      }
      sorted_.emplace_back(key, static_cast<std::uint32_t>(i));
    }
    std::sort(sorted_.begin(), sorted_.end());
    const Eigen::Vector3d origin = points.front().cast<double>();
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
      const auto& [key, point] = sorted_[i];
      if (cells_.empty() || cells_.back().key != key) cells_.push_back({key, i, i, {}});
      cells_.back().last = i + 1;
      cells_.back().moments.add(points[point].cast<double>() - origin);
    }
  }

  [[nodiscard]] const std::vector<Cell>& all() const { return cells_; }
  [[nodiscard]] std::uint32_t point(std::size_t i) const { return sorted_[i].second; }

  /// The sums over the 27 cells around every cell, in the order of `all()`. The neighbours of successive
  /// cells in one direction follow each other: nine hands go through the list together.
  [[nodiscard]] std::vector<Moments> aroundAll() const {
    std::vector<Moments> around(cells_.size());
    for (CellKey dx = -1; dx <= 1; ++dx) {
      for (CellKey dy = -1; dy <= 1; ++dy) {
        const CellKey offset = dx * kStride[0] + dy * kStride[1];
        std::size_t hand = 0;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
          const CellKey middle = cells_[i].key + offset;
          while (hand < cells_.size() && cells_[hand].key < middle - 1) ++hand;
          for (std::size_t j = hand; j < cells_.size() && cells_[j].key <= middle + 1; ++j) {
            around[i].add(cells_[j].moments);
          }
        }
      }
    }
    return around;
  }

 private:
  std::vector<std::pair<CellKey, std::uint32_t>> sorted_;  ///< cell and index of every point
  std::vector<Cell> cells_;
};

}  // namespace

PointCloud surfaceNormals(std::span<const Eigen::Vector3f> points, double cell) {
  PointCloud normals(points.size(), Eigen::Vector3f::Zero());
  if (points.empty()) return normals;
  const Cells cells(points, cell);
  const std::vector<Moments> around = cells.aroundAll();
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Eigen::Vector3f normal = around[i].normal();
    const Cell& members = cells.all()[i];
    for (std::size_t j = members.first; j < members.last; ++j) normals[cells.point(j)] = normal;
  }
  return normals;
}

}  // namespace hoctomap
