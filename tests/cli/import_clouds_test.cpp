// SPDX-License-Identifier: BSD-3-Clause
// `hoctomap import pcd`: clouds in files, which PCL's own tools have written, with a trajectory.
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "DatasetFolders.h"
#include "TableLogs.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

const std::vector<Eigen::Vector3f> kPoints{{1.F, 0.5F, 0.25F}, {2.F, -0.5F, 0.125F}, {3.F, 0.F, -1.F}};

/// A PCD as text, with colours, a point that is no return, and the points moved by `shift` along x.
std::string pcdText(float shift) {
  std::ostringstream text;
  text << "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH "
          "4\nHEIGHT 1\n"
       << "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA ascii\nnan nan nan 255\n";
  for (const auto& p : kPoints) text << p.x() + shift << " " << p.y() << " " << p.z() << " 16711680\n";
  return text.str();
}

std::string plyText() {
  std::ostringstream text;
  text << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
          "z\nend_header\n";
  for (const auto& p : kPoints) text << p.x() << " " << p.y() << " " << p.z() << "\n";
  return text.str();
}

std::string kittiBytes() {
  std::string bytes;
  for (const auto& p : kPoints) {
    const std::array<float, 4> values{p.x(), p.y(), p.z(), 0.5F};
    bytes.append(reinterpret_cast<const char*>(values.data()), sizeof values);
  }
  return bytes;
}

test::Outcome importPcd(const TemporaryFolder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"import", "pcd", folder / "clouds", "-o", folder / "a.rawlog"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::hoctomap(arguments);
}

void expectPoints(const Measurement& z, const Pose& world_T_sensor, float shift = 0.F) {
  ASSERT_EQ(z.world_points.size(), kPoints.size());
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    const Eigen::Vector3d p = (kPoints[i] + Eigen::Vector3f(shift, 0.F, 0.F)).cast<double>();
    EXPECT_LT((toIsometry(world_T_sensor) * p - z.world_points[i].cast<double>()).norm(), 1e-5);
  }
}

TEST(ImportPcd, EveryEncodingOfAPcdAtItsTimeInATrajectory) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "clouds");
  // ascii at 100.0, binary at 100.1, binary_compressed at 100.2
  std::string poses;
  for (int k = 0; k < 3; ++k) {
    const std::string file = folder / ("clouds/100." + std::to_string(k) + "00.pcd");
    test::writeFile(folder / "text.pcd", pcdText(static_cast<float>(k)));
    const auto converted =
        test::runProgram("pcl_convert_pcd_ascii_binary", {folder / "text.pcd", file, std::to_string(k)});
    if (converted.exit_code == 127) GTEST_SKIP() << "pcl-tools is not installed";
    ASSERT_EQ(converted.exit_code, 0) << converted.err;
  }
  for (double stamp = 99.97; stamp < 100.3; stamp += 0.05)
    poses += test::tumRow(stamp, test::worldTOptical(stamp));
  test::writeFile(folder / "clouds/groundtruth.txt", poses);
  const auto outcome = importPcd(folder);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("3 scans, 3 with colour"), std::string::npos) << outcome.out;
  const auto scans = test::scansOf(folder / "a.rawlog");
  ASSERT_EQ(scans.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k)
    expectPoints(scans[k], test::worldTOptical(100.0 + 0.1 * static_cast<double>(k)), static_cast<float>(k));
}

TEST(ImportPcd, KittisCloudsPosesTimesAndMounting) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "clouds");
  for (const char* name : {"000000.bin", "000002.bin", "000007.bin"})
    test::writeFile(folder / (std::string("clouds/") + name), kittiBytes());
  test::writeFile(folder / "poses.txt",
                  "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n0 0 1 2 0 1 0 0 -1 0 0 5\n");
  test::writeFile(folder / "times.txt", "0.0\n0.1037\n0.2074\n");
  test::writeFile(folder / "calib.txt", "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: 0 -1 0 0.5 0 0 -1 0 1 0 0 0\n");
  const auto outcome = importPcd(folder);
  EXPECT_EQ(outcome.exit_code, 3) << "cloud 7 has no row: a third";
  EXPECT_NE(outcome.out.find("2 scans, 0 with colour, 1 frames skipped"), std::string::npos) << outcome.out;
  const auto scans = test::scansOf(folder / "a.rawlog");
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_NEAR(scans[1].stamp, 0.2074, 1e-6);
  Eigen::Matrix4d camera = Eigen::Matrix4d::Identity();
  camera.topRows<3>() << 0, 0, 1, 2, 0, 1, 0, 0, -1, 0, 0, 5;
  Eigen::Matrix4d mounting = Eigen::Matrix4d::Identity();
  mounting.topRows<3>() << 0, -1, 0, 0.5, 0, 0, -1, 0, 1, 0, 0, 0;
  expectPoints(scans[0], poseFromMatrix(mounting));
  expectPoints(scans[1], poseFromMatrix(camera * mounting));
}

TEST(ImportPcd, PlyByItsTime) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "clouds");
  test::writeFile(folder / "clouds/a.ply", plyText());
  test::writeFile(folder / "clouds/poses.txt", test::tumRow(7.5, test::worldTOptical(101.0)));
  EXPECT_NE(importPcd(folder).err.find("the name is no number; give --times"), std::string::npos);
  test::writeFile(folder / "clouds/times.txt", "7.5\n");
  const auto outcome = importPcd(folder);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expectPoints(test::scansOf(folder / "a.rawlog").at(0), test::worldTOptical(101.0));
}

TEST(ImportPcd, BadFoldersGiveOneLineAndNoLog) {
  const std::string whole = pcdText(0.F);
  const auto with = [&](const std::string& what, const std::string& instead) {
    std::string text = whole;
    return text.replace(text.find(what), what.size(), instead);
  };
  const std::string ply = plyText();
  struct Case {
    std::string file, bytes, told;
    int exit_code = 3;
  };
  const std::vector<Case> cases{
      {"100.1.pcd", whole.substr(0, whole.size() - 30), "100.1.pcd: "},
      {"100.1.pcd", with("DATA ascii", "DATA morse"), "no whole point cloud"},
      {"100.1.pcd", "no cloud at all", "no whole point cloud"},
      {"100.1.pcd", "", "no whole point cloud"},
      {"100.1.pcd", with("POINTS 4", "POINTS 4000000000"), "more than 10000000 points", 6},
      {"100.1.ply", ply.substr(0, ply.size() - 12), "no whole point cloud"},
      {"100.1.bin", kittiBytes().substr(0, 47), "47 bytes are no whole number of points"},
      {"poses.txt", test::tumRow(500.0, Pose()), "has no pose for any of the clouds"},
      {"poses.txt", "1 0 0 0 0 1 0 0 0 0 2 0\n", "poses.txt:1: the pose is not orthonormal"},
      {"poses.txt", "1 0 0 2e6 0 1 0 0 0 0 1 0\n", "poses.txt:1: bad pose"},
      {"poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0\n", "poses.txt:2: 3 columns"},
      {"calib.txt", "Tr: 1 2 3\n", "calib.txt:1: 3 numbers instead of 12"},
      {"times.txt", "1\n2 3\n", "times.txt:2: 2 columns instead of 1"},
  };
  for (const Case& c : cases) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "clouds");
    test::writeFile(folder / "clouds/100.0.pcd", whole);
    test::writeFile(folder / "clouds/poses.txt", test::tumRow(100.0, Pose()) + test::tumRow(100.1, Pose()));
    test::writeFile(folder / ("clouds/" + c.file), c.bytes);
    const auto outcome = importPcd(folder, {"-q"});
    EXPECT_EQ(outcome.exit_code, c.exit_code) << c.told;
    EXPECT_NE(outcome.err.find(c.told), std::string::npos) << c.told << ": " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.rawlog"));
  }
}

TEST(ImportPcd, TheLargestHorizontalStructureIsLevelled) {
  // A floor of 2 x 1 m and a wall of half its size, in a world that lies on its side: y points down.
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "clouds");
  std::ostringstream text;
  int points = 0;
  for (double x = -1.0; x < 1.0; x += 0.02) {
    for (double z = 2.0; z < 3.0; z += 0.02, ++points) text << x << " 1.5 " << z << "\n";
    for (double y = 1.0; y < 1.5; y += 0.02, ++points) text << x << " " << y << " 3\n";
  }
  test::writeFile(folder / "clouds/0.ply",
                  "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points) +
                      "\nproperty float x\nproperty float y\nproperty float z\nend_header\n" + text.str());
  test::writeFile(folder / "clouds/poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const auto outcome = importPcd(folder, {"--level", "--floor", "-1.5"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("is at z = 0.000 m"), std::string::npos) << outcome.out;
  int on_floor = 0;
  const auto scans = test::scansOf(folder / "a.rawlog");
  for (const auto& p : scans.at(0).world_points) on_floor += std::abs(p.z()) < 1e-3F ? 1 : 0;
  EXPECT_GE(on_floor, 5000);
}

}  // namespace
}  // namespace hoctomap
