// SPDX-License-Identifier: BSD-3-Clause
// The index of nodes says the same as the manifest, only quicker, and nothing depends on it.
#include "hoctomap/io/OpenMap.h"

#include <gtest/gtest.h>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/Sha256.h"
#include "random_map.h"

namespace hoctomap {
namespace {

class OpenMapTest : public ::testing::Test {
 protected:
  OpenMapTest() {
    // Removed nodes and nodes that wait for confirmation are in the index, too.
    const NodeId gone{3};
    const Pose world_T_gone = hierarchy_.world_T_node(gone);
    removed_.push_back({hierarchy_.remove(gone), world_T_gone, 3});
    MapNode& waits = hierarchy_.node(leaf());
    waits.confirmation = {true, false, 1, 2, 30, true};
    MapDirectory writer(map(), test::mapOptions(MapOpenMode::create));
    writer.commit({hierarchy_, removed_, 5});
    manifest_ = readManifest(map());
  }
  [[nodiscard]] NodeId leaf() const {
    for (const NodeId id : hierarchy_.ids()) {
      if (id != kRootId && hierarchy_.node(id).children().empty()) return id;
    }
    throw std::logic_error("a tree has leaves");
  }
  [[nodiscard]] std::filesystem::path map() const { return folder_.path() / "map"; }
  [[nodiscard]] std::string yaml() const { return test::readText(map() / "hierarchy.yaml"); }
  [[nodiscard]] std::filesystem::path indexFile() const { return map() / manifest_.index->path; }

  /// An opened map has the nodes of `expected`, place by place and voxel by voxel.
  void expectSame(const StoredMap& expected) const {
    const OpenMap open(map());
    const HierarchyNodes nodes(expected.hierarchy);
    ASSERT_EQ(open.places().size(), nodes.places().size());
    for (std::size_t i = 0; i < nodes.places().size(); ++i) {
      const NodePlace& a = nodes.places()[i];
      const NodePlace& b = open.places()[i];
      EXPECT_EQ(a.id, b.id);
      EXPECT_EQ(a.depth, b.depth);
      EXPECT_EQ(a.resolution, b.resolution);
      EXPECT_EQ(a.existence, b.existence);
      EXPECT_EQ(a.world_T_node.matrix(), b.world_T_node.matrix());
      EXPECT_EQ(a.extent.known.min(), b.extent.known.min());
      EXPECT_EQ(a.extent.known.max(), b.extent.known.max());
      EXPECT_EQ(a.extent.occupied.min(), b.extent.occupied.min());
      EXPECT_EQ(a.extent.occupied.max(), b.extent.occupied.max());
      EXPECT_EQ(a.extent.voxels.occupied, b.extent.voxels.occupied);
      EXPECT_EQ(nodes.label(i), open.label(i));
      EXPECT_TRUE(nodes.map(i)->tree() == open.map(i)->tree());
    }
  }

  test::Rng rng_{23};
  test::TemporaryFolder folder_;
  MapHierarchy hierarchy_ = test::randomHierarchy(rng_, 12);
  std::vector<RemovedNode> removed_;
  Manifest manifest_;
};

TEST_F(OpenMapTest, TheIndexSaysWhatTheManifestSays) {
  ASSERT_TRUE(manifest_.index);
  ASSERT_FALSE(manifest_.removed.empty());
  ASSERT_FALSE(manifest_.waiting.empty());
  EXPECT_EQ(toYaml(manifest_), yaml()) << "read by the index";
  EXPECT_EQ(toYaml(parseManifest(yaml(), "m")), yaml()) << "read by a YAML parser";
  expectSame(readMap(map()));
  for (const NodeRecord& node : manifest_.nodes) EXPECT_EQ(findNode(map(), node.id).node->ot, node.ot);
  EXPECT_FALSE(findNode(map(), NodeId{3}).node);
  EXPECT_TRUE(checkMap(map()).damage.empty());
}

TEST_F(OpenMapTest, NothingDependsOnTheIndex) {
  std::string damaged = test::readText(indexFile());
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  test::writeText(indexFile(), damaged);
  EXPECT_EQ(toYaml(readManifest(map())), yaml());
  expectSame(readMap(map()));
  ASSERT_EQ(checkMap(map()).damage.size(), 1U);
  EXPECT_EQ(checkMap(map()).damage.front().path, manifest_.index->path);
  std::filesystem::remove(indexFile());
  EXPECT_EQ(toYaml(readManifest(map())), yaml());
  expectSame(readMap(map()));
}

TEST_F(OpenMapTest, AManifestOfOtherNodesIsReadItself) {
  manifest_.nodes.back().label.name = "renamed";
  test::writeText(map() / "hierarchy.yaml", toYaml(manifest_));
  EXPECT_EQ(toYaml(readManifest(map())), yaml());
  EXPECT_EQ(findNode(map(), manifest_.nodes.back().id).node->label.name, "renamed");
  expectSame(readMap(map()));
  ASSERT_EQ(checkMap(map()).damage.size(), 1U);
  EXPECT_NE(checkMap(map()).damage.front().what.find("not the index of this manifest"), std::string::npos);
}

/// What lies about the nodes with a right hash is found by `verify`.
TEST_F(OpenMapTest, AnIndexThatLiesIsFound) {
  std::string bytes = test::readText(indexFile());
  const std::string from = manifest_.nodes.back().label.name;
  const auto at = bytes.rfind(from);
  ASSERT_NE(at, std::string::npos);
  bytes[at] = 'X';
  test::writeText(indexFile(), bytes);
  manifest_.index->sha256 = sha256Hex(bytes);
  test::writeText(map() / "hierarchy.yaml", toYaml(manifest_));
  ASSERT_EQ(checkMap(map()).damage.size(), 1U);
  EXPECT_NE(checkMap(map()).damage.front().what.find("something else than the manifest"), std::string::npos);
}

TEST_F(OpenMapTest, OctreesAreReadAndCheckedWhenTheyAreAskedFor) {
  const NodeRecord& damaged = manifest_.nodes.back();
  test::writeText(map() / damaged.ot.path, "no octree");
  const OpenMap open(map());
  for (std::size_t i = 0; i < open.places().size(); ++i) {
    if (open.places()[i].id == damaged.id) {
      EXPECT_THROW(static_cast<void>(open.map(i)), MapError);
    } else {
      EXPECT_GT(open.map(i)->tree().size(), 0U);
    }
  }
}

/// Every cut and many flips of an index that the manifest vouches for: an answer or a fallback, no crash.
TEST_F(OpenMapTest, HostileIndexesAreLeftAlone) {
  const std::string whole = test::readText(indexFile());
  for (int trial = 0; trial < 300; ++trial) {
    std::string bytes = whole;
    const auto at = std::uniform_int_distribution<std::size_t>(0, bytes.size() - 1)(rng_);
    if (trial % 3 == 0) bytes.resize(at);
    if (trial % 3 != 0) bytes[at] = static_cast<char>(rng_());
    test::writeText(indexFile(), bytes);
    manifest_.index->bytes = bytes.size();
    manifest_.index->sha256 = sha256Hex(bytes);
    test::writeText(map() / "hierarchy.yaml", toYaml(manifest_));
    try {
      EXPECT_EQ(readManifest(map()).nodes.size(), manifest_.nodes.size());
      const OpenMap open(map());
      for (std::size_t i = 0; i < open.places().size(); ++i) static_cast<void>(open.map(i));
    } catch (const MapError&) {
      continue;
    } catch (const LimitError&) {
      continue;
    }
  }
}

TEST_F(OpenMapTest, KeptStatesHaveTheirOwnIndex) {
  {
    MapDirectory writer(map(), test::mapOptions(MapOpenMode::resume));
    test::changeNode(rng_, hierarchy_, NodeId{1}, 6);
    hierarchy_.node(leaf()).confirmation = {};
    MapState state{hierarchy_, {}, 7};  // what was removed before is known from the manifest
    state.keep = true;
    writer.commit(state);
    test::changeNode(rng_, hierarchy_, NodeId{1}, 9);
    writer.commit({hierarchy_, {}, 10});
  }
  EXPECT_TRUE(checkMap(map()).damage.empty());
  const OpenMap now(map());
  const OpenMap then(map(), 6);
  EXPECT_EQ(now.scans(), 10U);
  EXPECT_EQ(then.scans(), 7U);
  EXPECT_TRUE(now.map(1)->tree() == hierarchy_.node(NodeId{1}).map().tree());
  EXPECT_FALSE(then.map(1)->tree() == hierarchy_.node(NodeId{1}).map().tree());
}

}  // namespace
}  // namespace hoctomap
