// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/opengl/COctoMapVoxels.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CText3D.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/mrpt_io/RenderMap.h"
#include "hoctomap/mrpt_io/SceneFile.h"

namespace hoctomap {
namespace {

NodeMap block(double resolution, int voxels) {
  auto tree = std::make_unique<octomap::OcTree>(resolution);
  for (int x = 0; x < voxels; ++x) {
    for (int y = 0; y < voxels; ++y) {
      tree->updateNode(
          octomap::point3d(static_cast<float>((x + 0.5) * resolution),
                           static_cast<float>((y + 0.5) * resolution), static_cast<float>(0.5 * resolution)),
          true);
    }
  }
  tree->prune();
  return {std::move(tree), {}};
}

MapHierarchy smallMap() {
  MapHierarchy hierarchy(labels::background, block(0.05, 60));
  const NodeId table =
      hierarchy.add(labels::table, block(0.01, 100), Pose(1.0, 1.0, 0.75, 0.3, 0.0, 0.0), kRootId);
  hierarchy.add(labels::object, block(0.002, 50), Pose(1.3, 1.6, 0.78, 0.0, 0.4, 0.0), table);
  return hierarchy;
}

class SceneTest : public ::testing::Test {
 protected:
  SceneTest() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("hoctomap-scene-") + info->name() + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~SceneTest() override { std::filesystem::remove_all(folder_); }

  static std::string bytesOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return std::move(text).str();
  }

  std::filesystem::path folder_;
};

TEST_F(SceneTest, StockReadsTheTree) {
  const MapHierarchy map = smallMap();
  const auto file = folder_ / "hierarchy.3Dscene";
  writeSceneFile(map, file);
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(file.string()));
  const auto root =
      std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(scene.getByName("node 0 background"));
  ASSERT_NE(root, nullptr);
  const auto table = std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(root->getByName("node 1 table"));
  ASSERT_NE(table, nullptr);
  const auto object =
      std::dynamic_pointer_cast<mrpt::opengl::CSetOfObjects>(table->getByName("node 2 object"));
  ASSERT_NE(object, nullptr);
  EXPECT_LT(
      (Pose(object->getPose()).asVectorVal() - map.node(NodeId{2}).parent_T_node().asVectorVal()).norm(),
      1e-6);  // scenes hold floats
  const auto voxels = object->getByClass<mrpt::opengl::COctoMapVoxels>();
  ASSERT_NE(voxels, nullptr);
  EXPECT_EQ(voxels->getVoxelCount(0), map.node(NodeId{2}).map().tree().getNumLeafNodes());
  EXPECT_EQ(object->getByClass<mrpt::opengl::CText3D>()->getString(), "2 object 0.50");
}

TEST_F(SceneTest, SameMapSameBytes) {
  writeSceneFile(smallMap(), folder_ / "a.3Dscene");
  writeSceneFile(smallMap(), folder_ / "b.3Dscene");
  EXPECT_EQ(bytesOf(folder_ / "a.3Dscene"), bytesOf(folder_ / "b.3Dscene"));
}

TEST_F(SceneTest, FolderThatIsNotThere) {
  EXPECT_THROW(writeSceneFile(smallMap(), folder_ / "no" / "a.3Dscene"), FileError);
}

struct Colours {
  std::size_t cyan = 0;
  std::size_t magenta = 0;
  std::size_t yellow = 0;
};

Colours coloursOf(const std::filesystem::path& file) {
  mrpt::img::CImage image;
  EXPECT_TRUE(image.loadFromFile(file.string()));
  EXPECT_EQ(image.getWidth(), 400U);
  EXPECT_EQ(image.getHeight(), 300U);
  Colours colours;
  auto& [cyan, magenta, yellow] = colours;
  for (unsigned row = 0; row < 300; ++row) {
    const auto* line = image.ptrLine<std::uint8_t>(row);
    for (unsigned column = 0; column < 400; ++column) {
      const int b = line[3 * column];
      const int g = line[3 * column + 1];
      const int r = line[3 * column + 2];
      if (g > r + 40 && b > r + 40) ++cyan;
      if (r > g + 40 && b > g + 40) ++magenta;
      if (r > b + 40 && g > b + 40) ++yellow;
    }
  }
  return colours;
}

TEST_F(SceneTest, PictureShowsAllThreeColours) {
  const auto file = folder_ / "map.png";
  renderMap(smallMap(), {400, 300, "oblique"}, file);
  const Colours colours = coloursOf(file);
  EXPECT_GT(colours.cyan, 100U);
  EXPECT_GT(colours.magenta, 5000U);
  EXPECT_GT(colours.yellow, 1000U);
}

TEST_F(SceneTest, LabelsCanBeHidden) {
  const auto file = folder_ / "map.png";
  RenderOptions options{400, 300, "oblique"};
  options.hidden = {labels::background, Label{"none_has_it"}};
  renderMap(smallMap(), options, file);
  EXPECT_GT(coloursOf(file).cyan, 100U);
  EXPECT_GT(coloursOf(file).magenta, 5000U);
  EXPECT_EQ(coloursOf(file).yellow, 0U);
  options.hidden = {labels::background, labels::table, labels::object};
  EXPECT_NO_THROW(renderMap(smallMap(), options, file));
}

TEST_F(SceneTest, OptionsAreChecked) {
  EXPECT_THROW(renderMap(smallMap(), {0, 300, "oblique"}, folder_ / "x.png"), ConfigError);
  EXPECT_THROW(renderMap(smallMap(), {400, 300, "sideways"}, folder_ / "x.png"), ConfigError);
  for (const std::string view : {"150", "150,", "150;25", "150,25m", "150,95", "nan,25"}) {
    EXPECT_THROW(renderMap(smallMap(), {400, 300, view}, folder_ / "x.png"), ConfigError) << view;
  }
  EXPECT_NO_THROW(renderMap(smallMap(), {400, 300, "-150,25.5"}, folder_ / "x.png"));
}

}  // namespace
}  // namespace hoctomap
