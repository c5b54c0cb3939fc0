// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <random>

#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/ScanStream.h"
#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

using Bytes = std::vector<unsigned char>;

/// An unnamed temporary file with the given content, at its start.
UniqueFd fileOf(const Bytes& bytes) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  UniqueFd fd(::dup(::fileno(file.get())));
  EXPECT_EQ(::write(fd.get(), bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  ::lseek(fd.get(), 0, SEEK_SET);
  return fd;
}

Bytes bytesOf(const std::vector<StreamMessage>& messages) {
  const UniqueFd fd = fileOf({});
  ScanStreamWriter writer(fd.get());
  std::uint64_t object = 7;
  for (const auto& message : messages) writer.write(message, {1, object++, 4242});
  Bytes bytes(static_cast<std::size_t>(::lseek(fd.get(), 0, SEEK_CUR)));
  EXPECT_EQ(::pread(fd.get(), bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  return bytes;
}

DepthScan depthScan(test::Rng& rng) {
  DepthScan scan{3, 12.5, "RGBD", test::randomPose(rng, 2.0), {{4, 3, 5.25, 5.5, 1.5, 1.0}, {}}};
  for (int i = 0; i < 12; ++i) scan.image.depth.push_back(static_cast<float>(test::uniform(rng, 0.0, 4.0)));
  scan.colour = {2, 1, {1, 2, 3, 4, 5, 6}};
  return scan;
}

std::vector<StreamMessage> oneOfEach() {
  test::Rng rng(5);
  CloudScan cloud{4,
                  13.5,
                  "lidar",
                  test::randomPose(rng, 2.0),
                  {{1.F, 2.F, 3.F}, {-1.F, 0.5F, 0.F}},
                  {{255, 0, 7}, {1, 2, 3}}};
  StreamHeader header{
      9, 8, "robot poses 'groundtruth'", {"abc", "def"}, {{"RGBD", "CObservation3DRangeScan", 9, 4, 3}}};
  return {header,
          depthScan(rng),
          cloud,
          ObjectMotion{14.0, NodeId{17}, test::randomPose(rng, 1.0)},
          SkippedScan{5, 14.5, "no pose"},
          StreamWarning{"a warning"},
          TruthPose{15.0, "groundtruth", test::randomPose(rng, 1.0)},
          StreamError{6, "too much"},
          StreamEnd{2, 1}};
}

Eigen::Matrix4d matrix(const Pose& pose) {
  return toIsometry(pose).matrix();
}

TEST(ScanStream, EveryMessageComesBack) {
  const auto sent = oneOfEach();
  const UniqueFd fd = fileOf(bytesOf(sent));
  ScanStreamReader reader(fd.get());
  std::vector<StreamMessage> got;
  for (std::size_t i = 0; i < sent.size(); ++i) {
    got.push_back(reader.read());
    EXPECT_EQ(got.back().index(), sent[i].index());
    EXPECT_EQ(reader.position(), (StreamPosition{1, 7 + i, 4242}));
  }
  const auto& header = std::get<StreamHeader>(got[0]);
  EXPECT_EQ(header.total_scans, 9U);
  EXPECT_EQ(header.chosen_scans, 8U);
  EXPECT_EQ(header.pose_source, "robot poses 'groundtruth'");
  EXPECT_EQ(header.log_sha256, (std::vector<std::string>{"abc", "def"}));
  ASSERT_EQ(header.sensors.size(), 1U);
  EXPECT_EQ(header.sensors[0].type, "CObservation3DRangeScan");
  const auto& depth = std::get<DepthScan>(got[1]);
  const auto& sent_depth = std::get<DepthScan>(sent[1]);
  EXPECT_EQ(depth.image.depth, sent_depth.image.depth);
  EXPECT_EQ(depth.image.camera.fy, 5.5);
  EXPECT_EQ(depth.colour.width, 2);
  EXPECT_EQ(depth.colour.rgb, sent_depth.colour.rgb);
  EXPECT_EQ(std::get<CloudScan>(got[2]).colours, std::get<CloudScan>(sent[2]).colours);
  EXPECT_EQ(matrix(depth.world_T_sensor), matrix(sent_depth.world_T_sensor));
  EXPECT_EQ(std::get<CloudScan>(got[2]).sensor_points, std::get<CloudScan>(sent[2]).sensor_points);
  EXPECT_EQ(std::get<ObjectMotion>(got[3]).node, NodeId{17});
  EXPECT_EQ(std::get<SkippedScan>(got[4]).reason, "no pose");
  EXPECT_EQ(std::get<StreamWarning>(got[5]).text, "a warning");
  EXPECT_EQ(matrix(std::get<TruthPose>(got[6]).world_T_base),
            matrix(std::get<TruthPose>(sent[6]).world_T_base));
  EXPECT_EQ(std::get<StreamError>(got[7]).exit_code, 6);
  EXPECT_EQ(std::get<StreamEnd>(got[8]).skipped, 1U);
}

/// Reads to the end of a stream of whatever content; only errors of this project may come out.
void readAll(const Bytes& bytes) {
  const UniqueFd fd = fileOf(bytes);
  ScanStreamReader reader(fd.get());
  for (;;) (void)reader.read();
}

TEST(ScanStream, CutAnywhereIsAnInputError) {
  const Bytes bytes = bytesOf(oneOfEach());
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_THROW(readAll(cut), InputError) << length;
  }
}

TEST(ScanStream, MutationsNeverGiveAnythingButAnError) {
  const Bytes bytes = bytesOf(oneOfEach());
  test::Rng rng(11);
  for (int round = 0; round < 3000; ++round) {
    Bytes mutated = bytes;
    for (int flips = 1 + static_cast<int>(rng() % 4); flips > 0; --flips)
      mutated[rng() % mutated.size()] = static_cast<unsigned char>(rng());
    EXPECT_THROW(readAll(mutated), Error);
  }
}

void expectRefused(const StreamMessage& message) {
  EXPECT_THROW(readAll(bytesOf({message})), InputError);
}

TEST(ScanStream, BadCamerasAndStampsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  test::Rng rng(3);
  auto scan = depthScan(rng);
  const UniqueFd good = fileOf(bytesOf({scan}));
  EXPECT_NO_THROW((void)ScanStreamReader(good.get()).read());
  for (const double fx : {0.0, -1.0, nan}) {
    scan.image.camera.fx = fx;
    const UniqueFd fd = fileOf(bytesOf({scan}));
    EXPECT_THROW((void)ScanStreamReader(fd.get()).read(), InputError) << fx;
  }
  expectRefused(SkippedScan{1, nan, "x"});
}

TEST(ScanStream, PosesThatAreNoRotationsAreRefused) {
  // The 12 numbers of the pose stand at the end of a motion message.
  const Bytes good = bytesOf({ObjectMotion{0.0, NodeId{1}, Pose()}});
  const std::size_t first = good.size() - 12 * sizeof(double);
  for (const double value : {2.0, -1.0, 1.0 + 1e-5, std::numeric_limits<double>::infinity()}) {
    Bytes bad = good;
    std::memcpy(bad.data() + first, &value, sizeof value);
    const UniqueFd fd = fileOf(bad);
    EXPECT_THROW((void)ScanStreamReader(fd.get()).read(), InputError) << value;
  }
}

TEST(ScanStream, LimitsHoldBeforeMemoryIsTaken) {
  test::Rng rng(3);
  const UniqueFd image = fileOf(bytesOf({depthScan(rng)}));
  EXPECT_THROW((void)ScanStreamReader(image.get(), {.max_points = 11}).read(), LimitError);
  CloudScan cloud;
  cloud.sensor_points.resize(5);
  const UniqueFd points = fileOf(bytesOf({cloud}));
  EXPECT_THROW((void)ScanStreamReader(points.get(), {.max_points = 4}).read(), LimitError);
  Bytes huge = bytesOf({StreamWarning{"x"}});
  huge[12 + 4 + 3] = 0xFF;  // highest byte of the message's length
  const UniqueFd fd = fileOf(huge);
  EXPECT_THROW((void)ScanStreamReader(fd.get()).read(), LimitError);
}

TEST(ScanStream, AnotherVersionOrOtherContentIsRefused) {
  Bytes bytes = bytesOf({StreamEnd{}});
  bytes[8] = 99;
  EXPECT_THROW(readAll(bytes), InputError);
  EXPECT_THROW(readAll({'h', 'e', 'l', 'l', 'o', ' ', 'w', 'o', 'r', 'l', 'd', '!', '!'}), InputError);
}

TEST(ScanStream, WritingToAClosedPipeIsAnErrorNotASignal) {
  int ends[2];
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  UniqueFd in(ends[1]);
  ScanStreamWriter writer(in.get());
  ::close(ends[0]);
  EXPECT_THROW(writer.write(StreamEnd{}), FileError);
  EXPECT_THROW(writer.write(StreamEnd{}), FileError);
}

TEST(ScanStream, ErrorFromASignalHandlerIsAnErrorMessage) {
  const UniqueFd fd = fileOf({});
  ScanStreamWriter writer(fd.get());
  sendErrorFromSignalHandler(fd.get(), 3, "it crashed", {2, 5, 99});
  ::lseek(fd.get(), 0, SEEK_SET);
  ScanStreamReader reader(fd.get());
  const auto error = std::get<StreamError>(reader.read());
  EXPECT_EQ(error.text, "it crashed");
  EXPECT_EQ(error.exit_code, 3);
  EXPECT_EQ(reader.position(), (StreamPosition{2, 5, 99}));
}

TEST(ScanStream, ErrorsKeepTheirTypeByExitCode) {
  EXPECT_THROW(throwStreamError({2, ""}), ConfigError);
  EXPECT_THROW(throwStreamError({3, ""}), InputError);
  EXPECT_THROW(throwStreamError({4, ""}), MapError);
  EXPECT_THROW(throwStreamError({5, ""}), FileError);
  EXPECT_THROW(throwStreamError({6, ""}), LimitError);
  for (int code = 2; code <= 6; ++code) {
    try {
      throwStreamError({code, ""});
    } catch (const Error& error) {
      EXPECT_EQ(exitCodeOf(error), code);
    }
  }
}

TEST(EscapedText, ShowsControlCharacters) {
  EXPECT_EQ(escapedText("a\nb\tc\x1b[31m"), "a\\nb\\tc\\x1b[31m");
  EXPECT_EQ(escapedText("gr\xc3\xbc\xc3\x9f"), "gr\xc3\xbc\xc3\x9f");
  EXPECT_EQ(escapedText("\xff\xc3"), "\\xff\\xc3");
  EXPECT_EQ(escapedText("\xc2\x9b"), "\\xc2\\x9b");  // a control character of the C1 set
  EXPECT_EQ(escapedText("abcdef", 3), "abc...");
}

}  // namespace
}  // namespace hoctomap
