// SPDX-License-Identifier: BSD-3-Clause
#include "Containers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "UnionFind.h"

namespace hoctomap {
namespace {

constexpr double kHollow = 2.0;         // rad/m from which a region is an inside: a radius of half a metre
constexpr double kLeastSolid = -3.0;    // rad/m below which it is a solid thing
constexpr double kSharedInside = 0.2;   // of the smaller perimeter, for two insides to be one
constexpr double kSharedRim = 0.2;      // of the inside's perimeter, for a region to be its outside
constexpr double kLeastOutside = 0.15;  // of the inside's area
constexpr double kDeepest = 1.5;        // step at the rim, by the extent of the inside
constexpr double kEnclosed = 0.7;       // of its perimeter, for what lies in a container to belong to it

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// What two regions share.
struct Shared {
  double length = 0.0;   ///< pixel pairs
  double contact = 0.0;  ///< of them those where the surface goes on
  double behind = 0.0;   ///< steps at which the other region is in front
  double jumps = 0.0;    ///< all steps
  double depth = 0.0;    ///< m, of these together

  /// Pixel pairs of the rim between an inside of this extent (m) and its outside. Over the rim, the sensor
  /// sees as far into a container as it is wide and deep: what is hidden farther behind stands behind it.
  [[nodiscard]] double rim(double extent) const {
    return contact + (depth <= kDeepest * extent * jumps ? behind : 0.0);
  }
};

struct RegionShape {
  double area = 0.0;
  double perimeter = 0.0;
  double bend = 0.0;            ///< curvature x pixels
  double inner = 0.0;           ///< pixels of its inner borders
  Eigen::AlignedBox3d centers;  ///< of its patches
  std::map<std::int32_t, Shared> shared;

  [[nodiscard]] double extent() const { return centers.isEmpty() ? 0.0 : centers.diagonal().norm(); }
  [[nodiscard]] double curvature() const { return inner > 0.0 ? bend / inner : 0.0; }
};

std::vector<RegionShape> shapesOf(const PatchGraph& graph, const PatchRegions& regions) {
  std::vector<RegionShape> shapes(at(regions.count));
  for (std::size_t k = 0; k < graph.area.size(); ++k) {
    shapes[at(regions.of_patch[k])].area += graph.area[k];
    shapes[at(regions.of_patch[k])].perimeter += graph.perimeter[k];
    shapes[at(regions.of_patch[k])].centers.extend(graph.centers[k]);
  }
  for (const auto& border : graph.borders) {
    const auto a = regions.of_patch[at(border.a)];
    const auto b = regions.of_patch[at(border.b)];
    if (a == b) {
      auto& shape = shapes[at(a)];
      shape.perimeter -= 2.0 * border.length;
      if (!border.isContact()) continue;
      shape.bend += border.length * border.curvature();
      shape.inner += border.length;
      continue;
    }
    const double contact = border.length - border.jumps;
    auto& of_a = shapes[at(a)].shared[b];
    auto& of_b = shapes[at(b)].shared[a];
    of_a.length += border.length;
    of_b.length += border.length;
    of_a.contact += contact;
    of_b.contact += contact;
    for (Shared* shared : {&of_a, &of_b}) {
      shared->jumps += border.jumps;
      shared->depth += border.depth;
    }
    of_a.behind += (border.jumps - border.in_front) / 2.0;
    of_b.behind += (border.jumps + border.in_front) / 2.0;
  }
  return shapes;
}

/// Renumbers the regions after joins.
void apply(UnionFind& sets, PatchRegions& regions) {
  std::vector<std::int32_t> number(at(regions.count), -1);
  regions.count = 0;
  for (auto& region : regions.of_patch) {
    auto& n = number[sets.find(static_cast<std::uint32_t>(region))];
    if (n < 0) n = regions.count++;
    region = n;
  }
}

using Flags = std::vector<std::uint8_t>;

/// Whether a region that shares `contact` with an inside is its floor: no solid thing, and all around either
/// that inside or something that hides it.
bool isFloor(const RegionShape& shape, double contact) {
  if (shape.curvature() <= kLeastSolid) return false;
  double enclosed = contact;
  for (const auto& [other, shared] : shape.shared) enclosed += shared.behind;
  return enclosed > kEnclosed * shape.perimeter;
}

/// Unites the parts of one inside; returns which regions are insides.
Flags uniteInsides(const PatchGraph& graph, double least, PatchRegions& regions) {
  const auto shapes = shapesOf(graph, regions);
  const auto isInside = [&](std::int32_t r) {
    return shapes[at(r)].curvature() > kHollow && shapes[at(r)].area >= least;
  };
  UnionFind sets(at(regions.count));
  for (std::int32_t r = 0; r < regions.count; ++r) {
    if (!isInside(r)) continue;
    for (const auto& [other, shared] : shapes[at(r)].shared) {
      const double smaller = std::min(shapes[at(r)].perimeter, shapes[at(other)].perimeter);
      if (shared.length <= kSharedInside * smaller) continue;
      if (isInside(other) || isFloor(shapes[at(other)], shared.contact)) {
        sets.join(static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(other));
      }
    }
  }
  std::vector<std::int32_t> before(regions.of_patch);
  apply(sets, regions);
  Flags inside(at(regions.count), 0);
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (isInside(before[k])) inside[at(regions.of_patch[k])] = 1;
  }
  return inside;
}

/// Joins each inside to its outside; returns which regions are containers.
Flags joinOutsides(const PatchGraph& graph, const Flags& inside, PatchRegions& regions) {
  const auto shapes = shapesOf(graph, regions);
  UnionFind sets(at(regions.count));
  Flags joined(at(regions.count), 0);
  for (std::int32_t r = 0; r < regions.count; ++r) {
    if (!inside[at(r)]) continue;
    std::int32_t outside = -1;
    double most = kSharedRim * shapes[at(r)].perimeter;
    const double extent = shapes[at(r)].extent();
    for (const auto& [other, shared] : shapes[at(r)].shared) {
      if (inside[at(other)] || shared.rim(extent) <= most) continue;
      if (shapes[at(other)].area < kLeastOutside * shapes[at(r)].area) continue;
      outside = other;
      most = shared.rim(extent);
    }
    joined[at(r)] = 1;
    if (outside < 0) continue;
    sets.join(static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(outside));
  }
  const std::vector<std::int32_t> before(regions.of_patch);
  apply(sets, regions);
  Flags container(at(regions.count), 0);
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (joined[at(before[k])]) container[at(regions.of_patch[k])] = 1;
  }
  return container;
}

void joinContents(const PatchGraph& graph, const Flags& container, PatchRegions& regions) {
  const auto shapes = shapesOf(graph, regions);
  UnionFind sets(at(regions.count));
  for (std::int32_t r = 0; r < regions.count; ++r) {
    if (container[at(r)] || shapes[at(r)].curvature() <= kLeastSolid) continue;
    for (const auto& [other, shared] : shapes[at(r)].shared) {
      if (!container[at(other)] || shared.length <= kEnclosed * shapes[at(r)].perimeter) continue;
      sets.join(static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(other));
    }
  }
  apply(sets, regions);
}

}  // namespace

void joinContainers(const PatchGraph& graph, double least, PatchRegions& regions) {
  const Flags inside = uniteInsides(graph, least, regions);
  const Flags container = joinOutsides(graph, inside, regions);
  joinContents(graph, container, regions);
}

}  // namespace hoctomap
