// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>

#include "hoctomap/io/PipeSource.h"
#include "log_objects.h"
#include "support/SharedData.h"

namespace hoctomap {
namespace {

using test::only;
using test::optionsFor;
using test::readLog;

/// Number of scans of a log that all are used.
std::size_t usedScans(const std::filesystem::path& log) {
  const auto messages = readLog(optionsFor(log));
  EXPECT_TRUE(only<SkippedScan>(messages).empty()) << log;
  return only<DepthScan>(messages).size() + only<CloudScan>(messages).size();
}

TEST(RealLogs, SharedLogsAreReadWhole) {
  const auto data = test::sharedData();
  if (!data) GTEST_SKIP() << "no shared data";
  EXPECT_EQ(usedScans(*data / "redkitchen/table_sweep_a.rawlog"), 20U);
  EXPECT_EQ(usedScans(*data / "redkitchen/table_sweep_a_cloud.rawlog"), 3U);
  EXPECT_EQ(usedScans(*data / "pr2_stereo/table_with_mug.rawlog"), 1U);
  EXPECT_EQ(usedScans(*data / "arc_tote/empty_then_filled.rawlog"), 6U);
  EXPECT_EQ(usedScans(*data / "arc_tote/filled_then_empty.rawlog"), 6U);
  for (const auto& scene : std::filesystem::directory_iterator(*data / "mosd")) {
    if (!scene.is_directory()) continue;
    EXPECT_EQ(usedScans(scene.path() / "scene.rawlog"), 1U);
  }
  for (const auto& sequence : std::filesystem::directory_iterator(*data / "mosd_change")) {
    if (!sequence.is_directory()) continue;
    EXPECT_EQ(usedScans(sequence.path() / "sequence.rawlog") % 3, 0U);
  }
}

TEST(RealLogs, TheKitchensTableIsWhereItIs) {
  const auto data = test::sharedData();
  if (!data) GTEST_SKIP() << "no shared data";
  auto options = optionsFor(*data / "redkitchen/table_sweep_a.rawlog");
  options.max_scans = 1;
  PipeSource source(options, {}, nullptr);
  const auto item = source.next();
  ASSERT_TRUE(item);
  const auto& z = std::get<Measurement>(*item);
  ASSERT_TRUE(z.image);
  EXPECT_EQ(z.image->camera.width, 640);
  EXPECT_EQ(z.image->camera.height, 480);
  // Many returns lie at the height of the table (0.727 m), none far below the floor.
  std::size_t table = 0;
  std::size_t below = 0;
  for (const auto& p : z.world_points) {
    table += std::abs(p.z() - 0.727F) < 0.03F ? 1U : 0U;
    below += p.z() < -0.2F ? 1U : 0U;
  }
  EXPECT_GT(table, z.world_points.size() / 20);
  EXPECT_LT(below, z.world_points.size() / 100);
}

/// Debian's package mrpt-common.
std::filesystem::path debianLog(const char* name) {
  return std::filesystem::path("/usr/share/mrpt/datasets") / name;
}

std::vector<StreamMessage> readDebianLog(const char* name, const std::string& poses) {
  auto options = optionsFor(debianLog(name));
  options.poses = poses;
  return readLog(options);
}

TEST(RealLogs, DebiansLogsAreRead) {
  if (!std::filesystem::exists(debianLog("tests_rgbd.rawlog")))
    GTEST_SKIP() << "mrpt-common is not installed";
  EXPECT_EQ(only<DepthScan>(readDebianLog("tests_rgbd.rawlog", "identity")).size(), 1U);
  const auto velodyne = only<CloudScan>(readDebianLog("test_velodyne_VLP16.rawlog", "identity"));
  ASSERT_EQ(velodyne.size(), 1U);
  EXPECT_GT(velodyne[0].sensor_points.size(), 10'000U);
  EXPECT_EQ(only<CloudScan>(readDebianLog("localization_demo.rawlog", "odometry")).size(), 37U);
  EXPECT_FALSE(only<CloudScan>(readDebianLog("localization_demo.simplemap.gz", "")).empty());
  const auto flat = only<CloudScan>(readDebianLog("rot_scan_2d.rawlog", "identity"));
  ASSERT_EQ(flat.size(), 1U);
  EXPECT_GT(flat[0].sensor_points.size(), 100U);
}

}  // namespace
}  // namespace hoctomap
