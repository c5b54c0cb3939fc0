// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "TableLogs.h"

namespace hoctomap {
namespace {

using test::TemporaryFolder;

/// The exit code is as documented, with exactly one line that names the file, and nothing is left behind.
void expectRefused(const TemporaryFolder& folder, const std::string& log, int exit_code) {
  const auto outcome = test::hoctomap({"build", "-q", "-i", log, "-o", folder / "out"});
  EXPECT_EQ(outcome.exit_code, exit_code) << log << ": " << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(std::filesystem::path(log).filename().string()), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(BadLogs, AreRefusedWithOneLine) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "good.rawlog");
  const std::string good = test::readFile(folder / "good.rawlog");
  expectRefused(folder, folder / "missing.rawlog", 3);
  std::filesystem::create_directory(folder / "folder.rawlog");
  expectRefused(folder, folder / "folder.rawlog", 3);
  test::writeFile(folder / "empty.rawlog", "");
  expectRefused(folder, folder / "empty.rawlog", 3);
  test::writeFile(folder / "text.rawlog", "this is no log\n");
  expectRefused(folder, folder / "text.rawlog", 3);
  test::writeFile(folder / "cut.rawlog", good.substr(0, good.size() / 2));
  expectRefused(folder, folder / "cut.rawlog", 3);
  test::writeFile(folder / "trailing.rawlog", good + "junk");
  expectRefused(folder, folder / "trailing.rawlog", 3);
  std::string flipped = good;
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 0x10);
  test::writeFile(folder / "flipped.rawlog", flipped);
  expectRefused(folder, folder / "flipped.rawlog", 3);
  test::writeFile(folder / "null.rawlog", std::string("\x87nullptr\x88", 9));
  expectRefused(folder, folder / "null.rawlog", 3);
  ASSERT_EQ(mkfifo((folder / "fifo.rawlog").c_str(), 0600), 0);
  expectRefused(folder, folder / "fifo.rawlog", 3);
}

TEST(BadLogs, SalvageKeepsWhatStandsBeforeTheDamage) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "good.rawlog");
  const std::string good = test::readFile(folder / "good.rawlog");
  test::writeFile(folder / "cut.rawlog", good.substr(0, good.size() * 2 / 3));
  test::build(folder / "cut.rawlog", folder / "map", {"--salvage"});
  EXPECT_GT(readManifest(folder / "map").scans, 1U);
  EXPECT_LT(readManifest(folder / "map").scans, 6U);
}

TEST(BadPoses, AreExit3WithTheLine) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  const std::map<std::string, std::string> files{
      {"columns", "1 2 3\n"},
      {"nan", "1300000000 nan 0 0 0 0 0\n"},
      {"comma", "1300000000 0,5 0 0 0 0 0\n"},
      {"quaternion", "1300000000 0 0 0 0 0 0 0\n"},
      {"far", "1300000000 2e6 0 0 0 0 0\n"},
      {"far_quaternion", "1300000000 2e6 0 0 0 0 0 1\n"},
      {"unsorted", "1300000001 0 0 0 0 0 0\n1300000000 0 0 0 0 0 0\n"},
      {"twice", "1300000000 0 0 0 0 0 0\n1300000000 1 0 0 0 0 0\n"}};
  for (const auto& [name, text] : files) {
    test::writeFile(folder / name, text);
    const auto outcome = test::hoctomap(
        {"build", "-q", "-i", folder / "a.rawlog", "-o", folder / "out", "--poses", folder / name});
    EXPECT_EQ(outcome.exit_code, 3) << name << ": " << outcome.err;
    const bool second_line = name == "unsorted" || name == "twice";
    EXPECT_NE(outcome.err.find(name + (second_line ? ":2:" : ":1:")), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
}

TEST(BadPoses, ScansWithoutAPoseAreSkippedAndCounted) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");  // six scans, 0.5 s apart
  std::string poses;
  for (const char* time : {"1300000000.0", "1300000000.4", "1300000000.8", "1300000001.2"}) {
    poses += std::string(time) + " 0 0 0 0 0 0\n";
  }
  test::writeFile(folder / "poses.txt", poses);
  const auto outcome = test::hoctomap({"build", "-i", folder / "a.rawlog", "-o", folder / "map", "--poses",
                                       folder / "poses.txt", "--set", "poses.max_gap=0.5"});
  EXPECT_EQ(outcome.exit_code, 3) << "half of the scans were skipped";
  EXPECT_NE(outcome.out.find("3 used, 3 skipped"), std::string::npos) << outcome.out;
  EXPECT_EQ(readManifest(folder / "map").scans, 6U) << "the map is written all the same";
  const auto tolerant = test::hoctomap({"build", "-q", "-i", folder / "a.rawlog", "-o", folder / "b",
                                        "--poses", folder / "poses.txt", "--set", "poses.max_gap=0.5",
                                        "--set", "limits.max_skipped_share=0.6"});
  EXPECT_EQ(tolerant.exit_code, 0) << tolerant.err;
}

TEST(BadPoses, SkippedScansCountAlsoWhenTheRunWasStoppedAfterThem) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::writeFile(folder / "poses.txt",
                  "1300000001.4 0 0 0 0 0 0\n1300000001.8 0 0 0 0 0 0\n1300000002.2 0 0 0 0 0 0\n"
                  "1300000002.6 0 0 0 0 0 0\n");  // the first three scans have none
  const std::vector<std::string> poses{"--poses", folder / "poses.txt", "--set", "poses.max_gap=0.5"};
  auto first = poses;
  first.insert(first.end(), {"--max-scans", "1"});
  test::build(folder / "a.rawlog", folder / "map", first, 3);
  auto rest = poses;
  rest.emplace_back("--continue");
  test::build(folder / "a.rawlog", folder / "map", rest, 3);
  EXPECT_EQ(readManifest(folder / "map").mapped_scans, 3U);
  EXPECT_EQ(readManifest(folder / "map").skipped_scans, 3U);
}

TEST(BadConfiguration, NamesAllProblemsTogether) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::writeFile(
      folder / "bad.ini",
      "[mapping]\nchekpoint_scans = 3\n[label.background]\nresolution=0\n[label.table]\nprob_hit=0.4\n"
      "[label.object]\nresolution=12junk\n");
  const auto outcome =
      test::hoctomap({"build", "-c", folder / "bad.ini", "-i", folder / "a.rawlog", "-o", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  for (const char* expected : {"chekpoint_scans", "checkpoint_scans", "[label.background] resolution",
                               "[label.table] prob_hit", "12junk"}) {
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << expected << "\n" << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(MemoryLimit, RefusesTheScanThatWouldExceedItAndKeepsTheMap) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map", {"--max-scans", "1"});
  const auto before = test::reproducibleFiles(folder / "map");
  const auto refused = test::build(folder / "a.rawlog", folder / "map",
                                   {"--overwrite", "--set", "label.object.max_memory=0.01"}, 6);
  EXPECT_NE(refused.err.find("[label.object] max_memory"), std::string::npos) << refused.err;
  EXPECT_EQ(test::reproducibleFiles(folder / "map"), before);
}

TEST(MemoryLimit, OfTheProgramStopsBeforeAScanWithTheMapCommitted) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  const auto refused = test::build(folder / "a.rawlog", folder / "map", {"--set", "limits.max_memory=1"}, 6);
  EXPECT_NE(refused.err.find("scan 0: the program holds"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("[limits] max_memory"), std::string::npos) << refused.err;
  EXPECT_EQ(test::hoctomap({"verify", folder / "map"}).exit_code, 0);
  EXPECT_EQ(readManifest(folder / "map").scans, 0U);
}

TEST(BadOutput, IsExit5) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::writeFile(folder / "file", "");
  const auto outcome = test::hoctomap({"build", "-q", "-i", folder / "a.rawlog", "-o", folder / "file/map"});
  EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
}

TEST(BadMaps, InfoRefusesWhatIsDamaged) {
  const TemporaryFolder folder;
  test::simulate("demo", folder / "a.rawlog");
  test::build(folder / "a.rawlog", folder / "map");
  const std::string manifest = test::readFile(folder / "map/hierarchy.yaml");
  test::writeFile(folder / "map/hierarchy.yaml",
                  "format_version: 2\n" + manifest.substr(manifest.find('\n') + 1));
  EXPECT_EQ(test::hoctomap({"info", folder / "map"}).exit_code, 4);
  test::writeFile(folder / "map/hierarchy.yaml", manifest);
  const NodeRecord object = readManifest(folder / "map").nodes.back();
  const std::string node = test::readFile(folder / "map/" + object.ot.path);
  test::writeFile(folder / "map/" + object.ot.path, node.substr(0, node.size() / 2));
  const auto outcome = test::hoctomap({"info", folder / "map"});
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find(object.ot.path), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace hoctomap
