// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/mrpt_io/FileHash.h"
#include "hoctomap/mrpt_io/LogReader.h"
#include "log_objects.h"

namespace hoctomap {
namespace {

using test::DepthSpec;
using test::errorOf;
using test::Folder;
using test::only;
using test::optionsFor;
using test::readLog;

std::vector<std::uint64_t> scanNumbers(const std::vector<StreamMessage>& messages) {
  std::vector<std::uint64_t> numbers;
  for (const auto& scan : only<DepthScan>(messages)) numbers.push_back(scan.scan);
  return numbers;
}

std::vector<StreamMessage> readBytes(const std::string& bytes, LogReadOptions options = {}) {
  const Folder folder;
  options.logs = {folder.write("log.rawlog", bytes)};
  return readLog(options);
}

/// That `messages` are the five scans of sweep(5) with their poses.
void expectSweep(const std::vector<StreamMessage>& messages) {
  const auto scans = only<DepthScan>(messages);
  ASSERT_EQ(scans.size(), 5U);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(scans[i].scan, i);
    EXPECT_EQ(scans[i].sensor, "RGBD");
    EXPECT_DOUBLE_EQ(scans[i].world_T_sensor.x(), static_cast<double>(i));
    EXPECT_EQ(scans[i].image.camera.width, 8);
    EXPECT_EQ(scans[i].image.camera.height, 6);
    EXPECT_FLOAT_EQ(scans[i].image.depth.at(17), 1.0F + 0.001F * static_cast<float>(i));
  }
  EXPECT_EQ(only<StreamHeader>(messages).at(0).total_scans, 5U);
  EXPECT_EQ(only<StreamEnd>(messages).at(0).used, 5U);
}

TEST(LogReader, ReadsPlainGzAndSeveralGzMembers) {
  expectSweep(readBytes(test::sweep(5)));
  expectSweep(readBytes(test::gz(test::sweep(5))));
  const std::string bytes = test::sweep(5);
  expectSweep(readBytes(test::gz(bytes.substr(0, 1000)) + test::gz(bytes.substr(1000))));
}

TEST(LogReader, ReadsAWholeRawlogObjectAndSensoryFrames) {
  std::vector<DepthSpec> scans(5);
  std::string frames;
  for (int i = 0; i < 5; ++i) {
    scans[static_cast<std::size_t>(i)].stamp = 100.0 + i;
    scans[static_cast<std::size_t>(i)].value = static_cast<std::uint16_t>(1000 + i);
    frames += test::poseObject(100.0 + i, "groundtruth", Pose(i, 0, 0, 0, 0, 0));
    frames += test::frameObject({scans[static_cast<std::size_t>(i)]});
  }
  expectSweep(readBytes(test::rawlogObject(scans)));
  expectSweep(readBytes(frames));
}

TEST(LogReader, SeveralLogsAreNumberedThroughAndKeepTheirOwnPoses) {
  const Folder folder;
  LogReadOptions options = optionsFor(folder.write("a.rawlog", test::sweep(2)));
  DepthSpec spec;
  spec.stamp = 100.0;  // a time that log a has too, with another pose
  options.logs.push_back(folder.write(
      "b.rawlog", test::poseObject(100.0, "groundtruth", Pose(50, 0, 0, 0, 0, 0)) + test::depthObject(spec)));
  const auto scans = only<DepthScan>(readLog(options));
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans[2].scan, 2U);
  EXPECT_DOUBLE_EQ(scans[2].world_T_sensor.x(), 50.0);
}

TEST(LogReader, SimpleMapsBringTheirPoses) {
  DepthSpec spec;
  spec.base_T_sensor = Pose(0, 0, 1, 0, 0, 0);
  const auto messages = readBytes(test::gz(test::simpleMapObject(spec, Pose(3, 0, 0, M_PI / 2, 0, 0))));
  const auto scans = only<DepthScan>(messages);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_LT(
      (toIsometry(scans[0].world_T_sensor).matrix() - toIsometry(Pose(3, 0, 1, M_PI / 2, 0, 0)).matrix())
          .norm(),
      1e-12);
}

TEST(LogReader, ComposesRobotAndSensorPoseAndLevels) {
  DepthSpec spec;
  spec.stamp = 1.0;
  spec.base_T_sensor = Pose(0.1, 0.2, 1.3, 0.4, 0.5, 0.6);
  const Pose base(1, 2, 3, -0.3, 0.1, 0.2);
  const std::string log = test::poseObject(1.0, "groundtruth", base) + test::depthObject(spec);
  LogReadOptions options;
  options.up = {0.0, 1.0, 0.0};
  const Pose expected = base + spec.base_T_sensor;
  const auto plain = only<DepthScan>(readBytes(log)).at(0).world_T_sensor;
  const auto level = only<DepthScan>(readBytes(log, options)).at(0).world_T_sensor;
  EXPECT_LT((toIsometry(plain).matrix() - toIsometry(expected).matrix()).norm(), 1e-9);
  EXPECT_LT((toIsometry(level).matrix() - toIsometry(levelled(options.up) + expected).matrix()).norm(), 1e-9);
}

TEST(LogReader, RangeAlongTheRayBecomesDepth) {
  DepthSpec spec;
  spec.is_depth = false;
  spec.units = 0.002F;
  LogReadOptions options;
  options.poses = "identity";
  const auto scan = only<DepthScan>(readBytes(test::depthObject(spec), options)).at(0);
  const auto& camera = scan.image.camera;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u)
      EXPECT_NEAR(camera.point(u, v, static_cast<double>(scan.image.at(u, v))).norm(), 2.0, 1e-5);
  }
}

TEST(LogReader, CloudsAndLasersKeepTheirPoints) {
  LogReadOptions options;
  options.poses = "identity";
  const PointCloud points{{1.F, 2.F, 3.F}, {0.001F, 0.F, 0.F}, {0.001F, 0.F, 0.F}};
  const auto clouds = only<CloudScan>(readBytes(
      test::cloudObject(1.0, "lidar", points) + test::laserObject(2.0, {1.F, 2.F, 5.F}, 5.F), options));
  ASSERT_EQ(clouds.size(), 2U);
  EXPECT_EQ(clouds[0].sensor_points, points);
  // Three rays from -90 to +90 degrees; the last one saw nothing.
  ASSERT_EQ(clouds[1].sensor_points.size(), 2U);
  EXPECT_LT((clouds[1].sensor_points[0] - Eigen::Vector3f(0.F, -1.F, 0.F)).norm(), 1e-5F);
  EXPECT_LT((clouds[1].sensor_points[1] - Eigen::Vector3f(2.F, 0.F, 0.F)).norm(), 1e-5F);
}

TEST(LogReader, SelectionCountsAllScansAndSkipsNone) {
  const std::string log = test::sweep(10);
  LogReadOptions options;
  options.start = 2;
  options.every = 3;
  EXPECT_EQ(scanNumbers(readBytes(log, options)), (std::vector<std::uint64_t>{2, 5, 8}));
  options.max_scans = 2;
  const auto messages = readBytes(log, options);
  EXPECT_EQ(scanNumbers(messages), (std::vector<std::uint64_t>{2, 5}));
  EXPECT_TRUE(only<SkippedScan>(messages).empty());
  options.resume_at = 4;  // the same run, continued
  EXPECT_EQ(scanNumbers(readBytes(log, options)), (std::vector<std::uint64_t>{5}));
  options.start = 10;
  EXPECT_NE(errorOf<InputError>([&] { readBytes(log, options); }).find("no scan chosen"), std::string::npos);
}

TEST(LogReader, EndsBeforeAScan) {
  const std::string log = test::sweep(10);
  LogReadOptions options;
  options.start = 3;
  options.end = 6;
  EXPECT_EQ(scanNumbers(readBytes(log, options)), (std::vector<std::uint64_t>{3, 4, 5}));
  options.every = 2;
  const auto messages = readBytes(log, options);
  EXPECT_EQ(scanNumbers(messages), (std::vector<std::uint64_t>{3, 5}));
  EXPECT_EQ(only<StreamHeader>(messages).at(0).chosen_scans, 2U);
  options.end = 100;
  EXPECT_EQ(scanNumbers(readBytes(log, options)), (std::vector<std::uint64_t>{3, 5, 7, 9}));
  options.end = 3;
  EXPECT_NE(errorOf<InputError>([&] { readBytes(log, options); }).find("--end 3"), std::string::npos);
}

TEST(LogReader, ASampleIsPairsSpreadOverWhatIsChosen) {
  const std::string log = test::sweep(23);
  LogReadOptions options;
  options.sample_pairs = 3;
  const auto messages = readBytes(log, options);
  EXPECT_EQ(scanNumbers(messages), (std::vector<std::uint64_t>{0, 1, 7, 8, 15, 16}));
  EXPECT_EQ(only<StreamHeader>(messages).at(0).chosen_scans, 23U) << "what there is to judge";
  options.start = 3;
  options.every = 2;  // 10 of them
  EXPECT_EQ(scanNumbers(readBytes(log, options)), (std::vector<std::uint64_t>{3, 5, 9, 11, 15, 17}));
  options.end = 15;  // 6 of them
  EXPECT_EQ(scanNumbers(readBytes(log, options)), (std::vector<std::uint64_t>{3, 5, 7, 9, 11, 13}));
}

TEST(LogReader, MaxScansCountsUsedScans) {
  DepthSpec broken;
  broken.stamp = 99.5;
  broken.fx = 0.0;
  LogReadOptions options;
  options.max_scans = 2;
  const auto messages = readBytes(test::depthObject(broken) + test::sweep(5), options);
  EXPECT_EQ(scanNumbers(messages), (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(only<SkippedScan>(messages).size(), 1U);
}

TEST(LogReader, ChoosesSensors) {
  DepthSpec other;
  other.label = "SECOND";
  other.stamp = 100.5;
  const std::string log = test::sweep(2) + test::depthObject(other);
  LogReadOptions options;
  options.sensors = {"SECOND"};
  options.max_gap_s = 2.0;  // it stands between two poses
  EXPECT_EQ(scanNumbers(readBytes(log, options)), (std::vector<std::uint64_t>{2}));
  options.sensors = {"NONE"};
  EXPECT_THROW(readBytes(log, options), InputError);
}

TEST(LogReader, UnusableScansAreSkippedWithAReason) {
  DepthSpec no_camera;
  no_camera.fx = 0.0;
  DepthSpec no_units;
  no_units.units = 0.0F;
  DepthSpec missing;
  missing.external = "gone.bin";
  const PointCloud empty;
  LogReadOptions options;
  options.poses = "identity";
  const auto messages = readBytes(test::depthObject(no_camera) + test::depthObject(no_units) +
                                      test::depthObject(missing) + test::cloudObject(1.0, "c", empty),
                                  options);
  const auto skipped = only<SkippedScan>(messages);
  ASSERT_EQ(skipped.size(), 3U);
  EXPECT_EQ(skipped[0].reason, "camera parameters are zero or not finite");
  EXPECT_EQ(skipped[1].reason, "range units are not positive");
  EXPECT_EQ(skipped[2].reason, "missing external file");
  EXPECT_EQ(only<CloudScan>(messages).size(), 1U);  // an empty cloud is a scan
  EXPECT_EQ(only<StreamEnd>(messages).at(0).skipped, 3U);
}

TEST(LogReader, AScanWithoutAPoseAtItsTimeIsSkipped) {
  DepthSpec late;
  late.stamp = 200.0;
  const auto messages = readBytes(test::sweep(2) + test::depthObject(late));
  const auto skipped = only<SkippedScan>(messages);
  ASSERT_EQ(skipped.size(), 1U);
  EXPECT_EQ(skipped[0].scan, 2U);
  EXPECT_EQ(skipped[0].reason, "no pose at its time");
}

TEST(LogReader, ExternalNamesMustStayInTheImagesFolder) {
  const Folder folder;
  std::filesystem::create_directories(folder.path / "log_Images");
  std::filesystem::create_symlink("/etc/passwd", folder.path / "log_Images" / "link.bin");
  for (const char* name : {"../secret.bin", "/etc/passwd", "a/../../x.bin", "link.bin"}) {
    DepthSpec spec;
    spec.external = name;
    auto options = optionsFor(folder.write("log.rawlog", test::depthObject(spec)));
    options.poses = "identity";
    const std::string error = errorOf<InputError>([&] { readLog(options); });
    EXPECT_NE(error.find("external file"), std::string::npos) << name << ": " << error;
  }
}

TEST(LogReader, FilesBesideALogAreAPartOfWhatItIsKnownBy) {
  const Folder folder;
  std::filesystem::create_directories(folder.path / "log_Images");
  DepthSpec inside;
  DepthSpec outside;
  outside.external = "range.bin";
  auto options =
      optionsFor(folder.write("log.rawlog", test::depthObject(inside) + test::depthObject(outside)));
  options.poses = "identity";
  const auto put = [&](const std::string& name, const std::string& content) {
    static_cast<void>(folder.write("log_Images/" + name, content));
  };
  const auto identity = [&] {
    ReadProgress progress;
    return LogReader(options, progress).header().log_sha256.at(0);
  };
  const std::string missing = identity();
  put("range.bin", "some content");
  const std::string some = identity();
  put("range.bin", "same length!");
  const std::string other = identity();
  EXPECT_NE(some, missing);
  EXPECT_NE(other, some);
  EXPECT_NE(other, missing);
  put("range.bin", "some content");
  put("nobody_names_me.bin", "x");
  EXPECT_EQ(identity(), some);
}

TEST(LogReader, ALogWithoutFilesBesideItIsKnownByItsBytes) {
  const Folder folder;
  const auto options = optionsFor(folder.write("log.rawlog", test::sweep(2)));
  EXPECT_EQ(only<StreamHeader>(readLog(options)).at(0).log_sha256,
            (std::vector<std::string>{sha256OfFile(options.logs[0])}));
}

TEST(LogReader, NullObjectsAreCountedAndPassedOver) {
  const auto messages = readBytes(test::nullObject() + test::sweep(5) + test::nullObject());
  expectSweep(messages);
  ASSERT_EQ(only<StreamWarning>(messages).size(), 1U);
  EXPECT_NE(only<StreamWarning>(messages)[0].text.find("2 null objects"), std::string::npos);
}

TEST(LogReader, SensorsWithoutPointsAreWarnedOfOnce) {
  const auto messages = readBytes(test::sweep(5) + test::imuObject(1.0) + test::imuObject(2.0));
  expectSweep(messages);
  ASSERT_EQ(only<StreamWarning>(messages).size(), 1U);
  EXPECT_NE(only<StreamWarning>(messages)[0].text.find("2 observations without 3D points"),
            std::string::npos);
  EXPECT_NE(errorOf<InputError>([] {
              LogReadOptions options;
              options.poses = "identity";
              readBytes(test::imuObject(1.0), options);
            }).find("no usable observation"),
            std::string::npos);
}

TEST(LogReader, ObjectMotionsAreNoPoseSource) {
  const Pose motion(0.1, 0, 0, 0.5, 0, 0);
  const auto messages = readBytes(test::sweep(5) + test::poseObject(103.5, "object_motion/12", motion) +
                                  test::poseObject(103.5, "object_motion/x", motion));
  expectSweep(messages);
  const auto motions = only<ObjectMotion>(messages);
  ASSERT_EQ(motions.size(), 1U);
  EXPECT_EQ(motions[0].node, NodeId{12});
  EXPECT_LT((toIsometry(motions[0].motion).matrix() - toIsometry(motion).matrix()).norm(), 1e-9);
  EXPECT_EQ(only<StreamWarning>(messages).size(), 1U);
}

TEST(LogReader, PoseSourceByTheContract) {
  DepthSpec spec;
  spec.stamp = 10.0;
  const std::string scan = test::depthObject(spec);
  const std::string a = test::poseObject(10.0, "a", Pose(1, 0, 0, 0, 0, 0));
  const std::string b = test::poseObject(10.0, "b", Pose(2, 0, 0, 0, 0, 0));
  const std::string truth = test::poseObject(10.0, "groundtruth", Pose(3, 0, 0, 0, 0, 0));
  const auto x = [](const std::string& log, const LogReadOptions& options = {}) {
    return only<DepthScan>(readBytes(log, options)).at(0).world_T_sensor.x();
  };
  EXPECT_DOUBLE_EQ(x(a + scan), 1.0);              // the only label
  EXPECT_DOUBLE_EQ(x(a + b + truth + scan), 3.0);  // several: groundtruth
  EXPECT_NE(errorOf<InputError>([&] { x(a + b + scan); }).find("'a', 'b'"), std::string::npos);
  LogReadOptions label;
  label.pose_label = "b";
  EXPECT_DOUBLE_EQ(x(a + b + truth + scan, label), 2.0);
  EXPECT_NE(errorOf<InputError>([&] { x(a + scan, label); }).find("--pose-label 'b'"), std::string::npos);
  const std::string none = errorOf<InputError>([&] { x(scan); });
  for (const char* option : {"--poses FILE", "--poses identity"})
    EXPECT_NE(none.find(option), std::string::npos);
  LogReadOptions odometry;
  odometry.poses = "odometry";
  EXPECT_DOUBLE_EQ(x(test::odometryObject(10.0, 7.0) + scan, odometry), 7.0);
  EXPECT_DOUBLE_EQ(x(test::actionAndFrame(10.0, 4.0), odometry), 4.0);
  EXPECT_THROW(x(a + scan, odometry), InputError);
  const Folder folder;
  LogReadOptions file;
  file.poses = folder.write("poses.txt", "9.8 8 0 0 0 0 0\n10.2 10 0 0 0 0 0\n").string();
  EXPECT_NEAR(x(a + scan, file), 9.0, 1e-6);
}

// MRPT draws them as it reads: 128 GiB, if it found them, and a quarter of a day.
TEST(LogReader, ParticlesOfActionsAreNotDrawn) {
  LogReadOptions odometry;
  odometry.poses = "odometry";
  const std::string log = test::actionAndFrame(10.0, 4.0, 0xFFFFFFFF) + test::actionAndFrame(11.0, 0.5, 300);
  const auto scans = only<DepthScan>(readBytes(log, odometry));
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_DOUBLE_EQ(scans[0].world_T_sensor.x(), 4.0);
  EXPECT_DOUBLE_EQ(scans[1].world_T_sensor.x(), 4.5);
}

TEST(LogReader, PosesBeyondAllMeasureAreAnErrorWithTheirPlace) {
  DepthSpec far;
  far.base_T_sensor = Pose(1e300, 0, 0, 0, 0, 0);
  LogReadOptions options;
  options.poses = "identity";
  for (const std::string& log :
       {test::depthObject(far), test::sweep(1) + test::poseObject(1.0, "p", far.base_T_sensor)}) {
    const std::string error = errorOf<InputError>([&] { readBytes(log, options); });
    EXPECT_NE(error.find("1000 km"), std::string::npos) << error;
    EXPECT_NE(error.find("object"), std::string::npos) << error;
  }
}

TEST(LogReader, TwoPosesAtOneTimeAreAnError) {
  const std::string log = test::poseObject(100.0, "groundtruth", Pose(9, 0, 0, 0, 0, 0)) + test::sweep(2);
  EXPECT_NE(errorOf<InputError>([&] { readBytes(log); }).find("same time"), std::string::npos);
}

}  // namespace
}  // namespace hoctomap
