// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>

#include "TableLogs.h"
#include "support/SharedData.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

bool isPng(const std::string& bytes) {
  return bytes.rfind("\x89PNG\r\n\x1a\n", 0) == 0;
}

/// Width or height in the header of a PNG.
std::uint32_t pngSize(const std::string& bytes, std::size_t at) {
  std::uint32_t size = 0;
  for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return size;
}

TEST(Segment, WritesALabelImageAScan) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  const auto outcome = test::hoctomap({"segment", "-q", "-i", folder / "a.rawlog", "-o", folder / "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (int k = 0; k < 6; ++k) {
    const std::string png = test::readFile(folder / ("out/labels/00000" + std::to_string(k) + ".png"));
    EXPECT_TRUE(isPng(png));
    EXPECT_EQ(pngSize(png, 16), 160U);
    EXPECT_EQ(pngSize(png, 20), 120U);
    EXPECT_EQ(png.at(24), 16) << "bits";
  }
  const auto segments = test::readFile(folder / "out/segments.csv");
  EXPECT_EQ(segments.substr(0, segments.find('\n')), "scan,segment,label,points,cx,cy,cz,hx,hy,hz");
  std::map<std::string, int> labels;
  for (const auto& row : test::parseCsv(segments)) ++labels[row.at("label")];
  EXPECT_EQ(labels["background"], 6);
  EXPECT_EQ(labels["table"], 6);
  EXPECT_GE(labels["object"], 18) << "three objects in each of six scans, some in two pieces";
  EXPECT_LE(labels["object"], 24);
  EXPECT_EQ(test::hoctomap({"segment", "-q", "-i", folder / "a.rawlog", "-o", folder / "out"}).exit_code, 2);
}

TEST(Info, OfALogSaysWhatItHolds) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  const auto text = test::hoctomap({"info", folder / "a.rawlog"});
  EXPECT_EQ(text.exit_code, 0);
  for (const char* expected : {"RGBD", "160 x 120", "groundtruth", "can be built: yes"}) {
    EXPECT_NE(text.out.find(expected), std::string::npos) << text.out;
  }
  const auto json = test::hoctomap({"info", folder / "a.rawlog", "--json"});
  EXPECT_EQ(json.out.front(), '{');
}

TEST(Info, OfAMapShowsTheTree) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map");
  const auto text = test::hoctomap({"info", folder / "map"});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_NE(text.out.find("5 nodes (1 background, 3 object, 1 table)"), std::string::npos) << text.out;
  EXPECT_EQ(test::hoctomap({"info", folder / "map", "--json"}).out.front(), '{');
  EXPECT_EQ(test::hoctomap({"info", folder / "a.rawlog", "--at-scan", "1"}).exit_code, 2);
}

TEST(Verify, NamesDamagedFilesAndExitsWithFour) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map", {"--snapshot-every", "2"});
  const auto whole = test::hoctomap({"verify", folder / "map"});
  EXPECT_EQ(whole.exit_code, 0) << whole.out << whole.err;
  EXPECT_NE(whole.out.find("5 nodes"), std::string::npos) << whole.out;

  const auto victim =
      std::filesystem::directory_iterator(std::filesystem::path(folder / "map") / "nodes")->path();
  std::filesystem::resize_file(victim, std::filesystem::file_size(victim) - 1);
  const auto damaged = test::hoctomap({"verify", folder / "map"});
  EXPECT_EQ(damaged.exit_code, 4);
  EXPECT_NE(damaged.out.find("nodes/" + victim.filename().string()), std::string::npos) << damaged.out;
  const auto json = test::hoctomap({"verify", folder / "map", "--json"});
  EXPECT_EQ(json.exit_code, 4);
  EXPECT_NE(json.out.find("\"whole\": false"), std::string::npos) << json.out;
}

TEST(Render, MakesAPictureWithoutADisplay) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map");
  const auto outcome = test::hoctomap(
      {"render", folder / "map", "-o", folder / "map.png", "--size", "320x200", "--view", "top"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string png = test::readFile(folder / "map.png");
  EXPECT_TRUE(isPng(png));
  EXPECT_EQ(pngSize(png, 16), 320U);
  EXPECT_EQ(pngSize(png, 20), 200U);
  EXPECT_EQ(test::hoctomap({"render", folder / "nothing", "-o", folder / "b.png"}).exit_code, 4);
}

TEST(Simulate, IsReproducibleAndStockToolsReadItsLog) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::simulate("demo", folder / "b.rawlog");
  EXPECT_EQ(test::readFile(folder / "a.rawlog"), test::readFile(folder / "b.rawlog"));
  EXPECT_EQ(test::readTree(folder / "a.truth"), test::readTree(folder / "b.truth"));
  EXPECT_EQ(test::readFile(folder / "a.rawlog"), test::readFile(test::sourceDir() / "rawlogs/demo.rawlog"));
  const auto stock = test::runProgram("rawlog-edit", {"--info", "-i", folder / "a.rawlog"});
  if (stock.exit_code == 127) GTEST_SKIP() << "rawlog-edit (package mrpt-apps) is not installed";
  EXPECT_NE(stock.out.find("Overall number of objects         : 12"), std::string::npos) << stock.out;
}

TEST(StockTools, OpenTheMap) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map");
  const Manifest manifest = readManifest(folder / "map");
  const auto probe = test::runProgram("convert_octree", {});
  if (probe.exit_code == 127) GTEST_SKIP() << "convert_octree (package octomap-tools) is not installed";
  for (const NodeRecord& node : manifest.nodes) {
    const auto ot = test::runProgram("convert_octree", {folder / "map/" + node.ot.path, folder / "copy.bt"});
    EXPECT_EQ(ot.exit_code, 0) << ot.err;
    // Stock OctoMap makes the same maximum-likelihood file of the truth as we did.
    EXPECT_EQ(test::readFile(folder / "copy.bt"), test::readFile(folder / "map/" + node.bt.path));
  }
  const auto yaml = test::runProgram(
      "/usr/bin/python3",
      {"-c",
       "import sys,yaml; m=yaml.safe_load(open(sys.argv[1])); "
       "assert all(isinstance(n['existence'],float) and isinstance(n['resolution'],float) and "
       "isinstance(n['world_pose'],str) and len(n['pose_matrix'])==16 for n in m['nodes']); "
       "print(len(m['nodes']))",
       folder / "map/hierarchy.yaml"});
  if (yaml.err.find("No module named") != std::string::npos) GTEST_SKIP() << "python3 has no yaml module";
  EXPECT_EQ(yaml.exit_code, 0) << yaml.err;
  EXPECT_EQ(yaml.out, "5\n");
}

TEST(StockTools, MrptReadsTheManifest) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map");
  const Manifest expected = readManifest(folder / "map");
  const auto yaml = mrpt::containers::yaml::FromFile(folder / "map/hierarchy.yaml");
  EXPECT_EQ(yaml["format_version"].as<int>(), 1);
  const auto& nodes = yaml["nodes"].asSequence();
  ASSERT_EQ(nodes.size(), expected.nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    mrpt::containers::yaml node(nodes[i]);
    const NodeRecord& record = expected.nodes[i];
    EXPECT_EQ(node["id"].as<std::uint32_t>(), record.id.value);
    EXPECT_EQ(node["label"].as<std::string>(), record.label.name);
    EXPECT_EQ(node["resolution"].as<double>(), record.resolution);
    EXPECT_EQ(node["existence"].as<double>(), record.existence);
    EXPECT_EQ(node["files"]["ot"]["sha256"].as<std::string>(), record.ot.sha256);
    mrpt::poses::CPose3D pose;
    pose.fromString(node["world_pose"].as<std::string>());
    EXPECT_LT((record.world_T_node - pose).norm(), 1e-9);
    EXPECT_LT((toIsometry(pose).linear() - toIsometry(record.world_T_node).linear()).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace hoctomap
