// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>

#include "Program.h"
#include "hoctomap/geometry/Errors.h"
#include "measuring/FarNodes.h"
#include "measuring/Tasks.h"
#include "support/SharedData.h"

namespace hoctomap::test {
namespace {

/// A log of two small scans.
class Measuring : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("HOCTOMAP_MRPT", HOCTOMAP_HELPER, 1);
    auto scene = quickScene();
    scene.emplace_back("path.sweep.views=2");
    simulateLog(sourceDir() / "configs/scenes/small_objects.ini", scene, folder_ / "log.rawlog");
  }

  [[nodiscard]] Task task(const std::string& name, const std::string& variant) const {
    Task task;
    task.name = name;
    task.variant = variant;
    task.scans.log = folder_ / "log.rawlog";
    return task;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Measuring, WholeScansGiveStocksBytes) {
  Task stock = task("whole", "stock");
  Task ours = task("whole", "ours");
  stock.resolution = ours.resolution = 0.05;
  const Figures a = measure(stock);
  const Figures b = measure(ours);
  EXPECT_EQ(a.text("ot_sha256"), b.text("ot_sha256"));
  EXPECT_EQ(a.text("map_bytes"), b.text("map_bytes"));
  EXPECT_EQ(a.number("scans"), 2);
  EXPECT_GT(a.number("points"), 1e5);
  EXPECT_GT(a.number("leaves"), 1000);
}

TEST_F(Measuring, BoxesGiveTheSameBytesInEveryWay) {
  std::vector<Figures> ways;
  for (const char* variant : {"stock", "filtering", "ours"}) {
    Task boxes = task("boxes", variant);
    boxes.resolution = 0.008;
    ways.push_back(measure(boxes));
  }
  EXPECT_EQ(ways[0].text("ot_sha256"), ways[1].text("ot_sha256"));
  EXPECT_EQ(ways[0].text("ot_sha256"), ways[2].text("ot_sha256"));
  EXPECT_GE(ways[0].number("nodes"), 6);  // of eight objects
  EXPECT_GE(ways[0].number("updates"), ways[0].number("nodes"));
}

TEST_F(Measuring, CellsAreVisitedAtLeastAsOftenAsUpdated) {
  Task counted = task("cells", "");
  counted.resolution = 0.05;
  const Figures cells = measure(counted);
  EXPECT_GT(cells.number("updates"), 0);
  EXPECT_GT(cells.number("visits"), cells.number("updates"));
}

TEST_F(Measuring, MonolithicMappingIsTheWholeScan) {
  Task mapping = task("mapping", "");
  mapping.overrides = {"mapping.monolithic=true", "label.background.resolution=0.05"};
  Task whole = task("whole", "stock");
  whole.resolution = 0.05;
  EXPECT_EQ(measure(mapping).text("ot_sha256"), measure(whole).text("ot_sha256"));
}

TEST_F(Measuring, NodesOutOfViewChangeNothingOfTheMapInView) {
  Task few = task("mapping", "");
  few.far_nodes = 10;
  Task many = few;
  many.far_nodes = 50;
  const Figures a = measure(few);
  const Figures b = measure(many);
  EXPECT_EQ(b.number("nodes") - a.number("nodes"), 40);
  EXPECT_EQ(b.number("objects") - a.number("objects"), 36);  // every tenth is a table
}

TEST_F(Measuring, WarmUpScansAreNotMeasured) {
  Task mapping = task("mapping", "");
  mapping.warm_up = 1;
  EXPECT_EQ(measure(mapping).number("scans"), 1);
}

TEST_F(Measuring, UnknownNamesAreErrors) {
  EXPECT_THROW(static_cast<void>(measure(task("hole", "stock"))), ConfigError);
  EXPECT_THROW(static_cast<void>(measure(task("whole", "fast"))), ConfigError);
  EXPECT_THROW(static_cast<void>(measure(task("boxes", ""))), ConfigError);
}

TEST(FarNodes, AreOccupiedAndFarAway) {
  const MapHierarchy map = makeFarNodes(Settings(), 25);
  EXPECT_EQ(map.size(), 26U);
  for (const NodeId id : map.ids()) {
    if (id == kRootId) continue;
    EXPECT_FALSE(map.box(id).box.isEmpty());
    EXPECT_GT(map.box(id).center().norm(), 90.0);
  }
}

}  // namespace
}  // namespace hoctomap::test
