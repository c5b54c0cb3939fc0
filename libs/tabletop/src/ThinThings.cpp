// SPDX-License-Identifier: BSD-3-Clause
#include "ThinThings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ObjectImage.h"
#include "ScanBlocks.h"
#include "ThinRegions.h"

namespace hoctomap {
namespace {

// Shares of the least rise at which regions are looked for: what is thicker ends at its own half height.
constexpr std::array kLevels{2.0, 1.0, 0.5};
constexpr double kUpright = 0.01;  // m: fronts that lean, or are round
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// Averages over the window; pixels that are not near stay out.
void smooth(RisePicture& picture) {
  const auto rows = [&](const std::vector<float>& in, bool along_u) {
    std::vector<float> out(in.size(), kNothing);
    for (int v = 0; v < picture.height; ++v) {
      for (int u = 0; u < picture.width; ++u) {
        if (std::isnan(in[picture.at(u, v)])) continue;
        float sum = 0.0F;
        int n = 0;
        for (int d = -RisePicture::kWindow; d <= RisePicture::kWindow; ++d) {
          const int x = along_u ? u + d : u;
          const int y = along_u ? v : v + d;
          if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) continue;
          const float value = in[picture.at(x, y)];
          if (std::isnan(value)) continue;
          sum += value;
          ++n;
        }
        out[picture.at(u, v)] = sum / static_cast<float>(n);
      }
    }
    return out;
  };
  picture.rise = rows(rows(picture.rise, true), false);
}

}  // namespace

std::vector<Candidate> pointsNearTable(const ScanBlocks& scan, const TableSurface& table,
                                       const std::vector<bool>& in_object,
                                       const TabletopSegmentationConfig& config) {
  std::vector<Candidate> near;
  const Eigen::Vector3d origin = scan.z().origin();
  const double drop = table.plane.signedDistance(origin);
  const auto mayBeNear = [&, region = table.grid.bounds()](const Eigen::AlignedBox3d& box) {
    if (!region.intersects(inPlan(box))) return false;
    const Heights heights(table.plane, box);
    const double most = config.certainHeight((origin - box.center()).norm() + box.sizes().norm() / 2.0);
    return heights.low <= most && heights.high >= -most;
  };
  scan.visit(mayBeNear, [&](std::uint32_t i) {
    if (in_object[i]) return;
    const Eigen::Vector3d p = scan.z().world_points[i].cast<double>();
    const auto cell = table.grid.cellOf(p.x(), p.y());
    if (cell >= table.grid.size() || !table.extent[cell]) return;
    const double height = table.plane.signedDistance(p);
    const double range = (p - origin).norm();
    if (std::abs(height) < config.certainHeight(range)) {
      near.push_back({i, cell, height, range, config.leastRise(range, drop)});
    }
  });
  return near;
}

std::vector<Cluster> thinThings(const Measurement& z, const TableRelief& relief,
                                std::span<const Candidate> near, std::span<const Candidate> candidates,
                                const TabletopSegmentationConfig& config) {
  if (near.empty()) return {};
  const ObjectImage view = objectImage(z, near);
  RisePicture picture{view.image.width, view.image.height, {}, {}, {}, {}, {}};
  picture.rise.assign(view.image.size(), kNothing);
  picture.least.assign(view.image.size(), 0.0F);
  picture.thick.assign(view.image.size(), 0);
  picture.place.assign(view.image.size(), Eigen::Vector2f::Zero());
  picture.upright.assign(view.image.size(), 0.0F);
  std::vector<float> range2(view.image.size(), 0.0F);
  for (const auto& c : candidates) {
    const auto pixel = view.pixel_of_point[c.point];
    if (pixel != ObjectImage::kNone && c.height >= config.certainHeight(c.range)) picture.thick[pixel] = 1;
  }
  for (const auto& c : near) {
    const auto pixel = view.pixel_of_point[c.point];
    if (pixel == ObjectImage::kNone) continue;
    const Eigen::Vector3d p = z.world_points[c.point].cast<double>();
    picture.rise[pixel] = static_cast<float>(c.height - relief.at(p.x(), p.y()));
    picture.least[pixel] = static_cast<float>(c.least_rise);
    range2[pixel] = static_cast<float>(c.range * c.range);
    picture.place[pixel] = z.world_points[c.point].head<2>();
    picture.upright[pixel] = static_cast<float>(kUpright + config.noise(c.range));
  }
  smooth(picture);
  ThinRegions finder(picture, 1.0 / (view.image.fx * view.image.fy), range2);
  for (const double level : kLevels) finder.findAbove(level);
  std::vector<Cluster> things(static_cast<std::size_t>(finder.things()));
  for (const auto& c : near) {
    const auto pixel = view.pixel_of_point[c.point];
    if (pixel == ObjectImage::kNone || finder.thing()[pixel] < 0) continue;
    things[static_cast<std::size_t>(finder.thing()[pixel])].push_back(c);
  }
  std::erase_if(things, [](const Cluster& thing) { return thing.empty(); });
  return things;
}

}  // namespace hoctomap
