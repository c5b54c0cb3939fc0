// SPDX-License-Identifier: BSD-3-Clause
// Scans whose ranges or points stand in files beside the log.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "hoctomap/geometry/Errors.h"
#include "log_objects.h"

namespace hoctomap {
namespace {

std::string numbers(std::initializer_list<std::uint32_t> values) {
  std::string bytes;
  for (const std::uint32_t value : values) {
    bytes.resize(bytes.size() + sizeof value);
    std::memcpy(bytes.data() + bytes.size() - sizeof value, &value, sizeof value);
  }
  return bytes;
}

/// What MRPT writes for an image of 6 x 8 pixels, before it is compressed.
std::string image() {
  std::string bytes = numbers({6, 8});
  for (char i = 0; i < 48; ++i) bytes += {i, 3};
  return bytes;
}

/// A log of one scan in a file beside it.
class ExternalFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(images()); }
  [[nodiscard]] std::filesystem::path images() const { return folder_.path / "log_Images"; }
  [[nodiscard]] std::vector<StreamMessage> read(const std::string& object) const {
    auto options = test::optionsFor(folder_.write("log.rawlog", object));
    options.poses = "identity";
    return test::readLog(options);
  }
  [[nodiscard]] std::vector<StreamMessage> readImage(const std::string& file) const {
    test::DepthSpec spec;
    spec.external = "range.bin";
    static_cast<void>(folder_.write("log_Images/range.bin", file));
    return read(test::depthObject(spec));
  }
  void expectSkipped(const std::vector<StreamMessage>& messages, const std::string& what) const {
    const auto skipped = test::only<SkippedScan>(messages);
    ASSERT_EQ(skipped.size(), 1U) << what;
    EXPECT_EQ(skipped[0].reason, "damaged external file") << what;
  }
  test::Folder folder_;
};

TEST_F(ExternalFile, AnImageIsReadPlainAndCompressed) {
  for (const std::string& file : {image(), test::gz(image())}) {
    const auto scans = test::only<DepthScan>(readImage(file));
    ASSERT_EQ(scans.size(), 1U);
    for (std::size_t i = 0; i < 48; ++i)
      EXPECT_FLOAT_EQ(scans[0].image.depth.at(i), 0.001F * static_cast<float>(3 * 256 + i));
  }
}

TEST_F(ExternalFile, PointsAreReadAsMrptWritesThem) {
  PointCloud points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(0.01F * static_cast<float>(i), 2.F, -1.F);
  const std::string object = test::externalPointsObject(points, images(), "points");
  const auto scans = test::only<CloudScan>(read(object));
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].sensor_points, points);

  std::filesystem::resize_file(images() / "points.bin",
                               std::filesystem::file_size(images() / "points.bin") - 9);
  expectSkipped(read(object), "cut");
}

TEST_F(ExternalFile, WhatIsCutOrContinuedIsASkippedScan) {
  for (const std::string& file : {image(), test::gz(image())}) {
    for (std::size_t size = 0; size < file.size(); ++size)
      expectSkipped(readImage(file.substr(0, size)), "cut at " + std::to_string(size));
  }
  expectSkipped(readImage(image() + "x"), "continued");
  expectSkipped(readImage("what is no image at all, and long enough to have a count"), "text");
}

TEST_F(ExternalFile, WhatIsFlippedInACompressedImageIsASkippedScan) {
  const std::string file = test::gz(image());
  const auto whole = test::only<DepthScan>(readImage(file)).at(0).image.depth;
  constexpr std::size_t kHeader = 10;  // of gzip: times and names, which mean nothing
  std::size_t without_effect = 0;
  for (std::size_t at = kHeader; at < file.size(); ++at) {
    std::string flipped = file;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    const auto messages = readImage(flipped);
    const auto scans = test::only<DepthScan>(messages);
    if (scans.empty()) {
      expectSkipped(messages, "flipped at " + std::to_string(at));
    } else {
      EXPECT_EQ(scans[0].image.depth, whole);
      ++without_effect;
    }
  }
  EXPECT_LE(without_effect, 1U) << "the last byte of the compressed data has bits that mean nothing";
}

TEST_F(ExternalFile, CountsAreNotBelieved) {
  for (const auto& size : {numbers({0xFFFFFFFF, 0xFFFFFFFF}), numbers({100'000, 100'000}), numbers({0, 8})}) {
    expectSkipped(readImage(size + image().substr(8)), "plain");
    expectSkipped(readImage(test::gz(size + image().substr(8))), "compressed");
  }
}

TEST_F(ExternalFile, MoreThanTenMillionPixelsAreALimit) {
  const std::string large = numbers({4'000, 4'000}) + std::string(std::size_t{2} * 4'000 * 4'000, '\0');
  EXPECT_THROW(readImage(test::gz(large)), LimitError);
}

/// A log of one cloud in a file beside it.
class ExternalCloud : public ExternalFile {
 protected:
  [[nodiscard]] std::vector<StreamMessage> readCloud(test::CloudFormat format,
                                                     const std::string& file) const {
    static_cast<void>(folder_.write("log_Images/cloud", file));
    return read(test::externalCloudObject(format, "cloud"));
  }
  void expectPoints(test::CloudFormat format, const std::string& file) const {
    const auto scans = test::only<CloudScan>(readCloud(format, file));
    ASSERT_EQ(scans.size(), 1U) << file;
    EXPECT_EQ(scans[0].sensor_points, points_) << file;
  }
  [[nodiscard]] std::string records() const {
    std::string bytes;
    for (const auto& p : points_) {
      const float record[4] = {p.x(), p.y(), p.z(), 0.5F};
      bytes.append(reinterpret_cast<const char*>(record), sizeof record);
    }
    return bytes;
  }
  const PointCloud points_{{1.F, 2.F, 3.F}, {-0.5F, 0.25F, 1e-3F}, {4.F, 5.F, 6.F}};
};

TEST_F(ExternalCloud, IsReadInEachOfItsFormats) {
  for (const std::string& map : {test::mapObject(points_), test::gz(test::mapObject(points_))})
    expectPoints(test::CloudFormat::map_object, map);
  for (const std::string& file : {records(), test::gz(records())})
    expectPoints(test::CloudFormat::records, file);
  for (const char* text :
       {"1 2 3\n-0.5 .25 1e-3\n4 5 6", "# x y z\n1,2,3,9\r\n\n-0.5, 0.25, 0.001, 9\n4 5 6 9\n"})
    expectPoints(test::CloudFormat::text, text);
  EXPECT_EQ(
      test::only<SkippedScan>(read(test::externalCloudObject(test::CloudFormat::text, "no"))).at(0).reason,
      "missing external file");
}

TEST_F(ExternalCloud, WhatIsCutOrContinuedIsASkippedScan) {
  for (const std::string& map : {test::mapObject(points_), test::gz(test::mapObject(points_))}) {
    for (std::size_t size = 0; size < map.size(); ++size)
      expectSkipped(readCloud(test::CloudFormat::map_object, map.substr(0, size)), std::to_string(size));
    expectSkipped(readCloud(test::CloudFormat::map_object, map + "x"), "continued");
  }
  for (const std::string& file : {records() + "x", test::gz(records()).substr(0, 40)})
    expectSkipped(readCloud(test::CloudFormat::records, file), "records");
  for (const char* text : {"", "1 2", "1 2 3\n4 5 6 7\n", "1 2 three\n", "1 2 3\n4 5\n"})
    expectSkipped(readCloud(test::CloudFormat::text, text), text);
}

TEST_F(ExternalCloud, WhatIsNoCloudIsASkippedScan) {
  expectSkipped(readCloud(test::CloudFormat::map_object, test::imuObject(1.0)), "another object");
  expectSkipped(readCloud(test::CloudFormat::map_object, test::nullObject()), "none");
  expectSkipped(readCloud(test::CloudFormat::map_object, records()), "another format");
  expectSkipped(readCloud(static_cast<test::CloudFormat>(77), records()), "a format that is not known");
}

TEST_F(ExternalCloud, WhatIsFlippedInACompressedMapIsASkippedScan) {
  const std::string file = test::gz(test::mapObject(points_));
  constexpr std::size_t kHeader = 10;  // of gzip: times and names, which mean nothing
  std::size_t without_effect = 0;
  for (std::size_t at = kHeader; at < file.size(); ++at) {
    std::string flipped = file;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    const auto messages = readCloud(test::CloudFormat::map_object, flipped);
    if (test::only<CloudScan>(messages).empty())
      expectSkipped(messages, "flipped at " + std::to_string(at));
    else
      ++without_effect;
  }
  EXPECT_LE(without_effect, 1U) << "the last byte of the compressed data has bits that mean nothing";
}

TEST_F(ExternalCloud, MoreThanTenMillionPointsAreALimit) {
  const std::string large(std::size_t{16} * 10'000'001, '\0');
  EXPECT_THROW(readCloud(test::CloudFormat::records, test::gz(large)), LimitError);
}

}  // namespace
}  // namespace hoctomap
