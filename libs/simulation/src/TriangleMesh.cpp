// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/TriangleMesh.h"

namespace hoctomap {
namespace {

struct Corners {
  Eigen::Vector3d a, b, c;

  [[nodiscard]] double area() const { return 0.5 * (b - a).cross(c - a).norm(); }
  [[nodiscard]] Eigen::Vector3d centre() const { return (a + b + c) / 3.0; }
};

Corners corners(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return {mesh.vertices[t[0]].cast<double>(), mesh.vertices[t[1]].cast<double>(),
          mesh.vertices[t[2]].cast<double>()};
}

}  // namespace

void TriangleMesh::append(const TriangleMesh& other, const Eigen::Isometry3d& this_T_other) {
  const auto offset = static_cast<std::uint32_t>(vertices.size());
  for (const auto& v : other.vertices) vertices.emplace_back((this_T_other * v.cast<double>()).cast<float>());
  for (const auto& t : other.triangles) triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

SurfaceExtent surfaceExtent(const TriangleMesh& mesh, const Eigen::Isometry3d& world_T_mesh) {
  SurfaceExtent extent;
  for (const auto& v : mesh.vertices) extent.box.extend(world_T_mesh * v.cast<double>());

  double area = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const auto& t : mesh.triangles) {
    const Corners triangle = corners(mesh, t);
    area += triangle.area();
    moment += triangle.area() * triangle.centre();
  }
  if (area > 0.0) extent.centroid = world_T_mesh * Eigen::Vector3d(moment / area);
  return extent;
}

double surfaceArea(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const auto& t : mesh.triangles) area += corners(mesh, t).area();
  return area;
}

}  // namespace hoctomap
