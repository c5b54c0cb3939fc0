// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "hoctomap/geometry/Errors.h"
#include "log_objects.h"
#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

using test::errorOf;
using test::Folder;
using test::only;
using test::optionsFor;
using test::readLog;

std::string errorFor(const std::string& bytes) {
  const Folder folder;
  const auto file = folder.write("log.rawlog", bytes);
  return errorOf<InputError>([&] { readLog(optionsFor(file)); });
}

TEST(LogDamage, FilesThatAreNoLogsAreInputErrors) {
  const Folder folder;
  ASSERT_EQ(::mkfifo((folder.path / "fifo").c_str(), 0600), 0);
  for (const auto& file :
       {folder.path / "missing", folder.path, folder.path / "fifo", std::filesystem::path("/dev/zero"),
        folder.write("empty", ""), folder.write("text", "This is a text, not a log.\n"),
        folder.write("byte", "\x1f")})
    EXPECT_EQ(errorOf<InputError>([&] { readLog(optionsFor(file)); }).find("WRONG"), std::string::npos)
        << file;
}

// Cut at an object's start, a plain log is a shorter log; anywhere else it is damaged.
TEST(LogDamage, PlainCutInsideAnObjectIsAnInputErrorWithItsPlace) {
  const std::string log = test::sweep(3);
  const std::size_t first_two = test::sweep(2).size();
  test::Rng rng(2);
  for (int round = 0; round < 100; ++round) {
    const std::size_t length = first_two + 1 + rng() % 60;  // inside the third pose
    const std::string error = errorFor(log.substr(0, length));
    EXPECT_NE(error.find("object 4 at byte " + std::to_string(first_two)), std::string::npos) << error;
  }
}

TEST(LogDamage, GzCutAnywhereIsAnInputError) {
  const std::string log = test::gz(test::sweep(20));
  for (int i = 0; i < 100; ++i) {
    const std::size_t length = 1 + (log.size() - 2) * static_cast<std::size_t>(i) / 100;
    const std::string error = errorFor(log.substr(0, length));
    EXPECT_EQ(error.find("WRONG"), std::string::npos) << error;
    EXPECT_NE(error, "NO ERROR") << length;
  }
  EXPECT_NE(errorFor(log.substr(0, log.size() - 8)).find("cut"), std::string::npos);  // no trailer
}

// A flip in padding bits, or of a reference to equal bytes elsewhere, changes nothing: then all scans come.
TEST(LogDamage, GzBitFlipsAreNoticed) {
  const std::string log = test::gz(test::sweep(20));
  test::Rng rng(4);
  int errors = 0;
  for (int round = 0; round < 100; ++round) {
    std::string bad = log;
    const std::size_t at = 10 + rng() % (bad.size() - 10);  // behind the header, whose fields say nothing
    bad[at] = static_cast<char>(bad[at] ^ (1 << rng() % 8));
    const Folder folder;
    const auto file = folder.write("log.rawlog", bad);
    try {
      const auto scans = only<DepthScan>(readLog(optionsFor(file)));
      ASSERT_EQ(scans.size(), 20U) << at;
      for (std::size_t i = 0; i < 20; ++i)
        EXPECT_FLOAT_EQ(scans[i].image.depth.at(0), 1.0F + 0.001F * static_cast<float>(i)) << at;
    } catch (const Error&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, 90);
}

TEST(LogDamage, TrailingJunkBehindGzIsAnInputError) {
  EXPECT_NE(errorFor(test::gz(test::sweep(2)) + "junk").find("trailing"), std::string::npos);
  EXPECT_NE(errorFor(test::sweep(2) + "junk").find("object 4"), std::string::npos);
}

TEST(LogDamage, UnknownClassesAndNewerVersionsAreInputErrors) {
  std::string unknown = test::imuObject(1.0);
  const auto name = unknown.find("CObservationIMU");
  unknown.replace(name, 15, "CObservationXYZ");
  const std::string error = errorFor(test::sweep(1) + unknown);
  EXPECT_NE(error.find("object 2"), std::string::npos) << error;
  EXPECT_NE(error.find("CObservationXYZ"), std::string::npos) << error;

  std::string newer = test::imuObject(1.0);
  newer[name + 15] = 99;  // the version stands behind the name
  const std::string version = errorFor(test::sweep(1) + newer);
  EXPECT_NE(version.find("object 2"), std::string::npos) << version;
}

TEST(LogDamage, NamesInLogsCannotReachTheTerminal) {
  std::string unknown = test::imuObject(1.0);
  unknown.replace(unknown.find("CObservationIMU"), 15, "CObservation\x1b[2");
  const std::string error = errorFor(unknown);
  EXPECT_EQ(error.find('\x1b'), std::string::npos);
}

TEST(LogDamage, SalvageKeepsWhatStandsBeforeTheDamage) {
  const Folder folder;
  const std::string log = test::sweep(5);
  for (const std::string& bytes : {log.substr(0, test::sweep(3).size() + 20), test::sweep(3) + "junk"}) {
    auto options = optionsFor(folder.write("log.rawlog", bytes));
    options.salvage = true;
    const auto messages = readLog(options);
    EXPECT_EQ(only<DepthScan>(messages).size(), 3U);
    ASSERT_EQ(only<StreamWarning>(messages).size(), 1U);
    EXPECT_NE(only<StreamWarning>(messages)[0].text.find("kept the 6 objects (3 scans)"), std::string::npos);
  }
  auto options = optionsFor(folder.write("log.rawlog", test::gz(log) + "junk"));
  options.salvage = true;
  EXPECT_EQ(only<DepthScan>(readLog(options)).size(), 5U);
  options.logs = {folder.write("text", "not a log at all")};
  EXPECT_THROW(readLog(options), InputError);
}

TEST(LogDamage, BudgetsAreLimitErrors) {
  const Folder folder;
  auto options = optionsFor(folder.write("log.rawlog", test::gz(test::sweep(20))));
  options.max_inflated_bytes = 1000;
  EXPECT_THROW(readLog(options), LimitError);
  options = optionsFor(options.logs[0]);
  options.max_object_bytes = 300;
  EXPECT_THROW(readLog(options), LimitError);
  // Zeros inflate by 1000:1.
  options = optionsFor(folder.write("bomb.rawlog", test::gz(test::sweep(1) + std::string(3'000'000, '\0'))));
  options.ratio_free_bytes = 1'000;
  EXPECT_THROW(readLog(options), LimitError);
}

}  // namespace
}  // namespace hoctomap
