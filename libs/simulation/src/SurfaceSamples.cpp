// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceSamples.h"

#include <cmath>

namespace hoctomap {

std::vector<SurfaceSample> sampleSurface(const TriangleMesh& mesh, const Eigen::Isometry3d& world_T_mesh,
                                         double spacing) {
  // Additive recurrence with the plastic number (Roberts 2018): even in the plane, for any number of points.
  constexpr double kPlastic = 1.32471795724474602596;
  const Eigen::Vector2d step(1.0 / kPlastic, 1.0 / (kPlastic * kPlastic));
  std::vector<SurfaceSample> samples;
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = world_T_mesh * mesh.vertices[t[0]].cast<double>();
    const Eigen::Vector3d ab = world_T_mesh * mesh.vertices[t[1]].cast<double>() - a;
    const Eigen::Vector3d ac = world_T_mesh * mesh.vertices[t[2]].cast<double>() - a;
    const Eigen::Vector3d cross = ab.cross(ac);
    area += 0.5 * cross.norm();
    // Slivers are smaller than what a sample stands for: areas add up from triangle to triangle.
    while ((static_cast<double>(samples.size()) + 0.5) * spacing * spacing < area) {
      const Eigen::Vector2d u = (static_cast<double>(samples.size() + 1) * step).unaryExpr([](double x) {
        return x - std::floor(x);
      });
      const bool beyond = u.x() + u.y() > 1.0;
      const double s = beyond ? 1.0 - u.x() : u.x();
      const double r = beyond ? 1.0 - u.y() : u.y();
      samples.push_back({a + s * ab + r * ac, cross.normalized()});
    }
  }
  return samples;
}

}  // namespace hoctomap
