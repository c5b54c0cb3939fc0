// SPDX-License-Identifier: BSD-3-Clause
// What a disk and a kernel do once in a lifetime.
#include <gtest/gtest.h>

#include <cerrno>
#include <optional>

#include "failing_calls.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/AtomicFile.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/Sha256.h"
#include "random_map.h"

namespace hoctomap {
namespace {

using test::FailingCall;
using test::FailingRead;
using test::mapOptions;

class DiskTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

  test::Rng rng_{3};
  test::TemporaryFolder folder_;
};

/// Whichever read goes wrong: the same map, or a refusal.
TEST_F(DiskTest, AFailedReadNeverGivesAnotherMap) {
  {
    MapDirectory writer(path("map"), mapOptions(MapOpenMode::create));
    writer.commit({test::randomHierarchy(rng_, 2), {}, 3});
  }
  const std::string expected = toYaml(readMap(path("map")).manifest);
  using How = FailingRead::How;
  for (const How how : {How::no_status, How::no_bytes, How::interrupted, How::cut}) {
    int refused = 0;
    bool more = true;
    for (int n = 0; more; ++n) {
      const FailingRead fault(n, how);
      try {
        EXPECT_EQ(toYaml(readMap(path("map")).manifest), expected) << n;
      } catch (const FileError&) {
        ++refused;
        EXPECT_TRUE(how == How::no_status || how == How::no_bytes) << n;
      } catch (const MapError&) {
        ++refused;
        EXPECT_EQ(how, How::cut) << n;
      }
      more = fault.reached();
    }
    if (how == How::interrupted) {
      EXPECT_EQ(refused, 0);
    } else {
      EXPECT_GE(refused, 4) << "the manifest and three octrees; the index can be done without";
    }
  }
}

TEST_F(DiskTest, AWriteOfNothingIsAFullDisk) {
  int refused = 0;
  bool more = true;
  for (int n = 0; more; ++n) {
    test::writeText(path("file"), "old");
    const FailingCall fault(n, ENOSPC, FailingCall::Then::nothing);
    try {
      replaceFile(path("file"), "new text");
      EXPECT_EQ(test::readText(path("file")), "new text") << n;
    } catch (const FileError&) {
      ++refused;
      const std::string text = test::readText(path("file"));
      EXPECT_TRUE(text == "old" || text == "new text") << text;
    }
    more = fault.reached();
  }
  EXPECT_GE(refused, 3);
}

/// The last writer ends between our opening its lock file and our locking it.
TEST_F(DiskTest, ALockFileThatGoesIsMadeAnew) {
  std::optional<MapDirectory> writer;
  const auto lock = path("map") / ".lock";
  {
    const test::BeforeLock gone([&] { std::filesystem::remove(lock); });
    writer.emplace(path("map"), mapOptions(MapOpenMode::create));
  }
  EXPECT_TRUE(std::filesystem::exists(lock));
  EXPECT_THROW(MapDirectory(path("map"), mapOptions(MapOpenMode::create)), FileError);
}

TEST_F(DiskTest, WithoutAHashFunctionNothingIsWritten) {
  const test::NoHashFunctions none;
  EXPECT_THROW(static_cast<void>(sha256Hex("a")), std::runtime_error);
  EXPECT_THROW(MapDirectory(path("map"), mapOptions(MapOpenMode::create)), std::runtime_error);
}

}  // namespace
}  // namespace hoctomap
