// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"
#include "random_map.h"

namespace hoctomap {
namespace {

using test::mapOptions;
using test::TemporaryFolder;

TEST(MapLock, ASecondWriterIsToldThePidOfTheFirst) {
  const TemporaryFolder folder;
  const MapDirectory first(folder.path() / "map", mapOptions(MapOpenMode::create));
  for (const MapOpenMode mode : {MapOpenMode::create, MapOpenMode::resume, MapOpenMode::overwrite}) {
    try {
      const MapDirectory second(folder.path() / "map", mapOptions(mode));
      FAIL() << "two writers";
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("process " + std::to_string(::getpid())), std::string::npos);
    }
  }
}

TEST(MapLock, GoesWithItsHolder) {
  const TemporaryFolder folder;
  { const MapDirectory first(folder.path() / "map", mapOptions(MapOpenMode::create)); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "map"));
  const pid_t child = ::fork();
  if (child == 0) {
    const MapDirectory killed(folder.path() / "map", mapOptions(MapOpenMode::create));
    ::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "map" / ".lock"));
  EXPECT_NO_THROW(MapDirectory(folder.path() / "map", mapOptions(MapOpenMode::create)));
}

TEST(MapLock, IsNotInheritedByPrograms) {
  const TemporaryFolder folder;
  auto first = std::make_unique<MapDirectory>(folder.path() / "map", mapOptions(MapOpenMode::create));
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/bin/sleep", "sleep", "30", nullptr);
    ::_exit(1);
  }
  // The child holds a copy of the descriptor until it has become `sleep`: its name says when.
  const auto name = "/proc/" + std::to_string(child) + "/comm";
  for (int i = 0; i < 5000 && test::readText(name) != "sleep\n"; ++i) ::usleep(1000);
  first.reset();
  EXPECT_NO_THROW(MapDirectory(folder.path() / "map", mapOptions(MapOpenMode::create)));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

TEST(MapOpen, DirectoriesAndModes) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "file";
  test::writeText(file, "x");
  EXPECT_THROW(MapDirectory(file, mapOptions(MapOpenMode::create)), ConfigError);
  EXPECT_THROW(MapDirectory(file / "below", mapOptions(MapOpenMode::create)), FileError);
  EXPECT_THROW(MapDirectory(folder.path(), mapOptions(MapOpenMode::create)), ConfigError);
  EXPECT_THROW(MapDirectory(folder.path(), mapOptions(MapOpenMode::resume)), ConfigError);
  EXPECT_NO_THROW(MapDirectory(folder.path() / "a" / "b", mapOptions(MapOpenMode::resume)));
  EXPECT_EQ(test::contents(folder.path()).size(), 1U);  // refusals leave nothing behind
}

TEST(MapOpen, AnotherConfigurationCannotContinue) {
  const TemporaryFolder folder;
  test::Rng rng(1);
  {
    MapDirectory writer(folder.path() / "map", mapOptions(MapOpenMode::create));
    writer.commit({test::randomHierarchy(rng, 1), {}, 1});
  }
  MapDirectoryOptions other = mapOptions(MapOpenMode::resume);
  other.config = "[mapping]\nassociation_margin = 0.02\n";
  try {
    const MapDirectory writer(folder.path() / "map", other);
    FAIL() << "another configuration";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("[mapping] has `association_margin = 0.01`"), std::string::npos)
        << error.what();
  }
}

TEST(MapOpen, WhatIsAnotherConfigurationIsSaid) {
  const TemporaryFolder folder;
  test::Rng rng(1);
  const auto map = folder.path() / "map";
  const MapDirectoryOptions same = mapOptions(MapOpenMode::resume);
  {
    MapDirectory writer(map, same);
    writer.commit({test::randomHierarchy(rng, 1), {}, 1});
  }
  const auto why = [&](const std::string& config) -> std::string {
    MapDirectoryOptions other = same;
    other.config = config;
    try {
      const MapDirectory writer(map, other);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(why(same.config + "more = 1\n").find("`nothing` in the map, `more = 1` now"), std::string::npos);
  EXPECT_NE(why("[mapping]\n").find("`association_margin = 0.01` in the map, `nothing` now"),
            std::string::npos);
  // Stored text and hash contradict each other: there is no line to show, nor is there without the text.
  test::writeText(map / "config.ini", "[mapping]\n");
  EXPECT_NE(why("[mapping]\n").find("being continued; use -c"), std::string::npos);
  std::filesystem::remove(map / "config.ini");
  EXPECT_NE(why("[mapping]\n").find("being continued; use -c"), std::string::npos);
}

}  // namespace
}  // namespace hoctomap
