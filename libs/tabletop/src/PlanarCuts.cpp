// SPDX-License-Identifier: BSD-3-Clause
#include "PlanarCuts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "UnionFind.h"

namespace hoctomap {
namespace {

constexpr double kFaceAngle = 10.0;      // degrees between the normals of patches of one face
constexpr double kFlatness = 1.2;        // scatters by which they may depart from a common plane
constexpr double kLeastFace = 1.6;       // cells; a smaller face has no direction
constexpr double kInFront = 0.5;         // scatters: nearer to its plane is the face itself, or flush with it
constexpr double kLeastPart = 0.06;      // of the region: less is a few patches on the wrong side of a border
constexpr double kCrease = 30.0;         // degrees of evidence that show a seam
constexpr double kLeastCrease = 1.25;    // cells of border along which one is seen
constexpr double kLeastDepth = 3.0;      // scatters that a part is in front of the face, on the mean
constexpr double kLeastShare = 0.25;     // of the border of a cut that must show the seam
constexpr double kLeastExplained = 0.5;  // of it that must be seam, or lie within a face of both
constexpr double kLeastFlush = 2.3;      // cells that such a face has on either side
constexpr double kRadians = std::numbers::pi / 180.0;

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// Nearly plane groups of patches.
class Faces {
 public:
  struct Face {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< towards the camera
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< m
    double area = 0.0;                                 ///< pixels
  };

  Faces(const PatchGraph& graph, double scatter) : sets_(graph.area.size()) {
    for (std::size_t k = 0; k < graph.area.size(); ++k) {
      faces_.push_back({graph.normals[k], graph.centers[k], graph.area[k]});
    }
    std::vector<std::uint32_t> order(graph.borders.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::abs(graph.borders[a].crease) < std::abs(graph.borders[b].crease);
    });
    for (const auto e : order) {
      const PatchBorder& border = graph.borders[e];
      if (std::abs(border.crease) > kFaceAngle) break;
      if (border.isContact()) joinIfPlane(of(border.a), of(border.b), scatter);
    }
  }

  [[nodiscard]] std::uint32_t of(std::int32_t patch) { return sets_.find(static_cast<std::uint32_t>(patch)); }
  [[nodiscard]] const Face& operator[](std::uint32_t face) const { return faces_[face]; }

 private:
  void joinIfPlane(std::uint32_t a, std::uint32_t b, double scatter) {
    if (a == b) return;
    const Face& x = faces_[a];
    const Face& y = faces_[b];
    const Eigen::Vector3d between = y.center - x.center;
    const double most = kFlatness * scatter * x.center.z() * x.center.z();
    if (x.normal.dot(y.normal) < std::cos(kFaceAngle * kRadians)) return;
    if (std::abs(between.dot(x.normal)) > most || std::abs(between.dot(y.normal)) > most) return;
    const double area = x.area + y.area;
    const Face both{(x.area * x.normal + y.area * y.normal).normalized(),
                    (x.area * x.center + y.area * y.center) / area, area};
    sets_.join(a, b);
    faces_[sets_.find(a)] = both;
  }

  UnionFind sets_;
  std::vector<Face> faces_;  // by the representative of a set
};

/// A part of a region in front of a face.
struct Cut {
  double unseen = 0.0;  ///< pixels of its border that show no seam
  std::vector<std::int32_t> part;
};

class PlanarCuts {
 public:
  PlanarCuts(const PatchGraph& graph, const PatchScales& scales, double fragment, PatchRegions& regions)
      : graph_(graph),
        scales_(scales),
        fragment_(fragment),
        regions_(regions),
        faces_(graph, scales.scatter) {}

  /// As often as there is something to cut. Of several cuts the one that needs the least to be believed: the
  /// plane through the crease along the one face, or along the other.
  void cut(std::int32_t region) {
    std::vector<std::int32_t> patches;
    for (std::size_t k = 0; k < regions_.of_patch.size(); ++k) {
      if (regions_.of_patch[k] == region) patches.push_back(static_cast<std::int32_t>(k));
    }
    Cut best;
    for (const auto face : facesAtCreases(patches)) consider(patches, face, best);
    if (best.part.empty()) return;
    const std::int32_t part = regions_.count++;
    for (const auto k : best.part) regions_.of_patch[at(k)] = part;
    cut(region);
    cut(part);
  }

 private:
  [[nodiscard]] bool isInside(const PatchBorder& border, std::int32_t region) const {
    return regions_.of_patch[at(border.a)] == region && regions_.of_patch[at(border.b)] == region;
  }

  /// Faces at creases within the region. One that is another region's for the most part is there by a few
  /// patches on the wrong side of a border.
  std::set<std::uint32_t> facesAtCreases(const std::vector<std::int32_t>& patches) {
    std::map<std::uint32_t, double> area;  // within the region
    for (const auto k : patches) area[faces_.of(k)] += graph_.area[at(k)];
    std::set<std::uint32_t> found;
    for (const auto k : patches) {
      const auto face = faces_.of(k);
      if (area[face] < kLeastFace * scales_.cell * scales_.cell) continue;
      if (2.0 * area[face] < faces_[face].area) continue;
      for (const auto e : graph_.borders_of[at(k)]) {
        const PatchBorder& border = graph_.borders[e];
        if (border.evidence >= kCrease && isInside(border, regions_.of_patch[at(k)])) found.insert(face);
      }
    }
    return found;
  }

  /// The connected parts of the region in front of the face.
  void consider(const std::vector<std::int32_t>& patches, std::uint32_t face, Cut& best) {
    const auto& plane = faces_[face];
    const double scatter = scales_.scatter * plane.center.z() * plane.center.z();  // m
    const double margin = kInFront * scatter;
    const double least_depth = kLeastDepth * scatter;
    std::set<std::int32_t> left;  // not yet in a part
    double area = 0.0;
    for (const auto k : patches) {
      area += graph_.area[at(k)];
      const double distance = plane.normal.dot(graph_.centers[at(k)] - plane.center);
      if (distance > margin && faces_.of(k) != face) left.insert(k);
    }
    const double least_area = std::max(fragment_, kLeastPart * area);
    while (!left.empty()) {
      std::vector<std::int32_t> part{*left.begin()};
      left.erase(left.begin());
      double part_area = 0.0;
      double depth = 0.0;
      for (std::size_t n = 0; n < part.size(); ++n) {
        const double patch_area = graph_.area[at(part[n])];
        part_area += patch_area;
        depth += patch_area * plane.normal.dot(graph_.centers[at(part[n])] - plane.center);
        for (const auto e : graph_.borders_of[at(part[n])]) {
          const auto other = graph_.borders[e].other(part[n]);
          if (left.erase(other) > 0) part.push_back(other);
        }
      }
      if (std::min(part_area, area - part_area) < least_area || depth < least_depth * part_area) continue;
      const auto unseen = unseenBorder(patches, part);
      if (unseen && (best.part.empty() || *unseen < best.unseen)) best = {*unseen, part};
    }
  }

  /// How much of the border between a part and the rest of its region shows no crease or step; none if there
  /// is too little that does, or if the two could not be flush at the rest of the border.
  std::optional<double> unseenBorder(const std::vector<std::int32_t>& patches,
                                     const std::vector<std::int32_t>& part) {
    const std::int32_t region = regions_.of_patch[at(patches.front())];
    std::vector<std::uint8_t> in_part(graph_.area.size(), 0);
    for (const auto k : part) in_part[at(k)] = 1;
    std::vector<double> in_front(graph_.area.size(), 0.0);  // pixels of every face
    std::vector<double> behind(graph_.area.size(), 0.0);
    for (const auto k : patches) (in_part[at(k)] ? in_front : behind)[faces_.of(k)] += graph_.area[at(k)];
    const auto goesAcross = [&](std::uint32_t face) {
      return std::min(in_front[face], behind[face]) >= kLeastFlush * scales_.cell * scales_.cell;
    };
    double length = 0.0;
    double seen = 0.0;
    double flush = 0.0;
    for (const auto k : part) {
      for (const auto e : graph_.borders_of[at(k)]) {
        const PatchBorder& border = graph_.borders[e];
        if (in_part[at(border.other(k))] || !isInside(border, region)) continue;
        length += border.length;
        if (border.evidence >= kCrease) {
          seen += border.length;
        } else if (faces_.of(border.a) == faces_.of(border.b) && goesAcross(faces_.of(border.a))) {
          flush += border.length;
        }
      }
    }
    if (seen < std::max(kLeastCrease * scales_.cell, kLeastShare * length)) return std::nullopt;
    if (seen + flush < kLeastExplained * length) return std::nullopt;
    return length - seen;
  }

  const PatchGraph& graph_;
  const PatchScales& scales_;
  double fragment_;
  PatchRegions& regions_;
  Faces faces_;
};

}  // namespace

void cutAtFaces(const PatchGraph& graph, const PatchScales& scales, double fragment,
                const std::vector<std::uint8_t>& fixed, PatchRegions& regions) {
  PlanarCuts cuts(graph, scales, fragment, regions);
  const std::int32_t count = regions.count;
  for (std::int32_t region = 0; region < count; ++region) {
    if (!fixed[at(region)]) cuts.cut(region);
  }
}

}  // namespace hoctomap
