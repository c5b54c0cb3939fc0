// SPDX-License-Identifier: BSD-3-Clause
// `verify`: every damaged file is named, whatever state of the map it belongs to.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/Sha256.h"
#include "random_map.h"

namespace hoctomap {
namespace {

class MapCheckTest : public ::testing::Test {
 protected:
  MapCheckTest() {
    MapDirectory writer(map(), test::mapOptions(MapOpenMode::create));
    writer.commit({test::randomHierarchy(rng_, 3), {}, 5});
  }
  [[nodiscard]] std::filesystem::path map() const { return folder_.path() / "map"; }
  [[nodiscard]] static std::vector<std::string> paths(const MapCheck& check) {
    std::vector<std::string> names;
    for (const Damage& d : check.damage) names.push_back(d.path);
    std::sort(names.begin(), names.end());
    return names;
  }
  void flipLastByte(const std::string& path) const {
    std::string bytes = test::readText(map() / path);
    bytes.back() = static_cast<char>(bytes.back() ^ 1);
    test::writeText(map() / path, bytes);
  }

  test::Rng rng_{7};
  test::TemporaryFolder folder_;
};

TEST_F(MapCheckTest, AWholeMap) {
  const MapCheck check = checkMap(map());
  EXPECT_TRUE(check.damage.empty());
  EXPECT_TRUE(check.foreign.empty());
  const Manifest manifest = readManifest(map());
  EXPECT_EQ(check.nodes, manifest.nodes.size());
  EXPECT_EQ(check.files, manifest.files().size());
  std::uint64_t bytes = 0;
  for (const FileRecord& file : manifest.files()) bytes += file.bytes;
  EXPECT_EQ(check.bytes, bytes);
}

TEST_F(MapCheckTest, EveryDamagedFileIsNamed) {
  const Manifest manifest = readManifest(map());
  flipLastByte(manifest.nodes[1].ot.path);
  flipLastByte(manifest.nodes[2].bt.path);
  std::filesystem::remove(map() / manifest.config.path);
  std::vector<std::string> expected{manifest.nodes[1].ot.path, manifest.nodes[2].bt.path,
                                    manifest.config.path};
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(paths(checkMap(map())), expected);
}

/// Size and hash are right, the voxels are not those that the manifest counts.
TEST_F(MapCheckTest, AnOctreeThatIsNotTheOneDescribed) {
  Manifest manifest = readManifest(map());
  ++manifest.nodes[1].voxels.free;
  ++manifest.nodes[2].voxels.occupied;
  test::writeText(map() / "hierarchy.yaml", toYaml(manifest));
  const MapCheck check = checkMap(map());
  // The index still says what the manifest said before.
  ASSERT_EQ(paths(check), (std::vector<std::string>{manifest.nodes[1].ot.path, manifest.nodes[2].ot.path,
                                                    manifest.index->path}));
  EXPECT_NE(check.damage.back().what.find("free voxels"), std::string::npos);
}

TEST_F(MapCheckTest, ADamagedManifestIsItselfTheDamage) {
  test::writeText(map() / "hierarchy.yaml", "format_version: 1\nnodes: []\n");
  EXPECT_EQ(paths(checkMap(map())), std::vector<std::string>{"hierarchy.yaml"});
}

TEST_F(MapCheckTest, ForeignFilesAreListedAndLeftAlone) {
  test::writeText(map() / "notes.txt", "mine");
  test::writeText(map() / "nodes" / "notes.ot", "mine");
  const MapCheck check = checkMap(map());
  EXPECT_TRUE(check.damage.empty());
  EXPECT_EQ(check.foreign, (std::vector<std::string>{"notes.txt", "nodes/notes.ot"}));
  EXPECT_TRUE(std::filesystem::exists(map() / "notes.txt"));
}

/// Names that are nearly ours.
TEST_F(MapCheckTest, WhatIsCalledLikeAFileOfAMapIsForeign) {
  const std::vector<std::string> names{"hierarchy-.yaml", "hierarchy-000012.yml", "hierarchy-12.yaml",
                                       "seams-.csv",      "seams-000001.txt",     "seams-csv"};
  for (const std::string& name : names) test::writeText(map() / name, "mine");
  EXPECT_EQ(checkMap(map()).foreign, names);
}

TEST_F(MapCheckTest, NoMap) {
  EXPECT_THROW(static_cast<void>(checkMap(folder_.path() / "nothing")), MapError);
}

}  // namespace
}  // namespace hoctomap
