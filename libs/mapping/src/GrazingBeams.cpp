// SPDX-License-Identifier: BSD-3-Clause
#include "GrazingBeams.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hoctomap/geometry/SurfaceNormals.h"

namespace hoctomap {

namespace {

// A normal is taken over three cells. Cells of 1 cm hold some ten points of a depth camera as far away as its
// noise lets objects be told apart.
constexpr double kLeastCell = 0.01;
constexpr double kCellVoxels = 3.0;
// cos a: flatter beams (3 degrees) are held to be errors of the normal.
constexpr double kFlattest = 0.05;

}  // namespace

OwnBeams spareSurface(const PointCloud& points, const Eigen::Vector3f& origin, double resolution,
                      double max_range) {
  const double diagonal = std::numbers::sqrt3 * resolution;
  const PointCloud normals = surfaceNormals(points, std::max(kLeastCell, kCellVoxels * resolution));
  OwnBeams beams;
  beams.hits.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d beam = (points[i] - origin).cast<double>();
    const double length = beam.norm();
    const double slope = std::abs(beam.dot(normals[i].cast<double>())) / length;  // cos a; NaN: no length
    const bool has_normal = !normals[i].isZero();
    const double spared = has_normal ? diagonal * (1.0 / std::max(slope, kFlattest) - 1.0) : 0.0;
    // Less than half a voxel is not worth a beam of its own kind.
    if (!(spared > 0.5 * resolution) || (max_range >= 0.0 && length > max_range)) {
      beams.hits.push_back(points[i]);
      continue;
    }
    beams.endpoints.push_back(points[i]);
    beams.cleared.push_back(origin + ((1.0 - std::min(spared / length, 1.0)) * beam).cast<float>());
  }
  return beams;
}

}  // namespace hoctomap
