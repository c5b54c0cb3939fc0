// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/ExpectedInformationGain.h"

#include <cmath>
#include <limits>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

/// A ray: a point of it lies at `origin + depth * direction`, `depth` along the optical axis.
struct DepthRay {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;

  [[nodiscard]] Eigen::Vector3d at(double depth) const { return origin + depth * direction; }
};

/// Depths between which a ray lies in a box; empty (first > second) if it misses. Also tells whether it
/// leaves through the bottom.
struct Stretch {
  double in = 0.0;
  double out = kEndless;
  bool through_bottom = false;

  Stretch(const DepthRay& ray, const Eigen::AlignedBox3d& box) {
    for (int i = 0; i < 3; ++i) {
      const double d = ray.direction[i];
      if (d == 0.0) {
        if (ray.origin[i] < box.min()[i] || ray.origin[i] > box.max()[i]) out = -1.0;
        continue;
      }
      const double low = (box.min()[i] - ray.origin[i]) / d;
      const double high = (box.max()[i] - ray.origin[i]) / d;
      in = std::max(in, std::min(low, high));
      if (std::max(low, high) < out) {
        out = std::max(low, high);
        through_bottom = i == 2 && d < 0.0;
      }
    }
  }
  [[nodiscard]] bool empty() const { return in >= out; }
};

/// Whether something of the coarse grid stands in the way between two depths.
bool isBlocked(const KnowledgeGrid::Grid& grid, const DepthRay& ray, double from, double to) {
  const Stretch inside(ray, grid.box());
  from = std::max(from, inside.in);
  to = std::min(to, inside.out);
  const double step = 0.5 * grid.cell / ray.direction.norm();
  for (double depth = from + 0.5 * step; depth < to; depth += step) {
    const Eigen::Vector3d at = (ray.at(depth) - grid.corner) / grid.cell;
    const std::size_t cell =
        grid.index(static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z()));
    if (grid.cells[cell] != 0) return true;
  }
  return false;
}

/// Visits the cells of a grid that a ray meets between two depths in it: `visit(cell, from, to)`, until it
/// says false. [J. Amanatides, A. Woo: A fast voxel traversal algorithm for ray tracing, Eurographics 1987]
template <class Visit>
void walk(const KnowledgeGrid::Grid& grid, const DepthRay& ray, double from, double to, Visit&& visit) {
  std::array<int, 3> cell{};
  std::array<int, 3> step{};
  std::array<double, 3> next{};
  std::array<double, 3> delta{};
  constexpr double kHair = 1e-9;
  const Eigen::Vector3d start = (ray.at(from + kHair) - grid.corner) / grid.cell;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    cell[i] = std::clamp(static_cast<int>(std::floor(start[axis])), 0, grid.size[i] - 1);
    const double d = ray.direction[axis];
    step[i] = d > 0.0 ? 1 : -1;
    delta[i] = d == 0.0 ? kEndless : grid.cell / std::fabs(d);
    const double border = grid.corner[axis] + grid.cell * (cell[i] + (d > 0.0 ? 1 : 0));
    next[i] = d == 0.0 ? kEndless : (border - ray.origin[axis]) / d;
  }
  double at = from;
  while (at < to) {
    const std::size_t i = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const double leaves = std::min(next[i], to);
    if (!visit(grid.cells[grid.index(cell[0], cell[1], cell[2])], at, leaves)) return;
    at = leaves;
    cell[i] += step[i];
    if (cell[i] < 0 || cell[i] >= grid.size[i]) return;
    next[i] += delta[i];
  }
}

bool isWanted(Knowledge knowledge, Wanted wanted) {
  return knowledge == Knowledge::unknown_in_box ||
         (wanted == Wanted::everything && knowledge == Knowledge::unknown);
}

double entropyOf(double p) {
  return -p * std::log2(p) - (1.0 - p) * std::log2(1.0 - p);
}

}  // namespace

ExpectedInformationGain::ExpectedInformationGain(const GainConfig& config, const RobotModel& robot)
    : config_(config), robot_(robot) {
  if (config.columns < 1 || config.rows < 1 || !(config.attenuation > 0.0)) {
    throw ConfigError("[exploration] rays and attenuation must be positive");
  }
}

double ExpectedInformationGain::entropyChange(const OccupancyModel& sensor) {
  // H(0.5) is one bit; after one measurement an unknown cell has the probability of a hit, or of a miss.
  return 1.0 - 0.5 * (entropyOf(sensor.prob_hit) + entropyOf(sensor.prob_miss));
}

double ExpectedInformationGain::operator()(const KnowledgeGrid& knowledge, const Viewpoint& v,
                                           Wanted wanted) const {
  const Eigen::Isometry3d world_T_sensor = toIsometry(v.world_T_sensor());
  const PinholeCamera& camera = robot_.camera;
  const KnowledgeGrid::Grid& fine = knowledge.fine();
  const Eigen::AlignedBox3d space = fine.box();
  const double pixel_u = static_cast<double>(camera.width) / config_.columns;
  const double pixel_v = static_cast<double>(camera.height) / config_.rows;
  const double pixel_area = pixel_u / camera.fx * pixel_v / camera.fy;  // at unit depth
  const double change = entropyChange(config_.sensor);
  const bool occludes = config_.unknown_space == UnknownSpace::occluding;

  double gain = 0.0;
  for (int row = 0; row < config_.rows; ++row) {
    for (int column = 0; column < config_.columns; ++column) {
      const Eigen::Vector3d pixel =
          camera.point((column + 0.5) * pixel_u - 0.5, (row + 0.5) * pixel_v - 0.5, 1.0);
      const DepthRay ray{world_T_sensor.translation(), world_T_sensor.rotation() * pixel};
      const Stretch inside(ray, space);
      if (inside.empty() || inside.in > robot_.max_range) continue;
      if (isBlocked(knowledge.coarse(), ray, 0.0, inside.in)) continue;
      const double per_metre = ray.direction.norm();
      double found = 0.0;
      double passes = 1.0;  // the probability that the beam comes this far
      bool returns = inside.through_bottom && inside.out <= robot_.max_range;
      walk(fine, ray, inside.in, std::min(inside.out, robot_.max_range),
           [&](std::uint8_t cell, double from, double to) {
             const auto state = static_cast<Knowledge>(cell);
             if (state == Knowledge::occupied) {
               returns = true;
               return false;
             }
             if (state == Knowledge::free) return true;
             if (from >= robot_.min_range && isWanted(state, wanted)) {
               if (config_.measure == GainMeasure::entropy) {
                 found += change * passes;
               } else {
                 const double r = knowledge.resolutionOf(state);
                 const double middle = 0.5 * (from + to);
                 found += pixel_area * middle * middle * (to - from) / (r * r * r) * passes;
               }
             }
             if (occludes) passes *= std::exp(-(to - from) * per_metre / config_.attenuation);
             return true;
           });
      // A beam without return clears nothing: it has one if something stands behind, or in the unknown
      // itself.
      if (occludes && !returns && !isBlocked(knowledge.coarse(), ray, inside.out, robot_.max_range)) {
        found *= 1.0 - passes;
      }
      gain += found;
    }
  }
  return gain;
}

}  // namespace hoctomap
