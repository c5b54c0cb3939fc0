// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/simulation/MeshFile.h"

namespace hoctomap::test {
namespace {

class MeshTest : public testing::Test {
 protected:
  MeshTest() {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::path(testing::TempDir()) / ("hoctomap_mesh_" + name);
    std::filesystem::create_directories(folder_);
  }
  ~MeshTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  std::filesystem::path folder_;
};

// A tetrahedron of volume 1/6; its largest face has the area sqrt(3)/2, the others 1/2.
constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST_F(MeshTest, ReadsTrianglesAndScales) {
  const auto file = write("t.obj", kTetrahedron);
  const TriangleMesh mesh = loadMesh(file, 1.0);
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_NEAR(surfaceArea(mesh), 1.5 + std::sqrt(3.0) / 2.0, 1e-6);
  EXPECT_NEAR(surfaceArea(loadMesh(file, 0.1)), 0.01 * surfaceArea(mesh), 1e-7);
}

TEST_F(MeshTest, PolygonsBecomeTriangles) {
  const auto file = write("q.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const TriangleMesh mesh = loadMesh(file, 1.0);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_NEAR(surfaceArea(mesh), 1.0, 1e-6);
}

TEST_F(MeshTest, FilesThatAreNoMeshAreRefusedByName) {
  const auto expectRefused = [](const std::filesystem::path& file) {
    try {
      (void)loadMesh(file, 1.0);
      FAIL() << file;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(file.filename().string()), std::string::npos);
    }
  };
  expectRefused(folder_ / "missing.obj");
  expectRefused(folder_);
  expectRefused(write("text.obj", "no mesh at all\n"));
  expectRefused(write("points.obj", "v 0 0 0\nv 1 0 0\n"));
  expectRefused(write("empty.stl", ""));
}

}  // namespace
}  // namespace hoctomap::test
