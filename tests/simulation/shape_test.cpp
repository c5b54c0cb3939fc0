// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/Shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "SmallScenes.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap::test {
namespace {

using std::numbers::pi;

/// Signed volume enclosed by the surface: positive if all triangles face outwards.
double enclosedVolume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]].cast<double>();
    volume += a.dot(mesh.vertices[t[1]].cast<double>().cross(mesh.vertices[t[2]].cast<double>())) / 6.0;
  }
  return volume;
}

/// Every edge is used by two triangles, once in each direction.
bool isClosed(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (unsigned i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  for (const auto& [edge, count] : uses)
    if (count != 1 || !uses.contains({edge.second, edge.first})) return false;
  return true;
}

TurnedShape cup(double wall) {
  return {{{0.03, 0.0}, {0.05, 0.1}}, wall, std::nullopt};
}

double coneFrustum(double r1, double r2, double h) {
  return pi * h * (r1 * r1 + r1 * r2 + r2 * r2) / 3.0;
}

void expectVolume(const Shape& shape, double expected) {
  EXPECT_NEAR(enclosedVolume(tessellate(shape)), expected, 1e-3 * expected);
}

TEST(Shape, VolumesAreThoseOfTheBooks) {
  expectVolume(BoxShape{{0.1, 0.2, 0.3}}, 0.006);
  expectVolume(CylinderShape{0.1, 0.3}, pi * 0.003);
  expectVolume(SphereShape{0.1}, 4.0 / 3.0 * pi * 0.001);
  const double solid = coneFrustum(0.03, 0.05, 0.1);
  expectVolume(cup(0.0), solid);
  // The hollow: from the wall's thickness above the ground to the rim.
  const double hollow = coneFrustum(0.03 + 0.02 * 0.04 - 0.004, 0.05 - 0.004, 0.1 - 0.004);
  expectVolume(cup(0.004), solid - hollow);
}

TEST(Shape, SurfacesAreClosed) {
  EXPECT_TRUE(isClosed(tessellate(BoxShape{})));
  EXPECT_TRUE(isClosed(tessellate(CylinderShape{})));
  EXPECT_TRUE(isClosed(tessellate(SphereShape{})));
  EXPECT_TRUE(isClosed(tessellate(cup(0.0))));
  EXPECT_TRUE(isClosed(tessellate(cup(0.004))));
}

TEST(Shape, AreaAndCentroidOfASphere) {
  const TriangleMesh sphere = tessellate(SphereShape{0.2});
  EXPECT_NEAR(surfaceArea(sphere), 4.0 * pi * 0.04, 1e-4);
  const SurfaceExtent extent = surfaceExtent(sphere, toIsometry(at(1, 2, 3)));
  EXPECT_LT((extent.centroid - Eigen::Vector3d(1, 2, 3.2)).norm(), 1e-5);
  EXPECT_LT((extent.box.center() - Eigen::Vector3d(1, 2, 3.2)).norm(), 1e-4);
  EXPECT_LT((0.5 * extent.box.sizes() - Eigen::Vector3d::Constant(0.2)).norm(), 1e-4);
}

TEST(Shape, EveryShapeStandsOnItsOrigin) {
  const std::vector<Shape> shapes{BoxShape{}, CylinderShape{}, SphereShape{}, cup(0.003), TableShape{}};
  for (const Shape& shape : shapes) {
    const auto box = surfaceExtent(tessellate(shape), Eigen::Isometry3d::Identity()).box;
    EXPECT_NEAR(box.min().z(), 0.0, 1e-7);
    EXPECT_NEAR(box.center().x(), 0.0, 1e-5);
    EXPECT_NEAR(box.center().y(), 0.0, 1e-5);
  }
}

TEST(Shape, AHandleStandsOffTheWallAndNotInside) {
  TurnedShape mug{{{0.04, 0.0}, {0.04, 0.1}}, 0.004, Handle{0.02, 0.08, 0.03, 0.005}};
  const TriangleMesh with = tessellate(mug);
  mug.handle.reset();
  const TriangleMesh without = tessellate(mug);
  EXPECT_NEAR(surfaceExtent(with, Eigen::Isometry3d::Identity()).box.max().x(), 0.04 + 0.03 + 0.005, 1e-4);
  // A point of the tube inside the mug would show on its inner wall.
  for (std::size_t i = without.vertices.size(); i < with.vertices.size(); ++i)
    EXPECT_GT(with.vertices[i].head<2>().norm(), 0.036F);
}

TEST(Shape, SizesThatMakeNoSenseAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)tessellate(BoxShape{{0.1, 0.0, 0.1}}), ConfigError);
  EXPECT_THROW((void)tessellate(SphereShape{nan}), ConfigError);
  EXPECT_THROW((void)tessellate(CylinderShape{0.1, -1.0}), ConfigError);
  EXPECT_THROW((void)tessellate(TableShape{{1, 1}, 0.02, 0.03, 0.05}), ConfigError);
  EXPECT_THROW((void)tessellate(TurnedShape{{{0.1, 0.0}}, 0.0, std::nullopt}), ConfigError);
  EXPECT_THROW((void)tessellate(TurnedShape{{{0.1, 0.1}, {0.1, 0.0}}, 0.0, std::nullopt}), ConfigError);
  EXPECT_THROW((void)tessellate(cup(0.05)), ConfigError);
  EXPECT_THROW((void)tessellate(cup(0.2)), ConfigError);
  TurnedShape mug = cup(0.003);
  mug.handle = Handle{0.05, 0.2, 0.03, 0.005};
  EXPECT_THROW((void)tessellate(mug), ConfigError);
}

}  // namespace
}  // namespace hoctomap::test
