// SPDX-License-Identifier: BSD-3-Clause
// The helper program from end to end: scans through the pipe, and hostile logs that only a process of its own
// survives.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/PipeLogWriter.h"
#include "hoctomap/io/PipeSource.h"
#include "log_objects.h"
#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

using test::errorOf;
using test::Folder;
using test::optionsFor;

std::vector<SourceItem> itemsOf(const LogReadOptions& options) {
  PipeSource source(options, {}, nullptr);
  std::vector<SourceItem> items;
  while (auto item = source.next()) items.push_back(std::move(*item));
  EXPECT_FALSE(source.next());  // stays at the end
  return items;
}

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

TEST(Helper, ScansArriveAsMeasurements) {
  const Folder folder;
  const auto items = itemsOf(optionsFor(folder.write("log.rawlog", test::gz(test::sweep(7)))));
  ASSERT_EQ(items.size(), 7U);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto& z = std::get<Measurement>(items[i]);
    EXPECT_EQ(z.scan, i);
    EXPECT_EQ(z.sensor, "RGBD");
    EXPECT_NEAR(z.stamp, 100.0 + static_cast<double>(i), 1e-6);
    EXPECT_EQ(z.world_points.size(), 48U);
    EXPECT_EQ(z.pixel_of_point.size(), 48U);
  }
}

TEST(Helper, ADestroyedSourceStopsTheHelper) {
  const Folder folder;
  const auto options = optionsFor(folder.write("log.rawlog", test::sweep(200)));
  PipeSource source(options, {}, nullptr);
  EXPECT_EQ(source.totalScans(), 200U);
  EXPECT_TRUE(source.next());
}

TEST(Helper, ErrorsKeepTheirTypeAndText) {
  const Folder folder;
  const auto cut = optionsFor(folder.write("cut.rawlog", test::sweep(3) + "junk"));
  EXPECT_NE(errorOf<InputError>([&] { itemsOf(cut); }).find("object 6"), std::string::npos);
  auto small = optionsFor(folder.write("log.rawlog", test::sweep(3)));
  small.max_object_bytes = 100;
  EXPECT_NE(errorOf<LimitError>([&] { itemsOf(small); }).find("larger than 100 bytes"), std::string::npos);
}

TEST(Helper, AHugeCountIsALimitError) {
  // The number of points of a cloud stands before its points: 0xFFFFFFFF in its place.
  std::string cloud = test::cloudObject(1.0, "c", PointCloud(3, Eigen::Vector3f(7.5F, 7.5F, 7.5F)));
  const float value = 7.5F;
  std::string floats(sizeof value, '\0');
  std::memcpy(floats.data(), &value, sizeof value);
  const auto first = cloud.find(floats);
  ASSERT_NE(first, std::string::npos);
  cloud.replace(first - 4, 4, "\xff\xff\xff\xff");
  const Folder folder;
  auto options = optionsFor(folder.write("huge.rawlog", cloud));
  options.poses = "identity";
  EXPECT_NE(errorOf<LimitError>([&] { itemsOf(options); }).find("object 0"), std::string::npos);
}

// Whatever the bytes: an error of this project or a result, never a crash or a hang.
TEST(Helper, MutatedLogsGiveAnErrorOrAResult) {
  const std::string log = test::sweep(2) +
                          test::cloudObject(101.0, "c", PointCloud(20, Eigen::Vector3f(1, 2, 3))) +
                          test::laserObject(101.0, std::vector<float>(20, 1.F), 5.F);
  test::Rng rng(8);
  const Folder folder;
  int results = 0;
  for (int round = 0; round < 12; ++round) {
    std::string bad = log;
    for (int edits = 0; edits < 4; ++edits)
      bad[rng() % bad.size()] = static_cast<char>(rng() % 3 == 0 ? 0xFF : rng());
    try {
      itemsOf(optionsFor(folder.write("bad.rawlog", bad)));
      ++results;
    } catch (const Error& error) {
      EXPECT_STRNE(error.what(), "");
    }
  }
  EXPECT_LE(results, 12);
}

DepthScan scanAt(double stamp, const Pose& world_T_sensor) {
  DepthScan scan{0, stamp, "RGBD", world_T_sensor, {{5, 4, 6.0, 6.0, 2.0, 1.5}, {}}};
  for (int i = 0; i < 20; ++i) scan.image.depth.push_back(0.5F + 0.1F * static_cast<float>(i));
  scan.image.depth[3] = 0.F;
  scan.image.depth[4] = 70.F;  // beyond 16 bits of millimetres
  return scan;
}

void writeTwoScans(const std::filesystem::path& log) {
  PipeLogWriter writer(log);
  for (const double stamp : {10.0, 11.0}) {
    const Pose base(stamp, 1, 0, 0.1, 0, 0);
    writer.write(TruthPose{stamp, "groundtruth", base});
    writer.write(scanAt(stamp, base + Pose(0, 0, 1.2, 0, 0.3, 0)));
  }
  writer.write(ObjectMotion{11.5, NodeId{4}, Pose(0.1, 0, 0, 0, 0, 0)});
  writer.write(CloudScan{2, 12.0, "lidar", Pose(5, 0, 0, 0, 0, 0), {{1.F, 2.F, 3.F}}});
  writer.finish();
}

TEST(Helper, WrittenLogsReadBackAndAreDeterministic) {
  const Folder folder;
  writeTwoScans(folder.path / "a.rawlog");
  writeTwoScans(folder.path / "b.rawlog");
  EXPECT_EQ(contentOf(folder.path / "a.rawlog"), contentOf(folder.path / "b.rawlog"));

  const auto items = itemsOf(optionsFor(folder.path / "a.rawlog"));
  ASSERT_EQ(items.size(), 4U);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& z = std::get<Measurement>(items[i]);
    const double stamp = 10.0 + static_cast<double>(i);
    const Pose expected = Pose(stamp, 1, 0, 0.1, 0, 0) + Pose(0, 0, 1.2, 0, 0.3, 0);
    EXPECT_LT((toIsometry(z.world_T_sensor).matrix() - toIsometry(expected).matrix()).norm(), 1e-9);
    const auto sent = scanAt(stamp, expected);
    for (std::size_t p = 0; p < 20; ++p)
      EXPECT_NEAR(z.image->depth[p], p == 4 ? 0.F : sent.image.depth[p], 0.0005F) << p;
  }
  EXPECT_EQ(std::get<ObjectMotion>(items[2]).node, NodeId{4});
  EXPECT_EQ(std::get<SkippedScan>(items[3]).reason, "no pose at its time");  // the cloud had no true pose
}

TEST(Helper, AnUnfinishedLogLeavesNothingBehind) {
  const Folder folder;
  {
    PipeLogWriter writer(folder.path / "a.rawlog");
    writer.write(scanAt(1.0, Pose()));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

TEST(Helper, ALogThatCannotBeWrittenIsAFileError) {
  EXPECT_THROW(
      {
        PipeLogWriter writer("/no/such/folder/a.rawlog");
        writer.finish();
      },
      FileError);
}

TEST(Helper, VerbsRunThrough) {
  const Folder folder;
  EXPECT_EQ(runHelper({"info", "/no/such.rawlog"}), 3);
  EXPECT_EQ(runHelper({"info", folder.write("log.rawlog", test::sweep(1)).string(), "--json"}), 0);
  EXPECT_EQ(runHelper({"no-such-verb"}), 2);
}

}  // namespace
}  // namespace hoctomap
