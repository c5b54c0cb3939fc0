// SPDX-License-Identifier: BSD-3-Clause
#include "PatchGraph.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace hoctomap {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kPoolings = 2;           // of the moments with those of the neighbours
constexpr int kSmoothings = 2;         // of the normals
constexpr double kSmoothAngle = 15.0;  // degrees; normals that differ more belong to different faces
// Pixels by which a triangulating sensor misplaces an edge; on a steep surface they make a step.
constexpr double kEdgeError = 2.0;
constexpr double kAhead = 0.6;         // least cosine of what lies on the far side of a patch
constexpr double kMostConvex = -30.0;  // degrees that a border may count
constexpr double kStep = 60.0;         // degrees that a step counts, and a crease at most
constexpr double kMostCrease = 40.0;   // degrees that enter a curvature

std::size_t ix(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// Labels and inverse depths, carried on into pixels without a return: the shadow that a camera with a
/// projector leaves along edges does not part what touches.
struct BridgedImage {
  BridgedImage(const InverseDepthImage& image, const SurfacePatches& patches, int steps)
      : label(patches.label), w(image.w) {
    const int width = image.width;
    std::vector<int> front;
    for (int i = 0; i < width * image.height; ++i) {
      if (label[ix(i)] >= 0) front.push_back(i);
    }
    for (int step = 0; step < steps; ++step) {
      std::vector<int> next;
      for (const int at : front) {
        const int u = at % width;
        const auto enter = [&](bool inside, int to) {
          if (!inside || w[ix(to)] > 0.0F) return;
          label[ix(to)] = label[ix(at)];
          w[ix(to)] = w[ix(at)];
          next.push_back(to);
        };
        enter(u > 0, at - 1);
        enter(u + 1 < width, at + 1);
        enter(at >= width, at - width);
        enter(at + width < width * image.height, at + width);
      }
      front = std::move(next);
    }
  }

  std::vector<std::int32_t> label;
  std::vector<float> w;
};

class BorderCounter {
 public:
  BorderCounter(const InverseDepthImage& image, const SurfacePatches& patches, const PatchScales& scales,
                PatchGraph& graph)
      : patches_(patches), jump_(scales.jump), graph_(graph), bridged_(image, patches, scales.bridge) {
    graph_.borders_of.resize(patches.size());
    graph_.perimeter.assign(patches.size(), 0.0);
    for (int v = 0; v < image.height; ++v) {
      for (int u = 0; u < image.width; ++u) {
        const std::size_t i = ix(v * image.width + u);
        if (u + 1 < image.width) count(i, i + 1, u + 0.5, v);
        if (v + 1 < image.height) count(i, i + ix(image.width), u, v + 0.5);
      }
    }
  }

 private:
  void count(std::size_t i, std::size_t j, double u, double v) {
    auto a = bridged_.label[i];
    auto b = bridged_.label[j];
    if (a == b) return;
    if (a >= 0) graph_.perimeter[ix(a)] += 1.0;
    if (b >= 0) graph_.perimeter[ix(b)] += 1.0;
    if (a < 0 || b < 0) return;
    const double step = std::abs(static_cast<double>(bridged_.w[i]) - static_cast<double>(bridged_.w[j]));
    if (a > b) std::swap(a, b);
    PatchBorder& border = borderOf(a, b);
    border.length += 1.0;
    const PatchPlane& of_a = patches_.planes[ix(a)];
    const PatchPlane& of_b = patches_.planes[ix(b)];
    const double slopes = std::hypot(of_a.a, of_a.b) + std::hypot(of_b.a, of_b.b);
    const double jump = jump_ + kEdgeError * slopes;
    if (step <= jump) return;
    const double between = of_a.at(u, v) - of_b.at(u, v);
    if (std::abs(between) <= jump) return;
    border.jumps += 1.0;
    border.depth += step / (static_cast<double>(bridged_.w[i]) * static_cast<double>(bridged_.w[j]));
    border.in_front += between > 0.0 ? 1.0 : -1.0;
  }

  PatchBorder& borderOf(std::int32_t a, std::int32_t b) {
    for (const auto e : graph_.borders_of[ix(a)]) {
      if (graph_.borders[e].b == b) return graph_.borders[e];
    }
    const auto e = static_cast<std::uint32_t>(graph_.borders.size());
    graph_.borders_of[ix(a)].push_back(e);
    graph_.borders_of[ix(b)].push_back(e);
    auto& border = graph_.borders.emplace_back();
    border.a = a;
    border.b = b;
    return border;
  }

  const SurfacePatches& patches_;
  double jump_;
  PatchGraph& graph_;
  BridgedImage bridged_;
};

/// Fits each patch to its neighbours, too, as far as they go on as it does: the normal of a few hundred noisy
/// pixels is good to some degrees only.
std::vector<PatchPlane> pooledPlanes(const SurfacePatches& patches, const PatchGraph& graph,
                                     const PatchScales& scales) {
  std::vector<double> own_error(patches.size());
  for (std::size_t k = 0; k < patches.size(); ++k) {
    own_error[k] = patches.moments[k].meanSquaredError(patches.planes[k]);
  }
  auto planes = patches.planes;
  for (int round = 0; round < kPoolings; ++round) {
    auto next = planes;
    for (std::size_t k = 0; k < patches.size(); ++k) {
      PatchMoments pool = patches.moments[k];
      for (const auto e : graph.borders_of[k]) {
        const auto& border = graph.borders[e];
        if (!border.isContact()) continue;
        const std::size_t j = ix(border.other(static_cast<std::int32_t>(k)));
        const double excess = std::max(0.0, patches.moments[j].meanSquaredError(planes[k]) - own_error[j]);
        const double weight = std::exp(-excess / (2.0 * scales.scatter * scales.scatter));
        if (weight > 1e-3) pool.add(patches.moments[j], weight);
      }
      next[k] = pool.plane(scales.ridge);
    }
    planes = std::move(next);
  }
  return planes;
}

void smoothNormals(PatchGraph& graph) {
  for (int round = 0; round < kSmoothings; ++round) {
    auto next = graph.normals;
    for (std::size_t k = 0; k < next.size(); ++k) {
      Eigen::Vector3d sum = graph.area[k] * graph.normals[k];
      for (const auto e : graph.borders_of[k]) {
        const auto& border = graph.borders[e];
        if (!border.isContact()) continue;
        const std::size_t j = ix(border.other(static_cast<std::int32_t>(k)));
        const double cosine = std::clamp(graph.normals[k].dot(graph.normals[j]), -1.0, 1.0);
        const double angle = std::acos(cosine) * kDegrees / kSmoothAngle;
        sum += std::exp(-angle * angle / 2.0) * graph.area[j] * graph.normals[j];
      }
      next[k] = sum.normalized();
    }
    graph.normals = std::move(next);
  }
}

void measureCreases(PatchGraph& graph) {
  for (auto& border : graph.borders) {
    const Eigen::Vector3d n = graph.normals[ix(border.a)] - graph.normals[ix(border.b)];
    const Eigen::Vector3d x = graph.centers[ix(border.a)] - graph.centers[ix(border.b)];
    const double cosine = std::clamp(graph.normals[ix(border.a)].dot(graph.normals[ix(border.b)]), -1.0, 1.0);
    const double angle = std::acos(cosine) * kDegrees;
    border.crease = n.dot(x) < 0.0 ? angle : -angle;
    border.distance = x.norm();
  }
}

/// How the surface bends beyond `patch`, seen from its neighbour `from`: degrees, the mean crease with what
/// lies ahead.
double bendBeyond(const PatchGraph& graph, const SurfacePatches& patches, std::int32_t patch,
                  std::int32_t from) {
  const PatchPlane& here = patches.planes[ix(patch)];
  const PatchPlane& back = patches.planes[ix(from)];
  const Eigen::Vector2d forward = Eigen::Vector2d(here.u - back.u, here.v - back.v).normalized();
  double sum = 0.0;
  double weights = 0.0;
  for (const auto e : graph.borders_of[ix(patch)]) {
    const auto& border = graph.borders[e];
    const auto next = border.other(patch);
    if (next == from || !border.isContact()) continue;
    const PatchPlane& there = patches.planes[ix(next)];
    const double cosine = Eigen::Vector2d(there.u - here.u, there.v - here.v).normalized().dot(forward);
    if (cosine <= kAhead) continue;
    sum += cosine * border.crease;
    weights += cosine;
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

/// What a border says, in degrees. The bend that goes on beyond it on both sides is discounted: a crease
/// bends at one border only, the wall of a bowl beyond it, too.
void weighEvidence(const SurfacePatches& patches, PatchGraph& graph) {
  for (auto& border : graph.borders) {
    double crease = border.crease;
    if (crease > 0.0) {
      const double beyond = std::min(bendBeyond(graph, patches, border.a, border.b),
                                     bendBeyond(graph, patches, border.b, border.a));
      if (beyond > 0.0) crease = std::max(0.0, crease - beyond);
    }
    const double jump_share = border.jumps / border.length;
    border.evidence = jump_share * kStep + (1.0 - jump_share) * std::clamp(crease, kMostConvex, kStep);
  }
}

}  // namespace

double PatchBorder::curvature() const {
  return std::clamp(crease, -kMostCrease, kMostCrease) / kDegrees / std::max(distance, 1e-6);
}

PatchGraph patchGraph(const InverseDepthImage& image, const SurfacePatches& patches,
                      const PatchScales& scales) {
  PatchGraph graph;
  BorderCounter(image, patches, scales, graph);
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const PatchPlane& p = patches.planes[k];
    graph.area.push_back(patches.moments[k].n);
    graph.centers.push_back(image.point(p.u, p.v, patches.moments[k].w / patches.moments[k].n));
  }
  for (const auto& plane : pooledPlanes(patches, graph, scales)) {
    graph.normals.push_back(normalOf(plane, image));
  }
  smoothNormals(graph);
  measureCreases(graph);
  weighEvidence(patches, graph);
  return graph;
}

}  // namespace hoctomap
