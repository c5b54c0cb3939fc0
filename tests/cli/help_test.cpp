// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "Program.h"

namespace hoctomap {
namespace {

TEST(Help, NamesEveryCommand) {
  const auto outcome = test::hoctomap({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* command : {"build", "segment", "info", "render", "explain", "diff", "query", "edit",
                              "merge", "verify", "export", "import", "simulate", "explore"}) {
    EXPECT_NE(outcome.out.find(command), std::string::npos) << command;
  }
  EXPECT_TRUE(outcome.err.empty());
}

TEST(Help, OfACommandNamesItsOptionsAndAnExample) {
  const std::map<std::string, std::vector<std::string>> options{
      {"build",
       {"-c",
        "-i",
        "-o",
        "--poses",
        "--pose-label",
        "--sensor",
        "--start",
        "--end",
        "--every",
        "--max-scans",
        "--up",
        "--events",
        "--continue",
        "--overwrite",
        "--snapshot-every",
        "--salvage",
        "--threads",
        "--monolithic",
        "--estimate",
        "--json",
        "--set",
        "-v",
        "-q"}},
      {"segment",
       {"-c", "-i", "-o", "--poses", "--sensor", "--start", "--every", "--max-scans", "--up", "--set"}},
      {"info", {"LOG|DIR", "--json", "--at-scan"}},
      {"render", {"DIR", "-o", "--size", "--view", "--hide", "--at-scan"}},
      {"explain", {"DIR", "NODE", "--plot", "--json", "--at-scan"}},
      {"diff", {"A", "B", "--transform", "--json", "-o", "--at-scan", "--at-scan-a", "--at-scan-b"}},
      {"query",
       {"DIR", "--point", "--ray", "--box", "--sphere", "--distance", "--unknown", "--objects", "--batch",
        "--kind", "--ignore-unknown", "--max-range", "--step", "--min-existence", "--json", "--at-scan"}},
      {"edit", {"DIR", "relabel", "move", "remove", "merge"}},
      {"merge", {"MAP", "-o", "--transform"}},
      {"verify", {"DIR", "--json"}},
      {"export", {"DIR", "--format", "-o", "--at-scan"}},
      {"import", {"tum", "frames", "pcd"}},
      {"simulate", {"-c", "-o", "--set"}},
      {"explore", {"-c", "-o", "--config", "--set", "--seed", "--overwrite", "--threads", "-q"}}};
  for (const auto& [command, names] : options) {
    const auto outcome = test::hoctomap({command, "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    for (const auto& name : names)
      EXPECT_NE(outcome.out.find(name), std::string::npos) << command << " " << name;
    EXPECT_NE(outcome.out.find("Example"), std::string::npos) << command;
  }
}

TEST(Help, WrongUsageIsExit2WithOneLine) {
  const std::vector<std::vector<std::string>> wrong{
      {},
      {"bild"},
      {"build"},
      {"build", "-i", "a", "-o", "b", "--no-such-option"},
      {"build", "-i", "a", "-o", "b", "--every", "0"},
      {"build", "-i", "a", "-o", "b", "--max-scans", "x"},
      {"build", "-i", "a", "-o", "b", "--continue", "--overwrite"},
      {"build", "-i", "a", "-o", "b", "--up", "0,0"},
      {"info"}};
  for (const auto& arguments : wrong) {
    const auto outcome = test::hoctomap(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
  }
}

TEST(Help, VersionIsPrinted) {
  const auto outcome = test::hoctomap({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out.rfind("hoctomap ", 0), 0U);
}

}  // namespace
}  // namespace hoctomap
