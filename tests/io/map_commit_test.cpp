// SPDX-License-Identifier: BSD-3-Clause
// Committed is committed: whatever step fails and whenever the process dies, the directory holds a whole map.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <functional>

#include "build_run.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/MapTables.h"

namespace hoctomap {
namespace {

using test::BuildRun;
using test::contents;
using test::mapOptions;
using test::TemporaryFolder;

class MapCommit : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path map(const std::string& name = "map") const {
    return folder_.path() / name;
  }
  /// The map an undisturbed run leaves.
  std::map<std::string, std::string> undisturbed(std::uint64_t seed) {
    const std::string name = "undisturbed" + std::to_string(seed);
    if (!std::filesystem::exists(map(name))) {
      MapDirectory writer(map(name), mapOptions(MapOpenMode::create));
      BuildRun(seed).all(writer);
    }
    return contents(map(name));
  }

  TemporaryFolder folder_;
  /// A child of a fork has none of the threads that oneTBB had by then, and may wait for them for ever.
  tbb::global_control no_workers_{tbb::global_control::max_allowed_parallelism, 1};
};

TEST_F(MapCommit, SameRunSameBytes) {
  MapDirectory writer(map(), mapOptions(MapOpenMode::create));
  BuildRun(1).all(writer);
  auto files = contents(map());
  files.erase(".lock");
  EXPECT_EQ(files, undisturbed(1));
  EXPECT_EQ(files.at("events.csv").substr(0, 50), "scan,time,event,node,label,existence,detail\n0,1290");
  EXPECT_NE(files.at("events.csv").find(",\"a \"\"detail\"\", quoted\"\n"), std::string::npos);
  EXPECT_TRUE(files.contains("hierarchy-000001.yaml"));
}

TEST_F(MapCommit, ScansAreReadBack) {
  undisturbed(1);
  const auto directory = map("undisturbed1");
  const auto rows = readScans(directory, readManifest(directory));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[2].scan, 2U);
  EXPECT_EQ(rows[2].sensor, "a, b");
  ASSERT_TRUE(rows[2].world_T_sensor.has_value());
  EXPECT_EQ(rows[2].world_T_sensor->x(), 2.0);
  EXPECT_NEAR(rows[2].fov_x.value_or(0.0), 57.2957795, 1e-6);
  EXPECT_EQ(rows[2].skipped, "");
  // A kept state has the scans up to it.
  EXPECT_EQ(readScans(directory, readManifest(directory, 1)).size(), 2U);
  EXPECT_EQ(readTiming(directory, readManifest(directory, 1)).size(), 2U);
}

TEST_F(MapCommit, OldVersionsGoUnlessKept) {
  undisturbed(1);
  const auto directory = map("undisturbed1");
  EXPECT_FALSE(std::filesystem::exists(directory / "nodes/000002-000003.ot"));  // of commit 0
  EXPECT_TRUE(std::filesystem::exists(directory / "nodes/000002-000010.ot"));   // kept with commit 1
  EXPECT_TRUE(std::filesystem::exists(directory / "nodes/000002-000020.ot"));
  EXPECT_EQ(readManifest(directory, 1).scans, 2U);
  EXPECT_EQ(readMap(directory, {1, false}).hierarchy.node(NodeId{2}).version, 10U);
  EXPECT_TRUE(findDamage(directory, readManifest(directory, 1)).empty());
  EXPECT_EQ(readManifest(directory, 2).scans, 3U);
  EXPECT_THROW(static_cast<void>(readManifest(directory, 0)), MapError);
}

TEST_F(MapCommit, ForeignFilesAreLeftAlone) {
  MapDirectory writer(map(), mapOptions(MapOpenMode::create));
  BuildRun run(1);
  run.commit(writer);
  for (const char* name : {"notes.txt", "nodes/mine.ot", "nodes/1-2.ot", "nodes/000001-000002.ot.bak"}) {
    test::writeText(map() / name, "mine");
  }
  test::writeText(map() / "nodes/000077-000077.ot", "left behind by a killed run");
  run.commit(writer);
  for (const char* name : {"notes.txt", "nodes/mine.ot", "nodes/1-2.ot", "nodes/000001-000002.ot.bak"}) {
    EXPECT_EQ(test::readText(map() / name), "mine");
  }
  EXPECT_FALSE(std::filesystem::exists(map() / "nodes/000077-000077.ot"));
}

TEST_F(MapCommit, LinksOutOfTheDirectoryAreRefused) {
  undisturbed(1);
  const auto directory = map("undisturbed1");
  test::writeText(map("outside"), "somebody's");
  for (const char* name : {"log.txt", "nodes"}) {
    std::filesystem::rename(directory / "nodes", map("nodes"));
    std::filesystem::create_symlink(map(name == std::string("nodes") ? "nodes" : "outside"),
                                    directory / name);
    EXPECT_THROW(MapDirectory(directory, mapOptions(MapOpenMode::resume)), MapError) << name;
    EXPECT_THROW(MapDirectory(directory, mapOptions(MapOpenMode::overwrite)), MapError) << name;
    std::filesystem::remove(directory / name);
    std::filesystem::rename(map("nodes"), directory / "nodes");
  }
  EXPECT_EQ(test::readText(map("outside")), "somebody's");
}

/// Lets step `n` of a session fail; true if there was one.
bool failAt(int n, const std::filesystem::path& directory, MapOpenMode mode,
            const std::function<void(MapDirectory&)>& session, const std::function<void()>& failure) {
  int steps = 0;
  MapDirectoryOptions options = mapOptions(mode);
  options.before_step = [&](std::string_view, const std::filesystem::path&) {
    if (steps++ == n) failure();
  };
  MapDirectory writer(directory, options);
  session(writer);
  return steps > n;
}

/// Kills a process at step `n` of a session; false if it had fewer.
bool killAt(int n, const std::filesystem::path& directory, MapOpenMode mode,
            const std::function<void(MapDirectory&)>& session) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::_exit(failAt(n, directory, mode, session, [] { ::raise(SIGKILL); }) ? 1 : 0);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFSIGNALED(status);
}

TEST_F(MapCommit, EveryFailedStepLeavesAWholeMap) {
  int failures = 0;
  for (bool more = true; more; ++failures) {
    const auto directory = map("failed" + std::to_string(failures));
    const auto session = [](MapDirectory& writer) { BuildRun(3).all(writer); };
    try {
      more =
          failAt(failures, directory, MapOpenMode::create, session, [] { throw FileError("no space left"); });
    } catch (const FileError&) {
      if (std::filesystem::exists(directory / "hierarchy.yaml")) {
        test::expectWholeMap(directory, "after failure " + std::to_string(failures));
      }
    }
  }
  EXPECT_GT(failures, 30);
}

TEST_F(MapCommit, ASessionGoesOnAfterAFailedCommit) {
  for (int n = 0; n < 200; ++n) {
    const auto directory = map("again" + std::to_string(n));
    int steps = 0;
    MapDirectoryOptions options = mapOptions(MapOpenMode::create);
    options.before_step = [&](std::string_view, const std::filesystem::path&) {
      if (steps++ == n) throw FileError("no space left");
    };
    test::Rng rng(4);
    const MapHierarchy hierarchy = test::randomHierarchy(rng, 1);
    {
      MapDirectory writer(directory, options);
      for (std::uint64_t scan = 0; scan < 3; ++scan) {
        writer.append(test::reportOf(hierarchy, kRootId, scan));
        try {
          writer.commit({hierarchy, {}, scan + 1});
        } catch (const FileError&) {
          writer.commit({hierarchy, {}, scan + 1});
        }
      }
    }
    test::expectWholeMap(directory, "after step " + std::to_string(n));
    const std::string events = test::readText(directory / "events.csv");
    EXPECT_EQ(std::count(events.begin(), events.end(), '\n'), 4);
    if (steps <= n) break;
    ASSERT_LT(n, 199);
  }
}

TEST_F(MapCommit, KilledAtAnyStepThenContinuedGivesTheSameBytes) {
  const auto expected = undisturbed(5);
  int kills = 0;
  for (bool more = true; more; kills += 3) {
    const auto directory = map("killed" + std::to_string(kills));
    more =
        killAt(kills, directory, MapOpenMode::create, [](MapDirectory& writer) { BuildRun(5).all(writer); });
    if (std::filesystem::exists(directory / "hierarchy.yaml")) {
      test::expectWholeMap(directory, "killed at step " + std::to_string(kills));
    }
    {
      MapDirectory writer(directory, mapOptions(MapOpenMode::resume));
      BuildRun::finish(writer, 5);
    }
    ASSERT_EQ(contents(directory), expected) << "killed at step " << kills;
  }
  EXPECT_GT(kills, 30);
}

/// A longer log takes events back that the end of the shorter one has added.
TEST_F(MapCommit, KilledAtAnyStepOfALongerLog) {
  for (const std::uint64_t scans : {2U, 3U}) {
    MapDirectory writer(map("log" + std::to_string(scans)), mapOptions(MapOpenMode::create));
    BuildRun(5).log(writer, scans);
  }
  const auto expected = contents(map("log3"));
  int kills = 0;
  for (bool more = true; more; ++kills) {
    const auto directory = map("killed" + std::to_string(kills));
    const std::string when = "killed at step " + std::to_string(kills);
    std::filesystem::copy(map("log2"), directory, std::filesystem::copy_options::recursive);
    more = killAt(kills, directory, MapOpenMode::resume,
                  [](MapDirectory& writer) { BuildRun::finishLog(writer, 5); });
    test::expectWholeMap(directory, when);
    EXPECT_TRUE(checkMap(directory).damage.empty()) << when;  // kept states, too
    {
      MapDirectory writer(directory, mapOptions(MapOpenMode::resume));
      BuildRun::finishLog(writer, 5);
    }
    ASSERT_EQ(contents(directory), expected) << when;
  }
  EXPECT_GT(kills, 30);
}

TEST_F(MapCommit, KilledAtAnyStepOfAnEdit) {
  {
    MapDirectory writer(map(), mapOptions(MapOpenMode::create));
    BuildRun(5).log(writer, 3);
  }
  const std::string unedited = test::readText(map() / "hierarchy.yaml");
  std::map<std::string, std::string> expected;
  int kills = 0;
  for (bool more = true; more; ++kills) {
    const auto directory = map("killed" + std::to_string(kills));
    const std::string when = "killed at step " + std::to_string(kills);
    std::filesystem::copy(map(), directory, std::filesystem::copy_options::recursive);
    more = killAt(kills, directory, MapOpenMode::edit, test::editMap);
    EXPECT_TRUE(checkMap(directory).damage.empty()) << when;
    EXPECT_TRUE(readManifest(directory).edits == 1 ||
                test::readText(directory / "hierarchy.yaml") == unedited)
        << when;
    {
      MapDirectory writer(directory, mapOptions(MapOpenMode::edit));
      test::editMap(writer);
    }
    if (kills == 0) expected = contents(directory);  // killed before it did anything
    ASSERT_EQ(contents(directory), expected) << when;
  }
  EXPECT_GT(kills, 15);
}

/// The session that goes on after the kill ends before it comes to that scan again.
TEST_F(MapCommit, AKeptStateOfAnUnfinishedCommitGoes) {
  const auto directory = map();
  {
    MapDirectory writer(directory, mapOptions(MapOpenMode::create));
    BuildRun(5).log(writer, 1);
  }
  const pid_t child = ::fork();
  if (child == 0) {
    MapDirectoryOptions options = mapOptions(MapOpenMode::resume);
    options.before_step = [](std::string_view step, const std::filesystem::path& file) {
      const bool kept = std::filesystem::exists(file.parent_path() / "hierarchy-000001.yaml");
      if (kept && step == "rename" && file.filename() == "hierarchy.yaml") ::raise(SIGKILL);
    };
    MapDirectory writer(directory, options);
    BuildRun::finishLog(writer, 5);
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_TRUE(std::filesystem::exists(directory / "hierarchy-000001.yaml"));
  EXPECT_TRUE(checkMap(directory).damage.empty());
  test::Rng rng(1);
  const MapHierarchy hierarchy = test::randomHierarchy(rng, 1);
  {
    MapDirectory writer(directory, mapOptions(MapOpenMode::resume));
    writer.commit({hierarchy, {}, 1, "log"});
  }
  EXPECT_TRUE(checkMap(directory).damage.empty());
}

TEST_F(MapCommit, OverwritingKeepsTheOldMapUntilTheNewOneIsThere) {
  undisturbed(6);
  const auto expected = undisturbed(7);
  int kills = 0;
  for (bool more = true; more; kills += 5) {
    const auto directory = map("over" + std::to_string(kills));
    std::filesystem::copy(map("undisturbed6"), directory, std::filesystem::copy_options::recursive);
    more = killAt(kills, directory, MapOpenMode::overwrite,
                  [](MapDirectory& writer) { BuildRun(7).all(writer); });
    test::expectWholeMap(directory, "killed at step " + std::to_string(kills));
    if (kills % 2 == 0) {  // the old or the new map can be continued
      const MapDirectory writer(directory, mapOptions(MapOpenMode::resume));
      EXPECT_FALSE(std::filesystem::exists(directory / "previous"));
    }
    test::expectWholeMap(directory, "continued after step " + std::to_string(kills));
    MapDirectory writer(directory, mapOptions(MapOpenMode::overwrite));
    BuildRun(7).all(writer);
    auto files = contents(directory);
    files.erase(".lock");
    ASSERT_EQ(files, expected) << "killed at step " << kills;
  }
  EXPECT_GT(kills, 40);
}

TEST_F(MapCommit, OverwritingADamagedMap) {
  undisturbed(6);
  const auto directory = map("undisturbed6");
  test::writeText(directory / "hierarchy.yaml", "[1, 2");
  EXPECT_THROW(MapDirectory(directory, mapOptions(MapOpenMode::resume)), MapError);
  {
    MapDirectory writer(directory, mapOptions(MapOpenMode::overwrite));
    BuildRun(7).all(writer);
  }
  EXPECT_EQ(contents(directory), undisturbed(7));
}

TEST_F(MapCommit, ShortWritesAreNoticed) {
  undisturbed(8);
  const auto directory = map("undisturbed8");
  const auto before = contents(directory);
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{2000, 2000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      MapDirectory writer(directory, mapOptions(MapOpenMode::overwrite));
      BuildRun(9).all(writer);
    } catch (const FileError&) {
      ::_exit(5);
    }
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 5);
  test::expectWholeMap(directory, "after the short write");
  { const MapDirectory writer(directory, mapOptions(MapOpenMode::resume)); }
  auto after = contents(directory);
  EXPECT_EQ(after.at("hierarchy.yaml"), before.at("hierarchy.yaml"));
}

TEST_F(MapCommit, DamagedEventsAreNoticedWhenContinuing) {
  undisturbed(6);
  const auto events = map("undisturbed6") / "events.csv";
  const std::string text = test::readText(events);
  test::writeText(events, text + "a row that no commit knows\n");
  test::expectWholeMap(map("undisturbed6"), "with a tail");
  test::writeText(events, text.substr(0, text.size() - 1));
  EXPECT_THROW(MapDirectory(map("undisturbed6"), mapOptions(MapOpenMode::resume)), MapError);
}

}  // namespace
}  // namespace hoctomap
