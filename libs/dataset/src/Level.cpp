// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/dataset/Level.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/geometry/SurfaceNormals.h"

namespace hoctomap {

namespace {

constexpr std::size_t kFrames = 12;
constexpr double kCell = 0.05;          // m: surface counts by area, not by points
constexpr double kSameDirection = 8.0;  // degrees, between normals of one structure
constexpr double kThickness = 0.05;     // m, of a structure across its plane
constexpr double kTilt = 60.0;          // degrees: how far a camera looks up or down at most
constexpr double kRoll = 25.0;          // degrees: how far it is rolled at most
constexpr std::size_t kCandidates = 400;

double cosine(double degrees) {
  return std::cos(degrees * M_PI / 180.0);
}

/// A piece of surface of one cell, with its normal towards the sensor.
struct Patch {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
  bool may_be_level = true;  ///< as far as the sensor's attitude tells
};

bool mayBeUp(const Eigen::Vector3d& normal, const Eigen::Matrix3d& world_R_camera) {
  const Eigen::Vector3d right = -world_R_camera.col(1);
  const Eigen::Vector3d up = world_R_camera.col(2);
  return normal.dot(up) > cosine(kTilt) && std::abs(normal.dot(right)) < cosine(90.0 - kRoll);
}

/// One point a cell, so that near surfaces do not outweigh far ones.
PointCloud thinned(const PointCloud& points) {
  std::map<std::array<int, 3>, Eigen::Vector3f> cells;
  for (const Eigen::Vector3f& p : points) {
    const auto cell = [&](int axis) { return static_cast<int>(std::floor(p[axis] / (0.5 * kCell))); };
    cells.try_emplace({cell(0), cell(1), cell(2)}, p);
  }
  PointCloud result;
  for (const auto& [cell, point] : cells) result.push_back(point);
  return result;
}

void addPatches(const Dataset::Frame& frame, std::vector<Patch>& patches) {
  const auto* depth = std::get_if<DepthScan>(&frame);
  const RangeLimits limits;
  const Measurement z = depth != nullptr
                            ? unproject(depth->image, depth->world_T_sensor, limits)
                            : fromSensorPoints(std::get<CloudScan>(frame).sensor_points,
                                               std::get<CloudScan>(frame).world_T_sensor, limits);
  const PointCloud points = thinned(z.world_points);
  const PointCloud normals = surfaceNormals(points, kCell);
  const Eigen::Matrix3d attitude = toIsometry(z.world_T_sensor).linear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (normals[i].isZero()) continue;
    Patch patch{points[i].cast<double>(), normals[i].cast<double>(), true};
    if (patch.normal.dot(z.origin() - patch.point) < 0.0) patch.normal = -patch.normal;
    patch.may_be_level = depth == nullptr || mayBeUp(patch.normal, attitude);
    patches.push_back(patch);
  }
}

/// The normal that most patches share, among those that may be up.
Eigen::Vector3d commonNormal(const std::vector<Patch>& patches) {
  const double same = cosine(kSameDirection);
  std::vector<const Patch*> possible;
  for (const Patch& patch : patches) {
    if (patch.may_be_level) possible.push_back(&patch);
  }
  if (possible.empty()) throw InputError("--level: nothing was seen that may be level; give --up");
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  std::size_t most = 0;
  const std::size_t step = std::max<std::size_t>(1, possible.size() / kCandidates);
  for (std::size_t i = 0; i < possible.size(); i += step) {
    const Eigen::Vector3d& n = possible[i]->normal;
    const auto votes = static_cast<std::size_t>(std::count_if(
        possible.begin(), possible.end(), [&](const Patch* p) { return p->normal.dot(n) > same; }));
    if (votes > most) {
      most = votes;
      best = n;
    }
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Patch* p : possible) {
    if (p->normal.dot(best) > same) sum += p->normal;
  }
  return sum.normalized();
}

/// The patches of the fullest layer across `up`.
std::vector<const Patch*> largestLayer(const std::vector<Patch>& patches, const Eigen::Vector3d& up) {
  std::map<int, std::size_t> layers;
  const auto facing = [&](const Patch& p) { return p.normal.dot(up) > cosine(kSameDirection); };
  const auto layerOf = [&](const Patch& p) {
    return static_cast<int>(std::floor(p.point.dot(up) / (0.5 * kThickness)));
  };
  for (const Patch& patch : patches) {
    if (facing(patch)) ++layers[layerOf(patch)];
  }
  // Two neighbouring layers: a structure may lie across their border.
  int fullest = 0;
  std::size_t most = 0;
  for (const auto& [layer, count] : layers) {
    const auto next = layers.find(layer + 1);
    const std::size_t both = count + (next == layers.end() ? 0 : next->second);
    if (both > most) {
      most = both;
      fullest = layer;
    }
  }
  std::vector<const Patch*> chosen;
  for (const Patch& patch : patches) {
    if (facing(patch) && (layerOf(patch) == fullest || layerOf(patch) == fullest + 1))
      chosen.push_back(&patch);
  }
  return chosen;
}

Eigen::Vector3d centroidOf(const std::vector<const Patch*>& patches) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Patch* p : patches) sum += p->point;
  return sum / static_cast<double>(patches.size());
}

/// Normal of the plane through a layer, on the side of `up`.
Eigen::Vector3d planeNormal(const std::vector<const Patch*>& layer, const Eigen::Vector3d& up) {
  const Eigen::Vector3d center = centroidOf(layer);
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Patch* p : layer) scatter += (p->point - center) * (p->point - center).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return normal.dot(up) < 0.0 ? Eigen::Vector3d(-normal) : normal;
}

double areaOf(const std::vector<const Patch*>& layer, const Eigen::Matrix3d& level_R_world) {
  std::map<std::array<int, 2>, bool> cells;
  for (const Patch* p : layer) {
    const Eigen::Vector3d level = level_R_world * p->point;
    cells[{static_cast<int>(std::floor(level.x() / kCell)),
           static_cast<int>(std::floor(level.y() / kCell))}] = true;
  }
  return kCell * kCell * static_cast<double>(cells.size());
}

}  // namespace

LargestLevel largestLevel(Dataset& dataset) {
  std::vector<Patch> patches;
  const std::size_t frames = std::min(kFrames, dataset.size());
  for (std::size_t k = 0; k < frames; ++k) {
    // In the middles of equal shares of the data set.
    if (const auto frame = dataset.frame((2 * k + 1) * dataset.size() / (2 * frames)))
      addPatches(*frame, patches);
  }
  Eigen::Vector3d up = commonNormal(patches);
  std::vector<const Patch*> layer;
  for (int round = 0; round < 3; ++round) {  // the better the direction, the sharper the layers
    layer = largestLayer(patches, up);
    if (layer.size() < 3) throw InputError("--level: nothing was seen that may be level; give --up");
    up = planeNormal(layer, up);
  }
  LargestLevel level;
  level.level_T_world = levelled(up);
  const Eigen::Matrix3d rotation = toIsometry(level.level_T_world).linear();
  level.height = (rotation * centroidOf(layer)).z();
  level.area = areaOf(layer, rotation);
  return level;
}

}  // namespace hoctomap
