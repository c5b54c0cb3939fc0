// SPDX-License-Identifier: BSD-3-Clause
// `hoctomap import tum` and `frames`: images with a trajectory become a log.
#include <gtest/gtest.h>

#include "DatasetFolders.h"
#include "TableLogs.h"
#include "hoctomap/io/LabelPng.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/PoseTrack.h"
#include "support/SharedData.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

/// How far two poses are apart: metres, degrees.
std::pair<double, double> between(const Pose& a, const Pose& b) {
  const Eigen::Isometry3d d = toIsometry(a).inverse() * toIsometry(b);
  return {d.translation().norm(), Eigen::AngleAxisd(d.linear()).angle() * 180.0 / M_PI};
}

test::Outcome importTum(const TemporaryFolder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"import", "tum", folder / "tum", "-o", folder / "a.rawlog"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return test::hoctomap(arguments);
}

/// Compares a log's points with those that frame `k` of the folders has in the world.
void expectPoints(const Measurement& z, std::size_t k, double stamp, double unit) {
  const PinholeCamera& camera = test::kSmallCamera;
  const Eigen::Isometry3d world_T_optical = toIsometry(test::worldTOptical(stamp));
  ASSERT_EQ(z.world_points.size(), static_cast<std::size_t>(camera.width * camera.height) - 1);
  for (std::size_t n = 0; n < z.world_points.size(); ++n) {
    const std::size_t i = z.pixel_of_point[n];
    const double depth = unit * test::depthSteps(k, i);
    const double u = static_cast<double>(i % static_cast<std::size_t>(camera.width));
    const double v = static_cast<double>(i / static_cast<std::size_t>(camera.width));
    const Eigen::Vector3d optical((u - camera.cx) / camera.fx * depth, (v - camera.cy) / camera.fy * depth,
                                  depth);
    EXPECT_LT((world_T_optical * optical - z.world_points[n].cast<double>()).norm(), 1e-5 * depth) << i;
  }
}

TEST(ImportTum, PlacesEachImageByTheTrajectoryBetweenItsPoses) {
  const TemporaryFolder folder;
  test::writeTumFolder(folder / "tum", 4);
  const auto outcome = importTum(folder);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("4 scans, 4 with colour, 0 frames skipped"), std::string::npos) << outcome.out;
  const auto scans = test::scansOf(folder / "a.rawlog");
  ASSERT_EQ(scans.size(), 4U);
  for (std::size_t k = 0; k < scans.size(); ++k) {
    EXPECT_NEAR(scans[k].stamp, 100.0 + 0.1 * static_cast<double>(k), 1e-6);
    expectPoints(scans[k], k, scans[k].stamp, 1.0 / 5000.0);
  }
}

TEST(ImportTum, TheWorldIsTurnedUpright) {
  const TemporaryFolder folder;
  test::writeTumFolder(folder / "tum", 2);
  ASSERT_EQ(importTum(folder, {"--up", "0,-1,0", "--floor", "0.5"}).exit_code, 0);
  const auto scans = test::scansOf(folder / "a.rawlog");
  const Pose expected = Pose(0, 0, -0.5, 0, 0, 0) + levelled({0.0, -1.0, 0.0});
  const Eigen::Isometry3d optical = toIsometry(expected + test::worldTOptical(100.0));
  EXPECT_LT((toIsometry(scans.at(0).world_T_sensor).translation() - optical.translation()).norm(), 1e-6);
  EXPECT_LT((toIsometry(scans.at(0).world_T_sensor).linear().col(0) - optical.linear().col(2)).norm(), 1e-6);
}

TEST(ImportTum, FramesWithoutAPoseAreCountedAndTheLogIsWrittenAllTheSame) {
  const TemporaryFolder folder;
  test::writeTumFolder(folder / "tum", 4);
  std::string poses;
  for (double stamp = 100.06; stamp < 100.32; stamp += 0.05)
    poses += test::tumRow(stamp, test::worldTOptical(stamp));
  test::writeFile(folder / "tum/groundtruth.txt", poses);
  const auto outcome = importTum(folder);
  EXPECT_EQ(outcome.exit_code, 3) << "a quarter is more than 5 %";
  EXPECT_NE(outcome.out.find("3 scans, 3 with colour, 1 frames skipped"), std::string::npos) << outcome.out;
  EXPECT_EQ(test::scansOf(folder / "a.rawlog").size(), 3U);
  // Nor are gaps bridged.
  EXPECT_NE(importTum(folder, {"--max-gap", "0.01"}).err.find("no pose at the time of any image"),
            std::string::npos);
}

TEST(ImportTum, AnotherClockIsNamedAndCanBeShifted) {
  const TemporaryFolder folder;
  test::writeTumFolder(folder / "tum", 2);
  std::string poses;
  for (double stamp = 99.9; stamp < 100.3; stamp += 0.05)
    poses += test::tumRow(stamp + 1000.0, test::worldTOptical(stamp));
  test::writeFile(folder / "tum/groundtruth.txt", poses);
  const auto other = importTum(folder);
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_NE(other.err.find("groundtruth.txt: has no pose at the time of any image: it goes from 1099.900"),
            std::string::npos)
      << other.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "a.rawlog"));
  EXPECT_EQ(importTum(folder, {"--time-offset", "-1000"}).exit_code, 0);
}

TEST(ImportTum, ImagesMayStandBesideTheLog) {
  const TemporaryFolder folder;
  test::writeTumFolder(folder / "tum", 3);
  ASSERT_EQ(importTum(folder).exit_code, 0);
  const auto inside = test::scansOf(folder / "a.rawlog");
  ASSERT_EQ(
      test::hoctomap({"import", "tum", folder / "tum", "-o", folder / "b.rawlog", "--images", "external"})
          .exit_code,
      0);
  EXPECT_EQ(test::readTree(folder / "b_Images").size(), 6U) << "a range image and a picture each";
  const auto outside = test::scansOf(folder / "b.rawlog");
  ASSERT_EQ(outside.size(), inside.size());
  for (std::size_t k = 0; k < inside.size(); ++k) EXPECT_EQ(outside[k].image->depth, inside[k].image->depth);
  EXPECT_EQ(
      test::hoctomap({"import", "tum", folder / "tum", "-o", folder / "b.rawlog", "--images", "external"})
          .exit_code,
      2)
      << "the images of the old log are not touched";
}

TEST(ImportTum, OtherImagesBesideALogAreAnotherLogToContinue) {
  const TemporaryFolder folder;
  test::writeTumFolder(folder / "tum", 3);
  ASSERT_EQ(importTum(folder, {"--images", "external"}).exit_code, 0);
  const std::vector<std::string> build{"build", "-q", "-i", folder / "a.rawlog", "-o", folder / "map"};
  const auto continued = [&] {
    auto arguments = build;
    arguments.emplace_back("--continue");
    return test::hoctomap(arguments);
  };
  auto first = build;
  first.insert(first.end(), {"--max-scans", "1"});
  ASSERT_EQ(test::hoctomap(first).exit_code, 0);
  const auto map = test::readTree(folder / "map");

  const std::filesystem::path a(folder / "a_Images/000000_range.bin");
  const std::filesystem::path b(folder / "a_Images/000001_range.bin");
  const std::string image = test::readFile(a);
  test::writeFile(a, test::readFile(b));
  const auto refused = continued();
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("cannot be continued"), std::string::npos) << refused.err;
  EXPECT_EQ(test::readTree(folder / "map"), map);

  test::writeFile(a, image);
  const auto outcome = continued();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(readManifest(folder / "map").scans, 3U);
}

TEST(ImportTum, DamagedImagesBesideALogAreSkippedScans) {
  const TemporaryFolder folder;
  test::writeTumFolder(folder / "tum", 3);
  ASSERT_EQ(importTum(folder, {"--images", "external"}).exit_code, 0);
  test::writeFile(folder / "a_Images/000001_range.bin", "no image of any kind");
  const auto outcome = test::hoctomap({"build", "-i", folder / "a.rawlog", "-o", folder / "map"});
  EXPECT_EQ(outcome.exit_code, 3) << "a third is more than 5 %";
  EXPECT_NE(outcome.out.find("2 used, 1 skipped"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find("damaged external file"), std::string::npos) << outcome.err;
  EXPECT_EQ(readManifest(folder / "map").scans, 3U) << "the map is written all the same";
}

TEST(ImportTum, StockMrptReadsTheLog) {
  const TemporaryFolder folder;
  test::writeTumFolder(folder / "tum", 3);
  ASSERT_EQ(importTum(folder, {"--images", "external"}).exit_code, 0);
  const auto info = test::runProgram("rawlog-edit", {"--info", "-i", folder / "a.rawlog"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("All sensor labels                 : RGBD, groundtruth"), std::string::npos)
      << info.out;
  // The pictures in the log are whole: it writes them out as files.
  ASSERT_EQ(test::hoctomap({"import", "tum", folder / "tum", "-o", folder / "b.rawlog"}).exit_code, 0);
  const auto moved = test::runProgram(
      "rawlog-edit", {"--externalize", "-i", folder / "b.rawlog", "-o", folder / "c.rawlog"});
  EXPECT_EQ(moved.exit_code, 0) << moved.err;
  EXPECT_EQ(test::readTree(folder / "c_Images").size(), 6U) << moved.out;
}

TEST(ImportTum, BadFoldersGiveOneLineAndNoLog) {
  struct Case {
    std::function<void(const std::string& tum)> harm;
    std::string told;
    int exit_code = 3;
  };
  const auto replaced = [](const char* file, const char* text) {
    return [=](const std::string& tum) { test::writeFile(tum + "/" + file, text); };
  };
  const std::string row = test::tumRow(100.0, test::worldTOptical(100.0));
  const std::vector<Case> cases{
      {[](const std::string& tum) { std::filesystem::remove(tum + "/depth.txt"); },
       "depth.txt: no such list"},
      {[](const std::string& tum) { std::filesystem::remove(tum + "/groundtruth.txt"); },
       "groundtruth.txt: no such"},
      {[](const std::string& tum) { std::filesystem::remove(tum + "/camera.txt"); }, "--intrinsics", 2},
      {[](const std::string& tum) { std::filesystem::remove(tum + "/depth/1.png"); }, "depth.txt:3: "},
      {[](const std::string& tum) { std::filesystem::remove(tum + "/rgb/2.png"); }, "rgb.txt:4: "},
      {[](const std::string& tum) {
         writeGreyPng(tum + "/depth/1.png", 16, 12, std::vector<std::uint8_t>(192));
       },
       "1 channel of 8 bits"},
      {[](const std::string& tum) {
         writeLabelPng(tum + "/depth/1.png", 8, 6, std::vector<std::uint16_t>(48));
       },
       "8 x 6 pixels instead of 16 x 12"},
      {replaced("depth/1.png", "P5 a picture of another kind"), "not a PNG"},
      {[](const std::string& tum) {
         std::filesystem::resize_file(tum + "/depth/1.png",
                                      std::filesystem::file_size(tum + "/depth/1.png") - 30);
       },
       "damaged image"},
      {replaced("depth.txt", "100.0 depth/0.png\n100.0 depth/1.png\n"),
       "depth.txt:2: the times are not ascending"},
      {replaced("depth.txt", "100.0 depth/0.png 7\n"), "depth.txt:1: 3 columns"},
      {replaced("depth.txt", "nan depth/0.png\n"), "depth.txt:1: 'nan' is not finite"},
      {replaced("depth.txt", "100.0 ../depth/0.png\n"), "leads out of the folder"},
      {replaced("depth.txt", "# nothing\n"), "lists no image"},
      {replaced("camera.txt", "15 15 8\n"), "camera.txt:1: "},
      {replaced("camera.txt", "15 15 80 6\n"), "outside of the image"},
      {replaced("groundtruth.txt", "100 0 0 0 0 0 nan 1\n"), "groundtruth.txt:1: 'nan' is not finite"},
      {replaced("groundtruth.txt", "100 0 0 0 0 0 0 2\n"), "groundtruth.txt:1: the quaternion's length"},
      {replaced("groundtruth.txt", "100 2e6 0 0 0 0 0 1\n"), "groundtruth.txt:1: bad pose"},
      {replaced("groundtruth.txt", "100 0 0 0 0 0\n"), "groundtruth.txt:1: 6 columns"},
  };
  for (const Case& c : cases) {
    const TemporaryFolder folder;
    test::writeTumFolder(folder / "tum", 3);
    c.harm(folder / "tum");
    const auto outcome = importTum(folder, {"-q"});
    EXPECT_EQ(outcome.exit_code, c.exit_code) << c.told;
    EXPECT_NE(outcome.err.find(c.told), std::string::npos) << c.told << ": " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    const auto left = test::readTree(folder / "");
    EXPECT_TRUE(std::none_of(left.begin(), left.end(), [](const auto& f) {
      return f.first.find("rawlog") != std::string::npos || f.first.find("tmp") != std::string::npos;
    })) << c.told;
  }
}

TEST(ImportTum, TheKitchenGivesTheObjectsOfItsRawlog) {
  const auto data = test::sharedData();
  if (!data) GTEST_SKIP() << "no shared data";
  const TemporaryFolder folder;
  const std::string rawlog = *data / "redkitchen/table_sweep_a.rawlog";
  const auto outcome = test::hoctomap(
      {"import", "tum", *data / "tum_format/rgbd_dataset_redkitchen", "-o", folder / "a.rawlog"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto imported = test::scansOf(folder / "a.rawlog");
  const auto original = test::scansOf(rawlog);
  ASSERT_EQ(imported.size(), 10U);
  for (std::size_t k = 0; k < imported.size(); ++k) {
    const auto [metres, degrees] = between(original[k].world_T_sensor, imported[k].world_T_sensor);
    EXPECT_LT(metres, 0.001) << k;
    EXPECT_LT(degrees, 0.1) << k;
  }
  test::build(folder / "a.rawlog", folder / "imported");
  test::build(rawlog, folder / "original", {"--max-scans", "10"});
  for (const char* label : {"object", "table"}) {
    const double tolerance = label == std::string("object") ? 0.01 : 0.05;
    const auto expected = test::nodesOf(folder / "original", label);
    const auto got = test::nodesOf(folder / "imported", label);
    EXPECT_EQ(got.size(), expected.size());
    for (const auto& node : expected) {
      EXPECT_EQ(std::count_if(got.begin(), got.end(),
                              [&](const auto& n) { return (n.centroid - node.centroid).norm() < tolerance; }),
                1)
          << label << " " << node.record.id.value;
    }
  }
}

TEST(ImportTum, TheKitchenIsLevelledFromAnyWorld) {
  const auto data = test::sharedData();
  if (!data) GTEST_SKIP() << "no shared data";
  const TemporaryFolder folder;
  const std::string kitchen = *data / "tum_format/rgbd_dataset_redkitchen";
  const auto importKitchen = [&](const std::string& log, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"import", "tum", kitchen, "-q", "-o", folder / log};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(test::hoctomap(arguments).exit_code, 0);
    return test::scansOf(folder / log);
  };
  // The same trajectory in a world that lies on its side.
  const PoseTrack track = readPoseFile(kitchen + "/groundtruth.txt");
  const Pose turn(1.0, -2.0, 3.0, 0.7, 1.1, -2.0);
  const auto upright = importKitchen("upright.rawlog", {});
  std::string poses;
  for (const auto& z : upright) poses += test::tumRow(z.stamp, turn + *track.at(z.stamp, 1.0));
  test::writeFile(folder / "turned.txt", poses);
  const auto levelled = importKitchen("levelled.rawlog", {"--poses", folder / "turned.txt", "--level"});
  ASSERT_EQ(levelled.size(), upright.size());
  const auto upOf = [](const Measurement& z) {
    return Eigen::Vector3d(toIsometry(z.world_T_sensor).linear().row(2));  // in the sensor's frame
  };
  for (std::size_t k = 0; k < upright.size(); ++k)
    EXPECT_GT(upOf(upright[k]).dot(upOf(levelled[k])), std::cos(0.5 * M_PI / 180.0)) << k;
}

TEST(ImportTum, WrongOptionsAreExit2) {
  const TemporaryFolder folder;
  test::writeTumFolder(folder / "tum", 1);
  const std::vector<std::vector<std::string>> wrong{
      {"--intrinsics", "1,2,3"},   {"--intrinsics", "freiburg4"},
      {"--depth-factor", "0"},     {"--depth-factor", "inf"},
      {"--up", "0,0,0"},           {"--up", "nan,0,1"},
      {"--floor", "nan"},          {"--images", "somewhere"},
      {"--up", "0,0,1", "--level"}};
  for (const auto& more : wrong) EXPECT_EQ(importTum(folder, more).exit_code, 2) << more[0] << " " << more[1];
  EXPECT_FALSE(std::filesystem::exists(folder / "a.rawlog"));
}

TEST(ImportFrames, PosesAndImagesComeFromFilesOfOneName) {
  const TemporaryFolder folder;
  test::writeFramesFolder(folder / "frames", 3);
  // What the recorder lost.
  const std::string lost = "-inf -inf -inf -inf\n";
  test::writeFile(folder / "frames/frame-000001.pose.txt", lost + lost + lost + lost);
  const auto outcome =
      test::hoctomap({"import", "frames", folder / "frames", "-o", folder / "a.rawlog", "--rate", "10"});
  EXPECT_EQ(outcome.exit_code, 3) << "a third of the frames has no pose";
  EXPECT_NE(outcome.out.find("2 scans, 0 with colour, 1 frames skipped"), std::string::npos) << outcome.out;
  const auto scans = test::scansOf(folder / "a.rawlog");
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_NEAR(scans[1].stamp, 0.2, 1e-6);
  expectPoints(scans[0], 0, 100.0, 0.001);
  expectPoints(scans[1], 2, 100.2, 0.001);
}

TEST(ImportFrames, BadFoldersGiveOneLineAndNoLog) {
  const std::vector<std::array<std::string, 3>> cases{
      {"frame-000001.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 nan 0\n0 0 0 1\n", "frame-000001.pose.txt:3: 'nan'"},
      {"frame-000001.pose.txt", "1 0 0\n0 1 0\n0 0 1\n", "frame-000001.pose.txt:1: 3 columns instead of 4"},
      {"frame-000001.pose.txt", "1 0 0 0\n0 1 0 0\n", "2 rows instead of 4"},
      {"frame-000001.pose.txt", "1 0 0 2e6\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "bad pose"},
      {"frame-000001.pose.txt", "1 0 0 0\n0 2 0 0\n0 0 1 0\n0 0 0 1\n", "not orthonormal"},
      {"frame-000001.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n", "a reflection"},
      {"camera-intrinsics.txt", "15 0 8\n0 15 6\n", "camera-intrinsics.txt: 2 rows instead of 3"},
      {"camera-intrinsics.txt", "0 0 8\n0 15 6\n0 0 1\n", "must be positive"},
  };
  for (const auto& [file, text, told] : cases) {
    const TemporaryFolder folder;
    test::writeFramesFolder(folder / "frames", 2);
    test::writeFile(folder / ("frames/" + file), text);
    const auto outcome =
        test::hoctomap({"import", "frames", folder / "frames", "-o", folder / "a.rawlog", "-q"});
    EXPECT_EQ(outcome.exit_code, 3) << told;
    EXPECT_NE(outcome.err.find(told), std::string::npos) << told << ": " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.rawlog"));
  }
  const TemporaryFolder folder;
  EXPECT_EQ(test::hoctomap({"import", "frames", folder / "none", "-o", folder / "a.rawlog"}).exit_code, 3);
}

}  // namespace
}  // namespace hoctomap
