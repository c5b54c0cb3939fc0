// SPDX-License-Identifier: BSD-3-Clause
#include "ThinThings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "ObjectImage.h"
#include "ScanBlocks.h"

namespace hoctomap {
namespace {

// Shares of the least rise at which regions are looked for: what is thicker ends at its own half height.
constexpr std::array kLevels{2.0, 1.0, 0.5};
constexpr int kWindow = 1;                     // half a window of 3 x 3, whose noise is a third
constexpr int kEdge = 2;                       // pixels by which a triangulating sensor misplaces an edge
constexpr double kLeastBreadth = 2.0 * kEdge;  // pixels: what is narrower is the blur of an edge
constexpr double kRimShare = 0.3;              // of its border, that must be a step down to the table
// What goes up from more of a region's border is the foot of a thicker thing, unless the region is level.
constexpr double kMostContact = 0.25;
constexpr double kLevelShare = 0.6;  // of its pixels, whose rise is that of the region
constexpr double kLevel = 0.35;      // of the rise, that they may differ, and
constexpr double kUneven =
    0.5;  // of the least rise: noise, and less than the front of a thicker thing goes up
constexpr double kMostOpen = 0.4;    // of its border: edges of tables are blurred into what is behind them
constexpr double kMostRise = 0.025;  // m: what is thicker needs no rim
constexpr double kSteepness = 0.6;   // of the rise, within the few pixels of a step
constexpr double kLeastArea = 6e-4;  // m^2, as if facing the sensor
constexpr double kUpright = 0.01;    // m: fronts that lean, or are round
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// What of the table a picture shows.
struct RisePicture {
  int width = 0;
  int height = 0;
  std::vector<float> rise;             ///< m above the table; NaN: not near it
  std::vector<float> least;            ///< m, the rise that is evidence there
  std::vector<std::uint8_t> thick;     ///< something that rises for certain
  std::vector<Eigen::Vector2f> place;  ///< m, seen from above
  std::vector<float> upright;          ///< m: what is upright may be as far off, seen from above
};

std::size_t at(const RisePicture& picture, int u, int v) {
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(u);
}

/// Averages over the window; pixels that are not near stay out.
void smooth(RisePicture& picture) {
  const auto rows = [&](const std::vector<float>& in, bool along_u) {
    std::vector<float> out(in.size(), kNothing);
    for (int v = 0; v < picture.height; ++v) {
      for (int u = 0; u < picture.width; ++u) {
        if (std::isnan(in[at(picture, u, v)])) continue;
        float sum = 0.0F;
        int n = 0;
        for (int d = -kWindow; d <= kWindow; ++d) {
          const int x = along_u ? u + d : u;
          const int y = along_u ? v : v + d;
          if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) continue;
          const float value = in[at(picture, x, y)];
          if (std::isnan(value)) continue;
          sum += value;
          ++n;
        }
        out[at(picture, u, v)] = sum / static_cast<float>(n);
      }
    }
    return out;
  };
  picture.rise = rows(rows(picture.rise, true), false);
}

class RegionFinder {
 public:
  RegionFinder(const RisePicture& picture, double pixel_angle2, std::span<const float> range2)
      : picture_(picture), pixel_angle2_(pixel_angle2), range2_(range2), thing_(picture.rise.size(), -1) {}

  void findAbove(double level) {
    std::vector<std::int32_t> region(picture_.rise.size(), -1);
    std::int32_t count = 0;
    std::vector<int> pixels;
    for (int seed = 0; seed < static_cast<int>(region.size()); ++seed) {
      if (region[static_cast<std::size_t>(seed)] >= 0 || !isAbove(static_cast<std::size_t>(seed), level))
        continue;
      follow(seed, level, count, region, pixels);
      if (isThing(pixels, count, region)) {
        for (const auto i : pixels) thing_[static_cast<std::size_t>(i)] = things_;
        ++things_;
      }
      ++count;
    }
  }

  /// Number of the thing of every pixel, -1 where there is none; what is found later holds what was found
  /// before.
  [[nodiscard]] const std::vector<std::int32_t>& thing() const { return thing_; }
  [[nodiscard]] std::int32_t things() const { return things_; }

 private:
  [[nodiscard]] bool isAbove(std::size_t i, double level) const {
    return static_cast<double>(picture_.rise[i]) > level * static_cast<double>(picture_.least[i]);
  }

  void follow(int seed, double level, std::int32_t number, std::vector<std::int32_t>& region,
              std::vector<int>& pixels) const {
    pixels.assign(1, seed);
    region[static_cast<std::size_t>(seed)] = number;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      const int i = pixels[k];
      const int u = i % picture_.width;
      const auto enter = [&](bool inside, int to) {
        const auto t = static_cast<std::size_t>(to);
        if (!inside || region[t] >= 0 || !isAbove(t, level)) return;
        region[t] = number;
        pixels.push_back(to);
      };
      enter(u > 0, i - 1);
      enter(u + 1 < picture_.width, i + 1);
      enter(i >= picture_.width, i - picture_.width);
      enter(i + picture_.width < picture_.width * picture_.height, i + picture_.width);
    }
  }

  /// @param pixels  of the region; of one that goes up into something thicker, those that are level are left
  [[nodiscard]] bool isThing(std::vector<int>& pixels, std::int32_t number,
                             const std::vector<std::int32_t>& region) const {
    double area = 0.0;
    double rise = 0.0;
    double least = 0.0;
    double steps = 0.0;
    int border = 0;
    int rim = 0;
    std::vector<int> contact;  // pixels of the border at which something thicker goes up
    int open = 0;
    for (const int i : pixels) {
      const auto at_i = static_cast<std::size_t>(i);
      area += pixel_angle2_ * static_cast<double>(range2_[at_i]);
      rise += static_cast<double>(picture_.rise[at_i]);
      least += static_cast<double>(picture_.least[at_i]);
      const int u = i % picture_.width;
      const int v = i / picture_.width;
      constexpr std::array<std::array<int, 2>, 4> kAround{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
      for (const auto& [du, dv] : kAround) {
        const auto out = offset(u, v, du, dv);
        if (out && region[*out] == number) continue;
        ++border;
        // Beyond the blur of the window and the sensor, on both sides.
        constexpr int kFar = kWindow + kEdge;
        const auto beyond = offset(u, v, (1 + kFar) * du, (1 + kFar) * dv);
        if ((out && picture_.thick[*out]) || (beyond && picture_.thick[*beyond])) {
          contact.push_back(i);
          continue;
        }
        if (!beyond || region[*beyond] == number) continue;
        if (std::isnan(picture_.rise[*beyond])) {
          ++open;
          continue;
        }
        const auto within = offset(u, v, -kFar * du, -kFar * dv);
        const std::size_t inner = within && region[*within] == number ? *within : at_i;
        steps += static_cast<double>(picture_.rise[inner] - picture_.rise[*beyond]);
        ++rim;
      }
    }
    if (area < kLeastArea || rim == 0 || rim < kRimShare * border || open > kMostOpen * border) return false;
    const auto n = static_cast<double>(pixels.size());
    if (2.0 * n < kLeastBreadth * border) return false;
    const double step = steps / rim;
    if (rise > kMostRise * n || step < least / n || step < kSteepness * rise / n) return false;
    rise /= n;
    least /= n;
    if (static_cast<double>(contact.size()) <= kMostContact * border) {
      leaveFronts(contact, rise + kUneven * least, pixels);
      return true;
    }
    std::erase_if(pixels, [&, most = std::min(kLevel * rise, kUneven * least)](int i) {
      return std::abs(static_cast<double>(picture_.rise[static_cast<std::size_t>(i)]) - rise) >= most;
    });
    return static_cast<double>(pixels.size()) > kLevelShare * n;
  }

  /// Takes out of a region what of it rises above `level` where something thicker goes up: the lower part of
  /// the front of what stands on a thin thing.
  void leaveFronts(const std::vector<int>& contact, double level, std::vector<int>& pixels) const {
    std::unordered_set<int> high;
    for (const int i : pixels) {
      if (static_cast<double>(picture_.rise[static_cast<std::size_t>(i)]) > level) high.insert(i);
    }
    struct Front {
      int pixel;
      std::size_t foot;  ///< pixel of the border, over which it stands
    };
    std::vector<Front> front;
    const auto enter = [&](int pixel, std::size_t foot) {
      const auto at_pixel = static_cast<std::size_t>(pixel);
      if (!high.contains(pixel) ||
          (picture_.place[at_pixel] - picture_.place[foot]).norm() > picture_.upright[foot]) {
        return;
      }
      high.erase(pixel);
      front.push_back({pixel, foot});
    };
    for (const int i : contact) enter(i, static_cast<std::size_t>(i));
    for (std::size_t k = 0; k < front.size(); ++k) {
      const auto [i, foot] = front[k];
      const int u = i % picture_.width;
      if (u > 0) enter(i - 1, foot);
      if (u + 1 < picture_.width) enter(i + 1, foot);
      enter(i - picture_.width, foot);
      enter(i + picture_.width, foot);
    }
    std::unordered_set<int> left;
    for (const Front& f : front) left.insert(f.pixel);
    std::erase_if(pixels, [&](int i) { return left.contains(i); });
  }

  [[nodiscard]] std::optional<std::size_t> offset(int u, int v, int du, int dv) const {
    const int x = u + du;
    const int y = v + dv;
    if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) return std::nullopt;
    return at(picture_, x, y);
  }

  const RisePicture& picture_;
  double pixel_angle2_;
  std::span<const float> range2_;
  std::vector<std::int32_t> thing_;
  std::int32_t things_ = 0;
};

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
  RegionFinder finder(picture, 1.0 / (view.image.fx * view.image.fy), range2);
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
