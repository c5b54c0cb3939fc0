// SPDX-License-Identifier: BSD-3-Clause
#include "EnclosedPieces.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numeric>

namespace hoctomap {
namespace {

constexpr double kMostShare = 0.3;   // of the points of the thing that a piece belongs to
constexpr double kEnclosed = 0.9;    // of the piece's points, within the thing's box
constexpr double kOutliers = 0.01;   // of a thing's points, beyond each side of its box
constexpr double kMargin = 0.005;    // m, around the box
constexpr double kOffTable = 0.012;  // m, above the table, of a piece that does not stand on it
constexpr double kHold = 0.015;      // m, between a piece and what holds it
constexpr std::size_t kLeast = 100;  // points; fewer have no axes

/// Upright box around all but a few points of a cluster.
class UprightBox {
 public:
  UprightBox(const Cluster& cluster, const Measurement& z) : z_(z) {
    const auto n = static_cast<double>(cluster.size());
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& c : cluster) mean += z.world_points[c.point].head<2>().cast<double>() / n;
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    for (const auto& c : cluster) {
      const Eigen::Vector2d d = z.world_points[c.point].head<2>().cast<double>() - mean;
      covariance += d * d.transpose() / n;
    }
    axes_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).eigenvectors();
    const auto cut = static_cast<std::ptrdiff_t>(kOutliers * n);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      values.reserve(cluster.size());
      for (const auto& c : cluster) values.push_back(inBox(c)[axis]);
      std::nth_element(values.begin(), values.begin() + cut, values.end());
      low_[axis] = *(values.begin() + cut) - kMargin;
      std::nth_element(values.begin(), values.end() - 1 - cut, values.end());
      high_[axis] = *(values.end() - 1 - cut) + kMargin;
    }
  }

  [[nodiscard]] bool encloses(const Cluster& piece) const {
    const auto inside = std::count_if(piece.begin(), piece.end(), [&](const Candidate& c) {
      const Eigen::Array3d p = inBox(c);
      return (p >= low_).all() && (p <= high_).all();
    });
    return static_cast<double>(inside) > kEnclosed * static_cast<double>(piece.size());
  }

  /// Whether a piece is held up by this thing, from the side: it does not reach down to the table, nor lie on
  /// top, and is in touch with it. A handle, that is: what is not held falls.
  [[nodiscard]] bool holds(const Cluster& piece, const Cluster& thing) const {
    const auto [lowest, highest] = std::minmax_element(
        piece.begin(), piece.end(), [](const auto& a, const auto& b) { return a.height < b.height; });
    if (lowest->height < kOffTable || lowest->height < low_.z()) return false;
    if (highest->height > high_.z() || lowest->height > 0.5 * (low_.z() + high_.z())) return false;
    const auto touches = [&](const Candidate& a, const Candidate& b) {
      return (z_.world_points[a.point] - z_.world_points[b.point]).norm() < kHold;
    };
    // A few hundred points of either are enough: neighbours are nearer than that.
    const std::size_t step = 1 + piece.size() / kLeast;
    const std::size_t thing_step = 1 + thing.size() / (20 * kLeast);
    for (std::size_t i = 0; i < piece.size(); i += step) {
      for (std::size_t j = 0; j < thing.size(); j += thing_step) {
        if (touches(piece[i], thing[j])) return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] Eigen::Array3d inBox(const Candidate& c) const {
    const Eigen::Vector2d p = axes_.transpose() * z_.world_points[c.point].head<2>().cast<double>();
    return {p.x(), p.y(), c.height};
  }

  const Measurement& z_;
  Eigen::Matrix2d axes_;
  Eigen::Array3d low_;
  Eigen::Array3d high_;
};

}  // namespace

void joinEnclosedPieces(std::vector<Cluster>& clusters, const Measurement& z) {
  std::vector<std::size_t> order(clusters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return clusters[a].size() > clusters[b].size(); });
  for (const auto k : order) {  // the largest first
    auto& thing = clusters[k];
    if (thing.size() < kLeast) continue;
    const UprightBox box(thing, z);
    const double most = kMostShare * static_cast<double>(thing.size());
    for (auto& piece : clusters) {
      if (piece.empty() || &piece == &thing || static_cast<double>(piece.size()) > most) continue;
      if (!box.encloses(piece) && !box.holds(piece, thing)) continue;
      const auto own = static_cast<std::ptrdiff_t>(thing.size());
      thing.insert(thing.end(), piece.begin(), piece.end());
      std::inplace_merge(thing.begin(), thing.begin() + own, thing.end(),
                         [](const auto& a, const auto& b) { return a.point < b.point; });
      piece.clear();
    }
  }
  std::erase_if(clusters, [](const Cluster& cluster) { return cluster.empty(); });
}

}  // namespace hoctomap
