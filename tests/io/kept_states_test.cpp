// SPDX-License-Identifier: BSD-3-Clause
// States of earlier scans that a map keeps are read as if their log had ended there.
#include <gtest/gtest.h>

#include <limits>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/MapTables.h"
#include "hoctomap/io/OpenMap.h"
#include "random_map.h"

namespace hoctomap {
namespace {

class KeptStates : public ::testing::Test {
 protected:
  /// Commits after scans 3 and 5. After scan 3 two nodes wait, one of which has been seen well enough for the
  /// end of a log to let it in; after scan 5 none does.
  KeptStates() {
    hierarchy_.node(seen_).confirmation = {true, false, 1, 2, 300, true};
    hierarchy_.node(hardly_seen_).confirmation = {true, false, 1, 0, 20, false};
    MapDirectory writer(map(), test::mapOptions(MapOpenMode::create));
    writer.append(test::reportOf(hierarchy_, kRootId, 3));
    const SeamVotes none;
    MapState state{hierarchy_, {}, 4};
    state.keep = true;
    state.last_stamp = 12.5;
    state.seams = &none;
    writer.commit(state);
    hierarchy_.node(seen_).confirmation = {};
    hierarchy_.node(hardly_seen_).confirmation = {};
    writer.commit({hierarchy_, {}, 6});
  }
  [[nodiscard]] std::filesystem::path map() const { return folder_.path() / "map"; }

  test::Rng rng_{41};
  test::TemporaryFolder folder_;
  MapHierarchy hierarchy_ = test::randomHierarchy(rng_, 3);
  const NodeId seen_ = hierarchy_.add(labels::object, test::randomNodeMap(rng_, 0.002), Pose(), kRootId);
  const NodeId hardly_seen_ =
      hierarchy_.add(labels::object, test::randomNodeMap(rng_, 0.002), Pose(), kRootId);
};

TEST_F(KeptStates, TheEndOfTheLogLetsInWhatWasSeenEnough) {
  const StoredMap kept = readMap(map(), {3, false});
  EXPECT_TRUE(kept.hierarchy.contains(seen_));
  EXPECT_FALSE(kept.hierarchy.contains(hardly_seen_));
  EXPECT_TRUE(kept.manifest.waiting.empty());
  EXPECT_TRUE(kept.hierarchy.node(seen_).confirmation.entered_at_end);
  EXPECT_FALSE(kept.manifest.seams) << "no votes, no file";

  const auto events = readEvents(map(), kept.manifest);
  ASSERT_EQ(events.size(), 2U) << "the event of scan 3, and that it was let in";
  EXPECT_EQ(events.back().scan, 3U);
  EXPECT_EQ(events.back().time, 12.5);
  EXPECT_EQ(events.back().event, "created");
  EXPECT_EQ(events.back().node, seen_);
  EXPECT_EQ(readEvents(map(), readManifest(map())).size(), 1U);
}

TEST_F(KeptStates, OpenAndReadAreTheSameNodes) {
  for (const std::uint64_t scan : {3U, 5U}) {
    const OpenMap open(map(), scan);
    const StoredMap stored = readMap(map(), {scan, false});
    ASSERT_EQ(open.places().size(), stored.hierarchy.ids().size()) << scan;
    for (const NodePlace& place : open.places()) {
      EXPECT_TRUE(stored.hierarchy.contains(place.id)) << scan;
      EXPECT_TRUE(findNode(map(), place.id, scan).node) << scan;
    }
    for (const NodeId id : {hardly_seen_, NodeId{1000}})
      EXPECT_EQ(findNode(map(), id, scan).node.has_value(), stored.hierarchy.contains(id)) << scan;
  }
}

TEST_F(KeptStates, ADamagedOneIsRefused) {
  test::writeText(map() / "hierarchy-000003.yaml", "format_version: 1\n");
  EXPECT_THROW(OpenMap(map(), 3), MapError);
  EXPECT_THROW(static_cast<void>(readManifest(map(), 3)), MapError);
  EXPECT_NO_THROW(OpenMap(map(), 5));
  test::writeText(map() / "hierarchy.yaml", "format_version: 1\n");
  EXPECT_THROW(OpenMap(map(), std::nullopt), MapError);
}

TEST_F(KeptStates, AfterTheLastScanTheMapIsAsItIs) {
  for (const std::uint64_t scan :
       {std::uint64_t{5}, std::uint64_t{6}, std::numeric_limits<std::uint64_t>::max()})
    EXPECT_EQ(readManifest(map(), scan).scans, 6U) << scan;
  EXPECT_EQ(readManifest(map(), 4).scans, 4U);
  EXPECT_THROW(static_cast<void>(readManifest(map(), 2)), MapError);
}

TEST_F(KeptStates, AMapWithoutAScanHasOneState) {
  const auto empty = folder_.path() / "empty";
  MapDirectory writer(empty, test::mapOptions(MapOpenMode::create));
  writer.commit({hierarchy_, {}, 0});
  for (const std::uint64_t scan : {0U, 3U}) EXPECT_EQ(readManifest(empty, scan).scans, 0U);
}

/// A kept state of a commit that was never finished.
TEST_F(KeptStates, ThoseBeyondTheMapAreNone) {
  std::filesystem::copy_file(map() / "hierarchy.yaml", map() / "hierarchy-000009.yaml");
  EXPECT_EQ(readManifest(map(), 9).scans, 6U);
  EXPECT_EQ(readManifest(map(), 4).scans, 4U);
  { const MapDirectory writer(map(), test::mapOptions(MapOpenMode::resume)); }
  EXPECT_FALSE(std::filesystem::exists(map() / "hierarchy-000009.yaml"));
  EXPECT_TRUE(std::filesystem::exists(map() / "hierarchy-000003.yaml"));
  EXPECT_TRUE(checkMap(map()).damage.empty());
}

}  // namespace
}  // namespace hoctomap
