// SPDX-License-Identifier: BSD-3-Clause
// The tables of a map (events, existence, scans, times) as they are read back, and what is no such table.
#include "hoctomap/io/MapTables.h"

#include <gtest/gtest.h>

#include <numbers>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/Sha256.h"
#include "random_map.h"

namespace hoctomap {
namespace {

class MapTables : public ::testing::Test {
 protected:
  MapTables() {
    MapDirectory writer(map(), test::mapOptions(MapOpenMode::create));
    writer.append(test::reportOf(hierarchy_, NodeId{1}, 0));
    writer.append(scanRow(measurement_));
    writer.append(
        ScanRow{.scan = 1, .stamp = 2.5, .sensor = "a \"b\",\nc", .skipped = "no pose, at its time"});
    writer.append(TimingRow{0, 3, 0.5, {}, 0.25});
    writer.append(TimingRow{7, 3, 0.5, {}, 0.25});  // of a scan that was not committed
    writer.commit({.hierarchy = hierarchy_, .removed = {}, .scans = 2});
  }
  [[nodiscard]] std::filesystem::path map() const { return folder_.path() / "map"; }
  /// Other bytes in a table, and a manifest that vouches for them.
  [[nodiscard]] Manifest forged(FileRecord Manifest::*table, const std::string& text) const {
    Manifest manifest = readManifest(map());
    FileRecord& file = manifest.*table;
    file = {file.path, text.size(), sha256Hex(text)};
    test::writeText(map() / file.path, text);
    return manifest;
  }
  static void expectRefused(const std::function<void()>& action, const std::string& word) {
    try {
      action();
      FAIL() << word;
    } catch (const MapError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
  /// A map as it was before there was a table of scans.
  void forgetScans() const {
    Manifest manifest = readManifest(map());
    manifest.scan_table.reset();
    test::writeText(map() / "hierarchy.yaml", toYaml(manifest));
    std::filesystem::remove(map() / "scans.csv");
  }

  test::Rng rng_{31};
  test::TemporaryFolder folder_;
  MapHierarchy hierarchy_ = test::randomHierarchy(rng_, 3);
  const Measurement measurement_ = [this] {
    Measurement z;
    z.stamp = 1.5;
    z.sensor = "RGBD";
    z.world_T_sensor = test::randomPose(rng_, 1.0);
    z.image = DepthImage{{64, 48, 32.0, 24.0, 31.5, 23.5}, {}};  // 90 degrees both ways
    return z;
  }();
};

TEST_F(MapTables, AreReadBack) {
  const Manifest manifest = readManifest(map());
  const auto events = readEvents(map(), manifest);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].node, NodeId{1});
  EXPECT_EQ(events[0].detail, "a \"detail\", quoted");
  EXPECT_EQ(readExistence(map(), manifest).at(0).present, 40U);
  const auto scans = readScans(map(), manifest);
  ASSERT_EQ(scans.size(), 2U);
  ASSERT_TRUE(scans[0].world_T_sensor);
  EXPECT_LT((toIsometry(*scans[0].world_T_sensor).matrix() - toIsometry(measurement_.world_T_sensor).matrix())
                .norm(),
            1e-9);
  EXPECT_NEAR(scans[0].fov_x.value_or(0.0), 90.0, 1e-9);
  EXPECT_NEAR(scans[0].fov_y.value_or(0.0), 90.0, 1e-9);
  EXPECT_FALSE(scans[1].world_T_sensor);
  EXPECT_FALSE(scans[1].fov_x);
  EXPECT_EQ(scans[1].sensor, "a \"b\",\nc");
  EXPECT_EQ(scans[1].skipped, "no pose, at its time");
  EXPECT_EQ(readTiming(map(), manifest).size(), 1U);
  EXPECT_FALSE(scanRow(Measurement()).fov_x) << "no image";
}

TEST_F(MapTables, WhatIsNoSuchTableIsRefusedWithItsRow) {
  const std::string header = "scan,time,event,node,label,existence,detail\n";
  const auto refused = [&](const std::string& text, const std::string& word) {
    const Manifest manifest = forged(&Manifest::events, text);
    expectRefused([&] { static_cast<void>(readEvents(map(), manifest)); }, word);
  };
  EXPECT_TRUE(readEvents(map(), forged(&Manifest::events, "")).empty());
  refused("scan,time,event\n1,2,created\n", "row 2: has no column `node`");
  refused(header + "1,2,created\n", "another number of fields");
  refused(header + "x,2,created,1,table,0.5,\n", "no whole number: x");
  refused(header + "1,x,created,1,table,0.5,\n", "no number: x");
  refused(header + "1,2,created,5000000000,table,0.5,\n", "no id of a node");
  for (const char* end : {"last", "\"never closed\n"}) {
    const Manifest manifest = forged(&Manifest::events, header + "1,2,created,1,table,0.5," + end);
    EXPECT_EQ(readEvents(map(), manifest).size(), 1U) << end;
  }
}

TEST_F(MapTables, AMapWithoutATableOfScansIsReadAndContinued) {
  forgetScans();
  std::filesystem::remove(map() / "timing.csv");
  const Manifest manifest = readManifest(map());
  EXPECT_TRUE(readScans(map(), manifest).empty());
  EXPECT_TRUE(readTiming(map(), manifest).empty());
  EXPECT_TRUE(checkMap(map()).damage.empty());
  {
    MapDirectory writer(map(), test::mapOptions(MapOpenMode::resume));
    writer.append(ScanRow{.scan = 2, .stamp = 3.5});
    writer.commit({.hierarchy = hierarchy_, .removed = {}, .scans = 3});
  }
  EXPECT_EQ(readScans(map(), readManifest(map())).at(0).scan, 2U);
}

TEST_F(MapTables, AMapWithoutATableOfScansIsOverwritten) {
  forgetScans();
  std::filesystem::remove(map() / "config.ini");  // what is missing already stays missing
  MapDirectory writer(map(), test::mapOptions(MapOpenMode::overwrite));
  writer.commit({.hierarchy = hierarchy_, .removed = {}, .scans = 1});
  EXPECT_TRUE(checkMap(map()).damage.empty());
  EXPECT_FALSE(std::filesystem::exists(map() / "previous"));
}

TEST_F(MapTables, AnEndOfTheLogThatAddsNothingIsNone) {
  MapDirectory writer(map(), test::mapOptions(MapOpenMode::resume));
  writer.appendEnd(UpdateReport());
  writer.commit({.hierarchy = hierarchy_, .removed = {}, .scans = 2});
  EXPECT_FALSE(readManifest(map()).events_before_end);
}

}  // namespace
}  // namespace hoctomap
