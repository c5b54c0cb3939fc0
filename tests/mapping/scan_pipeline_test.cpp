// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/ScanPipeline.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "ScriptedMapper.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

/// Gives scans 0, 1, ... of three points each; a motion before scan 2, a skipped scan instead of scan 3; at
/// the end an error, if asked for.
class ListedSource : public MeasurementSource {
 public:
  explicit ListedSource(std::size_t items, bool damaged = false) : items_(items), damaged_(damaged) {}

  [[nodiscard]] std::optional<SourceItem> next() override {
    EXPECT_EQ(std::this_thread::get_id(), owner_);
    if (asked_ == items_) {
      if (damaged_) throw InputError("cut");
      return std::nullopt;
    }
    const std::size_t i = asked_++;
    if (i == 2) return ObjectMotion{0.0, NodeId{7}, Pose()};
    if (i == 3) return SkippedScan{i, 0.0, "no pose"};
    Measurement z;
    z.scan = i;
    z.world_points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    return z;
  }
  [[nodiscard]] std::size_t asked() const { return asked_; }

 private:
  std::size_t items_;
  bool damaged_;
  std::size_t asked_ = 0;
  std::thread::id owner_ = std::this_thread::get_id();
};

/// A mapper whose segmentation counts its calls and throws at one scan.
struct CountingMapper {
  explicit CountingMapper(std::optional<std::uint64_t> throw_at = std::nullopt) {
    MappingStrategies s;
    s.segmentation = makeSegmentation([this, throw_at](const Measurement& z) {
      ++calls;
      if (z.scan == throw_at) throw LimitError("too large");
      return std::vector<Segment>{{Structure::remainder, {0, 1, 2}, {}}};
    });
    s.labeling = makeLabeling([](const Measurement&, const Segment&) { return labels::background; });
    s.association = makeAssociation(
        [](const auto&, const auto&, const auto&) -> std::optional<NodeId> { return kRootId; });
    mapper.emplace(MappingConfig{}, test::profiles(), std::move(s));
  }

  std::atomic<int> calls = 0;
  std::optional<HierarchyMapper> mapper;
};

TEST(ScanPipeline, ItemsComeInOrderWithTheirOwnPreparation) {
  for (const std::size_t threads : {1U, 2U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    CountingMapper m;
    ListedSource source(8);
    ScanPipeline pipeline(source, *m.mapper);
    std::size_t i = 0;
    while (auto next = pipeline.next()) {
      EXPECT_LE(source.asked(), i + 2) << "one item is taken ahead";
      if (const auto* z = std::get_if<Measurement>(&next->item)) {
        EXPECT_EQ(z->scan, i);
        ASSERT_TRUE(next->prepared);
        ASSERT_EQ(next->prepared->parts.size(), 1U);
        EXPECT_EQ(next->prepared->parts[0].world_points, z->world_points);
      } else {
        EXPECT_FALSE(next->prepared);
        EXPECT_EQ(std::holds_alternative<ObjectMotion>(next->item), i == 2);
        EXPECT_EQ(std::holds_alternative<SkippedScan>(next->item), i == 3);
      }
      ++i;
    }
    EXPECT_EQ(i, 8U);
    EXPECT_EQ(m.calls, 6);
    EXPECT_FALSE(pipeline.next()) << "the end stays the end";
  }
}

TEST(ScanPipeline, AnErrorOfTheSourceComesAfterAllThatStandsBeforeIt) {
  CountingMapper m;
  ListedSource source(2, true);
  ScanPipeline pipeline(source, *m.mapper);
  EXPECT_TRUE(pipeline.next());
  EXPECT_TRUE(pipeline.next());
  EXPECT_THROW(static_cast<void>(pipeline.next()), InputError);
  EXPECT_FALSE(pipeline.next());
}

TEST(ScanPipeline, AnErrorOfThePreparationComesWithItsScan) {
  for (const std::size_t threads : {1U, 2U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    CountingMapper m(1);
    ListedSource source(5);
    ScanPipeline pipeline(source, *m.mapper);
    EXPECT_TRUE(pipeline.next());
    EXPECT_THROW(static_cast<void>(pipeline.next()), LimitError);
  }
}

TEST(ScanPipeline, CanBeLeftEarly) {
  CountingMapper fine;
  CountingMapper failing(1);
  for (CountingMapper* m : {&fine, &failing}) {
    ListedSource source(5);
    ScanPipeline pipeline(source, *m->mapper);
    EXPECT_TRUE(pipeline.next());  // the next scan is being prepared; its error, if any, is nobody's
  }
}

TEST(ScanPipeline, IntegratingAPreparedScanIsIntegratingTheScan) {
  test::Mapper direct;
  test::Mapper prepared;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const test::Scan scan(i, {test::kFloor, test::kTable, test::kCup});
    const UpdateReport a = direct.integrate(scan);
    *prepared.current = &scan;
    const UpdateReport b = prepared.mapper.integrate(scan.z, prepared.mapper.prepare(scan.z));
    ASSERT_EQ(a.events.size(), b.events.size());
    for (const NodeId id : direct.h().ids()) {
      EXPECT_EQ(test::otBytes(direct.h().node(id).map()), test::otBytes(prepared.h().node(id).map()));
    }
  }
}

}  // namespace
}  // namespace hoctomap
