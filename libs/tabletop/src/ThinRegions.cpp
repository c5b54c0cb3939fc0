// SPDX-License-Identifier: BSD-3-Clause
#include "ThinRegions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

namespace hoctomap {
namespace {

constexpr int kEdge = 2;                       // pixels by which a triangulating sensor misplaces an edge
constexpr double kLeastBreadth = 2.0 * kEdge;  // pixels: what is narrower is the blur of an edge
constexpr double kRimShare = 0.3;              // of its border, that must be a step down to the table
// What goes up from more of a region's border is the foot of a thicker thing, unless the region is level.
constexpr double kMostContact = 0.25;
constexpr double kLevelShare = 0.6;  // of its pixels, whose rise is that of the region
constexpr double kLevel = 0.35;      // of the rise, that they may differ, and
// of the least rise: noise, and less than the front of a thicker thing goes up
constexpr double kUneven = 0.5;
constexpr double kMostOpen = 0.4;    // of its border: edges of tables are blurred into what is behind them
constexpr double kMostRise = 0.025;  // m: what is thicker needs no rim
constexpr double kSteepness = 0.6;   // of the rise, within the few pixels of a step
constexpr double kLeastArea = 6e-4;  // m^2, as if facing the sensor

}  // namespace

ThinRegions::ThinRegions(const RisePicture& picture, double pixel_angle2, std::span<const float> range2)
    : picture_(picture), pixel_angle2_(pixel_angle2), range2_(range2), thing_(picture.rise.size(), -1) {}

void ThinRegions::findAbove(double level) {
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

bool ThinRegions::isAbove(std::size_t i, double level) const {
  return static_cast<double>(picture_.rise[i]) > level * static_cast<double>(picture_.least[i]);
}

void ThinRegions::follow(int seed, double level, std::int32_t number, std::vector<std::int32_t>& region,
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

bool ThinRegions::isThing(std::vector<int>& pixels, std::int32_t number,
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
      constexpr int kFar = RisePicture::kWindow + kEdge;
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

void ThinRegions::leaveFronts(const std::vector<int>& contact, double level, std::vector<int>& pixels) const {
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

std::optional<std::size_t> ThinRegions::offset(int u, int v, int du, int dv) const {
  const int x = u + du;
  const int y = v + dv;
  if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) return std::nullopt;
  return picture_.at(x, y);
}

}  // namespace hoctomap
