// SPDX-License-Identifier: BSD-3-Clause
// Every system call that changes the disk fails once: disk full, I/O error, short write. The directory holds
// a whole map all the same, the previous or the new one, and the run can be continued to the same bytes.
#include <gtest/gtest.h>

#include <cerrno>
#include <functional>
#include <optional>
#include <ostream>
#include <vector>

#include "build_run.h"
#include "failing_calls.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

using test::BuildRun;
using test::contents;
using test::FailingCall;
using test::mapOptions;

struct Fault {
  const char* name;
  int error;
  FailingCall::Then then;
  friend std::ostream& operator<<(std::ostream& out, const Fault& fault) { return out << fault.name; }
};

class MapFaults : public ::testing::TestWithParam<Fault> {
 protected:
  std::filesystem::path map(const std::string& name) const { return folder_.path() / name; }

  using Session = std::function<void(MapDirectory&)>;

  /// Runs a session with call `n` failing. @return whether there was such a call
  bool failAt(int n, const std::filesystem::path& directory, MapOpenMode mode, const Session& session) const {
    std::optional<FailingCall> fault;
    std::optional<MapDirectory> writer;
    fault.emplace(n, GetParam().error, GetParam().then);
    try {
      writer.emplace(directory, mapOptions(mode));
      session(*writer);
    } catch (const FileError& error) {
      EXPECT_TRUE(fault->reached()) << error.what();
    }
    const bool reached = fault->reached();
    fault.reset();  // the end of the session may clean up
    return reached;
  }

  test::TemporaryFolder folder_;
};

TEST_P(MapFaults, OfANewMap) {
  {
    MapDirectory writer(map("whole"), mapOptions(MapOpenMode::create));
    BuildRun(3).all(writer);
  }
  const auto expected = contents(map("whole"));
  int n = 0;
  for (bool more = true; more; ++n) {
    const auto directory = map("failed" + std::to_string(n));
    const std::string when = "after call " + std::to_string(n);
    more = failAt(n, directory, MapOpenMode::create, [](auto& writer) { BuildRun(3).all(writer); });
    if (std::filesystem::exists(directory / "hierarchy.yaml")) test::expectWholeMap(directory, when);
    {
      MapDirectory writer(directory, mapOptions(MapOpenMode::resume));
      BuildRun::finish(writer, 3);
    }
    ASSERT_EQ(contents(directory), expected) << when;
    std::filesystem::remove_all(directory);
  }
  EXPECT_GT(n, 100);
}

TEST_P(MapFaults, OfAMapThatReplacesAnother) {
  for (const std::uint64_t seed : {6U, 7U}) {
    MapDirectory writer(map(std::to_string(seed)), mapOptions(MapOpenMode::create));
    BuildRun(seed).all(writer);
  }
  const auto expected = contents(map("7"));
  int n = 0;
  for (bool more = true; more; ++n) {
    const auto directory = map("over" + std::to_string(n));
    std::filesystem::copy(map("6"), directory, std::filesystem::copy_options::recursive);
    more = failAt(n, directory, MapOpenMode::overwrite, [](auto& writer) { BuildRun(7).all(writer); });
    test::expectWholeMap(directory, "after call " + std::to_string(n));
    {
      MapDirectory writer(directory, mapOptions(MapOpenMode::overwrite));
      BuildRun(7).all(writer);
    }
    ASSERT_EQ(contents(directory), expected) << "after call " << n;
    std::filesystem::remove_all(directory);
  }
  EXPECT_GT(n, 100);
}

/// What has no hard links gets copies: then a link that fails is none that the map fails by.
TEST(MapFaultsOfLinks, AFileSystemWithoutThemIsGoodEnough) {
  const test::TemporaryFolder folder;
  const auto map = [&](const std::string& name) { return folder.path() / name; };
  for (const std::uint64_t seed : {6U, 7U}) {
    MapDirectory writer(map(std::to_string(seed)), mapOptions(MapOpenMode::create));
    BuildRun(seed).all(writer);
  }
  const auto expected = contents(map("7"));
  enum class End { refused, done, done_without_it };
  // Map 7 over map 6, with call `n` failing.
  const auto overwrite = [&](int n, int error) {
    std::filesystem::remove_all(map("over"));
    std::filesystem::copy(map("6"), map("over"), std::filesystem::copy_options::recursive);
    std::optional<FailingCall> fault(std::in_place, n, error);
    try {
      MapDirectory writer(map("over"), mapOptions(MapOpenMode::overwrite));
      BuildRun(7).all(writer);
    } catch (const FileError&) {
      return End::refused;
    }
    const bool reached = fault->reached();
    fault.reset();
    std::filesystem::remove(map("over") / ".lock");  // left if it is its removal that failed
    EXPECT_EQ(contents(map("over")), expected) << "call " << n;
    return reached ? End::done : End::done_without_it;
  };
  std::vector<int> links;  // calls that may find no such thing here, but not a disk that is broken
  for (int n = 0;; ++n) {
    const End missing = overwrite(n, EPERM);
    const End broken = overwrite(n, EIO);
    if (missing == End::done_without_it) break;
    if (missing == End::done && broken == End::refused) links.push_back(n);
  }
  ASSERT_FALSE(links.empty());
  for (const int error : {EOPNOTSUPP, EMLINK, ENOSYS}) EXPECT_EQ(overwrite(links.front(), error), End::done);
}

/// A longer log takes events back that the end of the shorter one has added.
TEST_P(MapFaults, OfAMapThatIsContinued) {
  for (const std::uint64_t scans : {2U, 3U}) {
    MapDirectory writer(map(std::to_string(scans)), mapOptions(MapOpenMode::create));
    BuildRun(8).log(writer, scans);
  }
  const auto expected = contents(map("3"));
  const auto session = [](MapDirectory& writer) { BuildRun::finishLog(writer, 8); };
  int n = 0;
  for (bool more = true; more; ++n) {
    const auto directory = map("longer" + std::to_string(n));
    const std::string when = "after call " + std::to_string(n);
    std::filesystem::copy(map("2"), directory, std::filesystem::copy_options::recursive);
    more = failAt(n, directory, MapOpenMode::resume, session);
    test::expectWholeMap(directory, when);
    {
      MapDirectory writer(directory, mapOptions(MapOpenMode::resume));
      test::expectWholeMap(directory, when + ", opened again");
      session(writer);
    }
    ASSERT_EQ(contents(directory), expected) << when;
    std::filesystem::remove_all(directory);
  }
  EXPECT_GT(n, 50);
}

TEST_P(MapFaults, OfAnEdit) {
  const auto directory = map("map");
  {
    MapDirectory writer(directory, mapOptions(MapOpenMode::create));
    BuildRun(9).log(writer, 3);
  }
  const auto unedited = contents(directory);
  std::filesystem::copy(directory, map("edited"), std::filesystem::copy_options::recursive);
  {
    MapDirectory writer(map("edited"), mapOptions(MapOpenMode::edit));
    test::editMap(writer);
  }
  const auto expected = contents(map("edited"));
  int n = 0;
  for (bool more = true; more; ++n) {
    const std::string when = "after call " + std::to_string(n);
    const auto failed = map("edit" + std::to_string(n));
    std::filesystem::copy(directory, failed, std::filesystem::copy_options::recursive);
    more = failAt(n, failed, MapOpenMode::edit, test::editMap);
    test::expectWholeMap(failed, when);
    if (readManifest(failed).edits == 0) {
      EXPECT_EQ(contents(failed).at("hierarchy.yaml"), unedited.at("hierarchy.yaml")) << when;
    }
    {
      MapDirectory writer(failed, mapOptions(MapOpenMode::edit));
      test::editMap(writer);
    }
    ASSERT_EQ(contents(failed), expected) << when;
    std::filesystem::remove_all(failed);
  }
  EXPECT_GT(n, 30);
}

INSTANTIATE_TEST_SUITE_P(All, MapFaults,
                         ::testing::Values(Fault{"DiskFull", ENOSPC, FailingCall::Then::goes_on},
                                           Fault{"InputOutputError", EIO, FailingCall::Then::goes_on},
                                           Fault{"Interrupted", EINTR, FailingCall::Then::goes_on},
                                           Fault{"ShortWrite", ENOSPC, FailingCall::Then::full},
                                           Fault{"DeviceGone", EIO, FailingCall::Then::gone}),
                         [](const auto& fault) { return fault.param.name; });

}  // namespace
}  // namespace hoctomap
