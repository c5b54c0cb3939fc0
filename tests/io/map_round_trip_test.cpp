// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <locale>
#include <sstream>

#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/OctreeFile.h"
#include "random_map.h"

namespace hoctomap {
namespace {

using test::contents;
using test::mapOptions;
using test::TemporaryFolder;

double largestDifference(const Pose& a, const Pose& b) {
  return (a.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen() -
          b.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen())
      .cwiseAbs()
      .maxCoeff();
}

class MapRoundTrip : public ::testing::Test {
 protected:
  void write(const MapHierarchy& hierarchy, const std::vector<RemovedNode>& removed, const char* name) const {
    MapDirectory writer(folder_.path() / name, mapOptions(MapOpenMode::create));
    writer.append(test::reportOf(hierarchy, kRootId, 3));
    writer.commit({hierarchy, removed, 4, "a log"});
  }
  [[nodiscard]] std::filesystem::path map(const char* name = "map") const { return folder_.path() / name; }

  test::Rng rng_{11};
  TemporaryFolder folder_;
  MapHierarchy hierarchy_ = test::randomHierarchy(rng_, 12);
};

TEST_F(MapRoundTrip, EverythingComesBack) {
  write(hierarchy_, {}, "map");
  const StoredMap back = readMap(map());
  EXPECT_EQ(back.manifest.scans, 4U);
  EXPECT_EQ(back.manifest.input, "a log");
  EXPECT_EQ(back.hierarchy.nextId(), hierarchy_.nextId());
  ASSERT_EQ(back.hierarchy.preorder(), hierarchy_.preorder());
  for (const NodeId id : hierarchy_.ids()) {
    const MapNode& a = hierarchy_.node(id);
    const MapNode& b = back.hierarchy.node(id);
    EXPECT_EQ(a.label(), b.label());
    EXPECT_EQ(a.parent(), b.parent());
    EXPECT_EQ(a.children(), b.children());
    EXPECT_EQ(largestDifference(a.parent_T_node(), b.parent_T_node()), 0.0);
    EXPECT_EQ(a.existence_log_odds, b.existence_log_odds);
    EXPECT_EQ(a.existence(), b.existence());
    EXPECT_EQ(a.first_scan, b.first_scan);
    EXPECT_EQ(a.last_scan, b.last_scan);
    EXPECT_EQ(a.version, b.version);
    EXPECT_EQ(a.map().resolution(), b.map().resolution());
    EXPECT_EQ(a.map().model().prob_hit, b.map().model().prob_hit);
    EXPECT_EQ(a.map().tree().getClampingThresMaxLog(), b.map().tree().getClampingThresMaxLog());
    EXPECT_TRUE(a.map().tree() == b.map().tree());
  }
}

TEST_F(MapRoundTrip, WritingAMapThatWasReadGivesTheSameBytes) {
  std::vector<RemovedNode> removed;
  const NodeId gone{3};
  const Pose world_T_gone = hierarchy_.world_T_node(gone);
  removed.push_back({hierarchy_.remove(gone), world_T_gone, 3});
  write(hierarchy_, removed, "map");
  const StoredMap back = readMap(map(), {std::nullopt, true});
  ASSERT_EQ(back.removed.size(), 1U);
  EXPECT_EQ(largestDifference(back.removed[0].world_T_node, world_T_gone), 0.0);
  EXPECT_TRUE(back.removed[0].node.map().tree() == removed[0].node.map().tree());

  {  // a session that continues it knows the removed nodes from the manifest
    MapDirectory writer(map(), mapOptions(MapOpenMode::resume));
    const auto before = contents(map());
    writer.commit({back.hierarchy, {}, 4, "a log"});
    EXPECT_EQ(contents(map()), before);
  }
  EXPECT_EQ(toYaml(readManifest(map())), test::readText(map() / "hierarchy.yaml"));
}

TEST_F(MapRoundTrip, TheLocaleOfTheProcessMeansNothing) {
  struct German : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  hierarchy_.node(kRootId).version = 1'234'567;
  std::vector<RemovedNode> removed;
  removed.push_back({hierarchy_.remove(hierarchy_.preorder().back()), Pose(0.5, 0, 0, 0, 0, 0), 3});
  write(hierarchy_, removed, "a");
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new German));
  write(hierarchy_, removed, "b");
  const auto checked = checkMap(map("b"));
  const StoredMap back = readMap(map("b"));
  std::locale::global(before);
  EXPECT_EQ(contents(map("a")), contents(map("b")));
  EXPECT_TRUE(checked.damage.empty());
  EXPECT_EQ(back.hierarchy.node(kRootId).version, 1'234'567U);
}

TEST_F(MapRoundTrip, PoseTextsAreThePose) {
  write(hierarchy_, {}, "map");
  const std::string yaml = test::readText(map() / "hierarchy.yaml");
  std::istringstream lines(yaml);
  std::vector<Pose> poses;
  for (std::string line; std::getline(lines, line);) {
    const std::string key = "    world_pose: \"";
    if (!line.starts_with(key)) continue;
    Pose pose;
    pose.fromString(line.substr(key.size(), line.size() - key.size() - 1));  // MRPT's own reader
    poses.push_back(pose);
  }
  const auto order = hierarchy_.preorder();
  ASSERT_EQ(poses.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_LT(largestDifference(poses[i], hierarchy_.world_T_node(order[i])), 1e-12);
  }
}

TEST_F(MapRoundTrip, BoxAndCountsAreThoseOfTheMap) {
  write(hierarchy_, {}, "map");
  const Manifest manifest = readManifest(map());
  for (const NodeRecord& record : manifest.nodes) {
    const NodeMap& node_map = hierarchy_.node(record.id).map();
    const auto box = node_map.occupiedBox();
    EXPECT_LT((record.box_center - box.center()).norm(), 1e-12);
    const Eigen::Vector3d half = (0.5 * box.sizes()).array() + node_map.resolution();
    EXPECT_LT((record.box_half_extents - half).norm(), 1e-12);
    EXPECT_EQ(record.voxels.occupied, node_map.occupiedVoxels().size());
    EXPECT_EQ(record.memory_bytes, node_map.tree().memoryUsage());
  }
}

TEST_F(MapRoundTrip, StockOctomapReadsEveryFile) {
  write(hierarchy_, {}, "map");
  for (const NodeRecord& record : readManifest(map()).nodes) {
    const std::unique_ptr<octomap::AbstractOcTree> ot(
        octomap::AbstractOcTree::read((map() / record.ot.path).string()));
    ASSERT_NE(ot, nullptr);
    EXPECT_EQ(ot->size(), hierarchy_.node(record.id).map().tree().size());
    octomap::OcTree bt((map() / record.bt.path).string());
    EXPECT_GT(bt.size(), 1U);
  }
}

TEST_F(MapRoundTrip, AnotherYamlReaderTakesNumbersAsNumbers) {
  if (std::system("/usr/bin/python3 -c 'import yaml' 2>/dev/null") != 0)
    GTEST_SKIP() << "PyYAML is not installed";
  hierarchy_.node(NodeId{1}).existence_log_odds = -11.6;  // an existence that is printed with an exponent
  hierarchy_.move(NodeId{1}, Pose(1e-7, 0.0, 0.0, 0.0, 0.0, 0.0));
  write(hierarchy_, {}, "map");
  const char* script = R"(
import sys, yaml
m = yaml.safe_load(open(sys.argv[1]))
assert m['format_version'] == 1 and m['scans'] == 4 and len(m['nodes']) == 13
for n in m['nodes']:
    assert type(n['id']) is int and type(n['label']) is str and type(n['pose']) is str
    assert n['parent'] is None if n['id'] == 0 else type(n['parent']) is int
    for x in [n['resolution'], n['existence']] + n['pose_matrix'] + n['obb']['center'] + list(n['occupancy'].values()):
        assert type(x) is float, (n['id'], x)
    for f in n['files'].values():
        assert type(f['path']) is str and type(f['bytes']) is int and len(f['sha256']) == 64
assert 0.0 < m['nodes'][[n['id'] for n in m['nodes']].index(1)]['existence'] < 1e-4
)";
  test::writeText(folder_.path() / "check.py", script);
  const std::string command = "/usr/bin/python3 " + (folder_.path() / "check.py").string() + " " +
                              (map() / "hierarchy.yaml").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST_F(MapRoundTrip, EmptyRoot) {
  const MapHierarchy empty(labels::background, NodeMap(0.05, {}));
  MapDirectory writer(map(), mapOptions(MapOpenMode::create));
  writer.commit({empty, {}, 0});
  const StoredMap back = readMap(map());
  EXPECT_EQ(back.hierarchy.root().map().tree().size(), 0U);
  EXPECT_TRUE(findDamage(map(), back.manifest).empty());
}

}  // namespace
}  // namespace hoctomap
