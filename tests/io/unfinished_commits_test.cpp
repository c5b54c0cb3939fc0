// SPDX-License-Identifier: BSD-3-Clause
// What lies in the folder of a map besides the map: left by commits that were not finished, or put there by
// others.
#include <gtest/gtest.h>

#include "build_run.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/MapTables.h"

namespace hoctomap {
namespace {

using test::mapOptions;

class UnfinishedCommits : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path map(const std::string& name = "map") const {
    return folder_.path() / name;
  }
  test::TemporaryFolder folder_;
};

/// The end of a log added an event, which the next session takes back; its commit fails once at each step and
/// is repeated.
TEST_F(UnfinishedCommits, TheSessionOfALongerLogGoesOn) {
  test::Rng rng(4);
  const MapHierarchy hierarchy = test::randomHierarchy(rng, 2);
  {
    MapDirectory writer(map(), mapOptions(MapOpenMode::create));
    writer.append(test::reportOf(hierarchy, kRootId, 0));
    writer.appendEnd(test::reportOf(hierarchy, NodeId{1}, 0));
    writer.commit({hierarchy, {}, 1});
  }
  ASSERT_EQ(readEvents(map(), readManifest(map())).size(), 2U);
  int n = 0;
  for (bool more = true; more; ++n) {
    const auto directory = map("again" + std::to_string(n));
    std::filesystem::copy(map(), directory, std::filesystem::copy_options::recursive);
    int steps = 0;
    MapDirectoryOptions options = mapOptions(MapOpenMode::resume);
    options.before_step = [&](std::string_view, const std::filesystem::path&) {
      if (steps++ == n) throw FileError("no space left");
    };
    {
      MapDirectory writer(directory, options);
      writer.append(test::reportOf(hierarchy, NodeId{2}, 1));
      try {
        writer.commit({hierarchy, {}, 2});
      } catch (const FileError&) {
        test::expectWholeMap(directory, "after step " + std::to_string(n));
        writer.commit({hierarchy, {}, 2});
      }
    }
    test::expectWholeMap(directory, "in the end");
    const auto events = readEvents(directory, readManifest(directory));
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[1].node, NodeId{2});
    { const MapDirectory writer(directory, mapOptions(MapOpenMode::resume)); }
    EXPECT_FALSE(std::filesystem::exists(directory / "previous"));
    more = steps > n;
  }
  EXPECT_GT(n, 15);
}

TEST_F(UnfinishedCommits, WhatOthersPutUnderPreviousStays) {
  {
    MapDirectory writer(map(), mapOptions(MapOpenMode::create));
    test::BuildRun(2).all(writer);
  }
  std::filesystem::create_directory(map() / "previous");
  for (const char* name : {"notes.txt", "000001-000001.ot", "events.csv", "seams-000001.csv"})
    test::writeText(map() / "previous" / name, "not of this map");
  {
    MapDirectory writer(map(), mapOptions(MapOpenMode::overwrite));
    test::BuildRun(3).all(writer);
  }
  EXPECT_EQ(test::contents(map() / "previous"),
            (std::map<std::string, std::string>{{"notes.txt", "not of this map"}}));
  EXPECT_TRUE(checkMap(map()).damage.empty());
}

TEST_F(UnfinishedCommits, WhatIsOverwrittenNeedNotBeAMap) {
  std::filesystem::create_directory(map());
  test::writeText(map() / "notes.txt", "mine");
  {
    MapDirectory writer(map(), mapOptions(MapOpenMode::overwrite));
    test::BuildRun(3).all(writer);
  }
  EXPECT_EQ(test::readText(map() / "notes.txt"), "mine");
  EXPECT_EQ(checkMap(map()).foreign, std::vector<std::string>{"notes.txt"});
  test::expectWholeMap(map(), "beside a file of somebody else");
}

TEST_F(UnfinishedCommits, AFolderInPlaceOfAFileIsNamed) {
  {
    MapDirectory writer(map(), mapOptions(MapOpenMode::create));
    test::BuildRun(2).all(writer);
  }
  const std::string file = readManifest(map()).nodes.back().ot.path;
  std::filesystem::remove(map() / file);
  std::filesystem::create_directory(map() / file);
  EXPECT_THROW(static_cast<void>(readMap(map())), FileError);
  const MapCheck check = checkMap(map());
  ASSERT_EQ(check.damage.size(), 1U);
  EXPECT_EQ(check.damage[0].path, file);
  EXPECT_NE(check.damage[0].what.find("not a regular file"), std::string::npos);
}

TEST_F(UnfinishedCommits, AnEditedManifestIsReadBackFromItsText) {
  {
    MapDirectory writer(map(), mapOptions(MapOpenMode::create));
    test::BuildRun(2).all(writer);
  }
  {
    MapDirectory writer(map(), mapOptions(MapOpenMode::edit));
    test::editMap(writer);
  }
  const std::string text = test::readText(map() / "hierarchy.yaml");
  const Manifest manifest = parseManifest(text, "m");
  EXPECT_EQ(toYaml(manifest), text);
  EXPECT_EQ(manifest.find(NodeId{2})->edition, 1U);
  EXPECT_EQ(manifest.find(NodeId{2})->ot, readManifest(map()).find(NodeId{2})->ot);
}

}  // namespace
}  // namespace hoctomap
