// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/geometry/SurfaceNormals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
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

/// The cells that hold points.
class Cells {
 public:
  Cells(std::span<const Eigen::Vector3f> points, double cell) {
    cell_of_point_.reserve(points.size());
    Eigen::Vector3f low = points.front();
    for (const auto& p : points) low = low.cwiseMin(p);
    const auto per_metre = static_cast<float>(1.0 / cell);
    const Eigen::Vector3d origin = points.front().cast<double>();
    std::unordered_map<CellKey, std::uint32_t> numbers;
    std::uint32_t number = 0;
    for (const auto& p : points) {
      const CellKey key = keyOf((p - low) * per_metre);
      if (keys_.empty() || keys_[number] != key) {  // neighbours of an image mostly share their cell
        const auto [found, is_new] = numbers.try_emplace(key, static_cast<std::uint32_t>(keys_.size()));
        number = found->second;
        if (is_new) {
          keys_.push_back(key);
          moments_.emplace_back();
        }
      }
      moments_[number].add(p.cast<double>() - origin);
      cell_of_point_.push_back(number);
    }
  }

  [[nodiscard]] std::size_t size() const { return keys_.size(); }
  [[nodiscard]] std::uint32_t cellOfPoint(std::size_t i) const { return cell_of_point_[i]; }

  /// The sums over the 27 cells around every cell. In the order of the keys the cells next to successive
  /// ones follow each other: nine hands go through the list.
  [[nodiscard]] std::vector<Moments> aroundAll() const {
    std::vector<std::pair<CellKey, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < size(); ++i) order.emplace_back(keys_[i], i);
    std::sort(order.begin(), order.end());
    std::vector<Moments> around(size());
    for (CellKey dx = -1; dx <= 1; ++dx) {
      for (CellKey dy = -1; dy <= 1; ++dy) {
        const CellKey offset = dx * kStride[0] + dy * kStride[1];
        std::size_t hand = 0;
        for (const auto& [key, i] : order) {
          const CellKey middle = key + offset;
          while (hand < order.size() && order[hand].first < middle - 1) ++hand;
          for (std::size_t j = hand; j < order.size() && order[j].first <= middle + 1; ++j) {
            around[i].add(moments_[order[j].second]);
          }
        }
      }
    }
    return around;
  }

 private:
  static CellKey keyOf(const Eigen::Vector3f& at) {
    CellKey key = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      constexpr float kLargest = 2e6F;  // within 21 bits, with a neighbour
      key += (static_cast<CellKey>(std::min(at[static_cast<Eigen::Index>(a)], kLargest)) + 1) * kStride[a];
    }
    return key;
  }

  std::vector<CellKey> keys_;
  std::vector<Moments> moments_;
  std::vector<std::uint32_t> cell_of_point_;
};

}  // namespace

PointCloud surfaceNormals(std::span<const Eigen::Vector3f> points, double cell) {
  PointCloud normals;
  if (points.empty()) return normals;
  const Cells cells(points, cell);
  PointCloud normal_of_cell;
  for (const Moments& around : cells.aroundAll()) normal_of_cell.push_back(around.normal());
  normals.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) normals.push_back(normal_of_cell[cells.cellOfPoint(i)]);
  return normals;
}

}  // namespace hoctomap
