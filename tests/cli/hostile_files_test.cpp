// SPDX-License-Identifier: BSD-3-Clause
// Files made to do harm: each is one line and a documented exit code, and takes little memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "TableLogs.h"
#include "hoctomap/io/PipeLogWriter.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

#ifdef HOCTOMAP_SANITIZED  // the sanitizer's own memory, and no limits
constexpr std::size_t kLittleMemory = std::size_t{8} << 30;
#else
constexpr std::size_t kLittleMemory = std::size_t{200} << 20;
#endif

/// @return what it says
std::string expectRefused(const std::vector<std::string>& arguments, int exit_code) {
  const auto outcome = test::hoctomap(arguments);
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_LT(outcome.peak_memory, kLittleMemory);
  return outcome.err;
}

void shell(const std::string& command) {
  ASSERT_EQ(test::runProgram("/bin/sh", {"-c", command}).exit_code, 0) << command;
}

class HostileMaps : public ::testing::Test {
 protected:
  HostileMaps() {
    test::simulate("demo", folder / "a.rawlog");
    test::build(folder / "a.rawlog", map, {"--max-scans", "2"});
  }
  /// Puts other bytes into a file of the last node, with a manifest that vouches for them.
  FileRecord forge(const char* kind, const std::string& bytes) {
    Manifest manifest = readManifest(map);
    NodeRecord& node = manifest.nodes.back();
    FileRecord& file = std::string(kind) == "ot" ? node.ot : node.bt;
    file = {file.path, bytes.size(), sha256Hex(bytes)};
    test::writeFile(map + "/" + file.path, bytes);
    test::writeFile(map + "/hierarchy.yaml", toYaml(manifest));
    return file;
  }
  void expectDamaged(const FileRecord& file, const std::string& why) {
    const auto verified = test::hoctomap({"verify", map});
    EXPECT_EQ(verified.exit_code, 4);
    EXPECT_LT(verified.peak_memory, kLittleMemory);
    EXPECT_NE(verified.out.find("damaged  " + file.path), std::string::npos) << verified.out;
    EXPECT_NE(verified.out.find(why), std::string::npos) << verified.out;
    if (file.path.ends_with(".bt")) return;  // made for others; the map itself is read from `.ot`
    EXPECT_NE(expectRefused({"diff", map, map}, 4).find(file.path), std::string::npos);
  }

  TemporaryFolder folder;
  const std::string map = folder / "map";
};

TEST_F(HostileMaps, ANestedChain) {
  std::string chain = "# Octomap OcTree binary file\nid OcTree\nsize 100000\nres 0.002\ndata\n";
  for (int i = 0; i < 100'000; ++i) chain += std::string("\x03\x00", 2);
  expectDamaged(forge("bt", chain), "deeper than 16");
}

TEST_F(HostileMaps, ATruncatedOctree) {
  const std::string bytes = test::readFile(map + "/" + readManifest(map).nodes.back().ot.path);
  expectDamaged(forge("ot", bytes.substr(0, bytes.size() - 7)), "cut");
  expectDamaged(forge("ot", "# Octomap OcTree file\nid OcTree\nsize 4000000000\nres 0.002\ndata\n"), "cut");
}

TEST_F(HostileMaps, WhatIsIntactCanBeExported) {
  const Manifest manifest = readManifest(map);
  const FileRecord bad = manifest.nodes.back().ot;
  test::writeFile(map + "/" + bad.path, "rubbish");
  const auto outcome = test::hoctomap({"export", map, "--format", "ot", "-o", folder / "rest"});
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_NE(outcome.out.find("damaged  " + bad.path), std::string::npos) << outcome.out;
  const auto rows = test::parseCsv(test::readFile(folder / "rest/nodes.csv"));
  ASSERT_EQ(rows.size(), manifest.nodes.size() - 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at("label"), manifest.nodes[i].label.name);
    EXPECT_EQ(test::readFile(folder / "rest/" + rows[i].at("file")),
              test::readFile(map + "/" + manifest.nodes[i].ot.path));
  }
  EXPECT_EQ(test::readTree(folder / "rest").size(), rows.size() + 1);
}

TEST_F(HostileMaps, AWholeMapIsExportedInBothFormats) {
  const NodeRecord node = readManifest(map).nodes.back();
  for (const char* format : {"ot", "bt"}) {
    const std::string out = folder / format;
    EXPECT_EQ(test::hoctomap({"export", map, "--format", format, "-o", out}).exit_code, 0);
    const auto row = test::parseCsv(test::readFile(out + "/nodes.csv")).back();
    EXPECT_EQ(test::readFile(out + "/" + row.at("file")),
              test::readFile(map + "/" + (std::string(format) == "ot" ? node.ot : node.bt).path));
    EXPECT_NEAR(std::stod(row.at("x")), node.world_T_node.x(), 1e-12);
  }
  EXPECT_EQ(test::hoctomap({"export", map, "-o", folder / "ot"}).exit_code, 2) << "not empty";
  EXPECT_EQ(test::hoctomap({"export", map, "--format", "stl", "-o", folder / "x"}).exit_code, 2);
}

TEST_F(HostileMaps, LogOddsThatAreNoNumber) {
  std::string bytes = test::readFile(map + "/" + readManifest(map).nodes.back().ot.path);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(bytes.data() + bytes.find("data\n") + 5, &nan, sizeof nan);
  expectDamaged(forge("ot", bytes), "log-odds");
}

TEST_F(HostileMaps, FilesOfAnySizeAndKind) {
  const FileRecord ot = readManifest(map).nodes.back().ot;
  std::filesystem::resize_file(map + "/" + ot.path, std::uintmax_t{1} << 40);  // takes no room on the disk
  expectDamaged(ot, "1099511627776 bytes");
  std::filesystem::remove(map + "/hierarchy.yaml");
  shell("mkfifo " + map + "/hierarchy.yaml");
  expectRefused({"info", map}, 5);
  std::filesystem::remove(map + "/hierarchy.yaml");
  test::writeFile(map + "/hierarchy.yaml", std::string(50'000'000, '['));
  expectRefused({"info", map}, 4);
}

/// YAML can say much with few words, and this says nothing that a manifest needs.
TEST_F(HostileMaps, AliasesInTheManifest) {
  std::string yaml = "a0: &a0 [x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "*a" + std::to_string(i - 1);
    yaml += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before + ", " + before + "]\n";
  }
  test::writeFile(map + "/hierarchy.yaml", yaml);
  EXPECT_NE(expectRefused({"info", map}, 4).find("anchors and aliases"), std::string::npos);
}

TEST(HostileLogs, ABomb) {
  const TemporaryFolder folder;
  shell("head -c 100000000 /dev/zero | gzip > " + folder / "bomb.rawlog");
  const std::string error =
      expectRefused({"build", "-q", "-i", folder / "bomb.rawlog", "-o", folder / "map"}, 6);
  EXPECT_NE(error.find("bomb.rawlog"), std::string::npos) << error;
}

TEST(HostileLogs, NothingButANullObject) {
  const TemporaryFolder folder;
  test::writeFile(folder / "null.rawlog", std::string("\x87nullptr\x88", 9));
  expectRefused({"build", "-q", "-i", folder / "null.rawlog", "-o", folder / "map"}, 3);
}

TEST(HostileLogs, AHugeCount) {
  const TemporaryFolder folder;
  setenv("HOCTOMAP_MRPT", HOCTOMAP_HELPER, 1);
  PipeLogWriter writer(folder / "gz.rawlog");
  writer.write(CloudScan{0, 1.0, "lidar", Pose(), PointCloud(3, Eigen::Vector3f(7.5F, 7.5F, 7.5F))});
  writer.finish();
  shell("gzip -dc < " + folder / "gz.rawlog" + " > " + folder / "plain.rawlog");
  std::string bytes = test::readFile(folder / "plain.rawlog");
  const float value = 7.5F;
  const auto first = bytes.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  ASSERT_NE(first, std::string::npos);
  bytes.replace(first - 4, 4, "\xff\xff\xff\xff");
  test::writeFile(folder / "huge.rawlog", bytes);
  const std::string error = expectRefused(
      {"build", "-q", "-i", folder / "huge.rawlog", "-o", folder / "map", "--poses", "identity"}, 6);
  EXPECT_NE(error.find("object 0 at byte 0"), std::string::npos) << error;
}

TEST(HostileLogs, ScansWithoutAUsablePointAreSkippedAndCounted) {
  const TemporaryFolder folder;
  setenv("HOCTOMAP_MRPT", HOCTOMAP_HELPER, 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  PipeLogWriter writer(folder / "a.rawlog");
  writer.write(CloudScan{0, 1.0, "lidar", Pose(), PointCloud(3, Eigen::Vector3f(nan, 1e30F, 0.0F))});
  writer.write(CloudScan{1, 2.0, "lidar", Pose(), PointCloud(3, Eigen::Vector3f::Zero())});
  writer.write(CloudScan{2, 3.0, "lidar", Pose(), {}});  // nothing seen is a scan, too
  writer.finish();
  const auto outcome = test::hoctomap(
      {"build", "-i", folder / "a.rawlog", "-o", folder / "map", "--poses", "identity", "--monolithic"});
  EXPECT_EQ(outcome.exit_code, 3) << "two of three scans were skipped";
  EXPECT_NE(outcome.out.find("1 used (1 without points), 2 skipped"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("2 x no usable point"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace hoctomap
