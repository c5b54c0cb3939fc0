// SPDX-License-Identifier: BSD-3-Clause
// `hoctomap merge`: the maps of the two halves of a log against that of the whole, in either order; refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "TableLogs.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/MapTables.h"

namespace hoctomap {
namespace {

/// Occupied voxels of a label in the world, by cells as large as they are.
class VoxelCells {
 public:
  VoxelCells(const std::string& map, const std::string& label) {
    for (const auto& node : test::nodesOf(map, label)) {
      resolution_ = node.record.resolution;
      voxels_.insert(voxels_.end(), node.world_voxels.begin(), node.world_voxels.end());
    }
    for (const auto& voxel : voxels_) cells_[keyOf(voxel)].push_back(voxel);
  }
  /// How many of the other's voxels have one of these beside them: centres within a voxel's diagonal, since a
  /// point of a scan is half of one from the centre of its voxel, in the grid of either node.
  [[nodiscard]] std::size_t countNear(const VoxelCells& other) const {
    return static_cast<std::size_t>(
        std::count_if(other.voxels_.begin(), other.voxels_.end(), [&](const auto& v) { return isNear(v); }));
  }
  [[nodiscard]] std::size_t size() const { return voxels_.size(); }

 private:
  using Key = std::array<int, 3>;
  [[nodiscard]] Key keyOf(const Eigen::Vector3f& p) const {
    const Eigen::Vector3d cell = (p.cast<double>() / resolution_).array().floor();
    return {static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z())};
  }
  [[nodiscard]] bool isNear(const Eigen::Vector3f& p) const {
    const Key at = keyOf(p);
    for (int i = 0; i < 125; ++i) {
      const auto found = cells_.find({at[0] + i % 5 - 2, at[1] + i / 5 % 5 - 2, at[2] + i / 25 - 2});
      if (found == cells_.end()) continue;
      for (const auto& voxel : found->second) {
        if ((voxel - p).cast<double>().norm() <= 1.7321 * resolution_) return true;
      }
    }
    return false;
  }

  double resolution_ = 1.0;
  PointCloud voxels_;
  std::map<Key, PointCloud> cells_;
};

/// Intersection over union within a voxel.
double iouOf(const std::string& a, const std::string& b, const std::string& label) {
  const VoxelCells in_a(a, label);
  const VoxelCells in_b(b, label);
  const auto a_in_b = static_cast<double>(in_b.countNear(in_a));
  const auto b_in_a = static_cast<double>(in_a.countNear(in_b));
  const double common = 0.5 * (a_in_b + b_in_a);
  return common /
         (common + static_cast<double>(in_a.size()) - a_in_b + static_cast<double>(in_b.size()) - b_in_a);
}

/// The demo's six scans as one map and as two.
class Merge : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = std::make_unique<test::TemporaryFolder>();
    test::simulate("demo", *folder / "a.rawlog");
    test::build(*folder / "a.rawlog", *folder / "whole");
    test::build(*folder / "a.rawlog", *folder / "first", {"--max-scans", "3"});
    test::build(*folder / "a.rawlog", *folder / "second", {"--start", "3"});
  }
  static void TearDownTestSuite() { folder.reset(); }
  static test::Outcome merge(const std::vector<std::string>& maps, const std::string& output,
                             const std::vector<std::string>& more = {}, int expected = 0) {
    std::vector<std::string> arguments{"merge"};
    for (const auto& map : maps) arguments.push_back(*folder / map);
    arguments.insert(arguments.end(), {"-o", *folder / output});
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto outcome = test::hoctomap(arguments);
    EXPECT_EQ(outcome.exit_code, expected) << outcome.out << outcome.err;
    if (expected != 0) {
      EXPECT_FALSE(std::filesystem::exists(*folder / output));
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    return outcome;
  }
  static std::unique_ptr<test::TemporaryFolder> folder;
};

std::unique_ptr<test::TemporaryFolder> Merge::folder;

TEST_F(Merge, TheHalvesOfALogAreTheMapOfTheWhole) {
  merge({"first", "second"}, "halves");
  EXPECT_EQ(test::hoctomap({"verify", *folder / "halves"}).exit_code, 0);
  const Manifest manifest = readManifest(*folder / "halves");
  EXPECT_EQ(manifest.mapped_scans, 6U);
  EXPECT_TRUE(manifest.scene);
  for (const char* label : {"background", "table", "object"}) {
    const auto whole = test::nodesOf(*folder / "whole", label);
    const auto merged = test::nodesOf(*folder / "halves", label);
    EXPECT_EQ(whole.size(), merged.size()) << label;
    for (const auto& node : merged) {
      EXPECT_TRUE(
          std::any_of(whole.begin(), whole.end(),
                      [&](const auto& other) { return (other.centroid - node.centroid).norm() < 0.03; }))
          << label << " " << node.centroid.transpose();
    }
    EXPECT_GE(iouOf(*folder / "whole", *folder / "halves", label), 0.98) << label;
  }
  // Every node says which nodes of which maps it is made of.
  std::map<std::string, int> count;
  for (const EventRow& row : readEvents(*folder / "halves", manifest)) {
    EXPECT_NE(row.detail.find(" of map "), std::string::npos) << row.detail;
    ++count[row.event];
  }
  EXPECT_EQ(count["created"], 4) << "table and objects of the first";
  EXPECT_EQ(count["updated"], 6) << "the root twice, and they by the second";
}

TEST_F(Merge, TheOrderOfTheArgumentsDoesNotMatter) {
  merge({"first", "second"}, "ab");
  merge({"second", "first"}, "ba");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder / "ab")) {
    if (!entry.is_regular_file()) continue;
    const auto name = std::filesystem::relative(entry.path(), *folder / "ab").string();
    if (name == ".lock") continue;
    ++files;
    EXPECT_EQ(test::readFile(entry.path()), test::readFile(*folder / "ba/" + name)) << name;
  }
  EXPECT_GE(files, 14U);
}

TEST_F(Merge, ATransformSaysWhereTheSecondWorldStands) {
  merge({"first", "second"}, "far", {"--transform", "10,0,0,90,0,0"});
  const auto objects = test::nodesOf(*folder / "far", "object");
  ASSERT_EQ(objects.size(), 6U) << "nothing meets";
  for (const auto& node : test::nodesOf(*folder / "second", "object")) {
    const Eigen::Vector3d there(10.0 - node.centroid.y(), node.centroid.x(), node.centroid.z());
    EXPECT_TRUE(std::any_of(objects.begin(), objects.end(),
                            [&](const auto& other) { return (other.centroid - there).norm() < 1e-5; }));
  }
  EXPECT_EQ(test::hoctomap({"verify", *folder / "far"}).exit_code, 0);
}

TEST_F(Merge, RefusesWhatDoesNotFit) {
  test::build(*folder / "a.rawlog", *folder / "coarse", {"--set", "label.table.resolution=0.02"});
  const auto outcome = merge({"first", "coarse"}, "no", {}, 2);
  EXPECT_NE(outcome.err.find("[label.table]"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("resolution"), std::string::npos) << outcome.err;
  merge({"first", "first"}, "no", {}, 2);
  merge({"first"}, "no", {}, 2);
  merge({"first", "second"}, "no", {"--transform", "1,2,3"}, 2);
  merge({"first", "nothing"}, "no", {}, 4);
  std::filesystem::copy(*folder / "second", *folder / "damaged", std::filesystem::copy_options::recursive);
  const auto manifest = readManifest(*folder / "damaged");
  test::writeFile(std::filesystem::path(*folder / "damaged") / manifest.nodes.back().ot.path, "no octree");
  merge({"first", "damaged"}, "no", {}, 4);
}

}  // namespace
}  // namespace hoctomap
