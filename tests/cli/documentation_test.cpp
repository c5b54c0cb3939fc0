// SPDX-License-Identifier: BSD-3-Clause
// Manual pages and completion come from the same options as --help.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "Program.h"

namespace hoctomap {
namespace {

/// The names of options and commands in a help text: the first words of its indented lines.
std::set<std::string> namesIn(const std::string& help) {
  std::set<std::string> names;
  std::istringstream lines(help.substr(0, help.find("\nExample")));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ") || line.starts_with("   ")) continue;
    std::istringstream first(line.substr(2, line.find(' ', 2) - 2));
    for (std::string name; std::getline(first, name, ',');) names.insert(name);
  }
  return names;
}

std::set<std::string> commandsIn(const std::string& help) {
  return help.find("Subcommands:") == std::string::npos ? std::set<std::string>()
                                                        : namesIn(help.substr(help.find("Subcommands:")));
}

std::string withoutEscapes(const std::string& page) {
  return std::regex_replace(page, std::regex(R"(\\-)"), "-");
}

class Documentation : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(test::hoctomap({"documentation", folder_ / ""}).exit_code, 0);
    for (const auto& command : commandsIn(test::hoctomap({"--help"}).out)) commands_.push_back(command);
    ASSERT_GE(commands_.size(), 14U);
  }
  test::TemporaryFolder folder_;
  std::vector<std::string> commands_;
};

TEST_F(Documentation, EveryCommandHasAPageWithAllThatItsHelpNames) {
  for (const std::string& command : commands_) {
    const std::string page = withoutEscapes(test::readFile(folder_ / ("man1/hoctomap-" + command + ".1")));
    const std::string help = test::hoctomap({command, "--help"}).out;
    ASSERT_FALSE(namesIn(help).empty()) << help;
    for (const std::string& name : namesIn(help)) {
      const bool is_command = commandsIn(help).contains(name);
      std::string shown = name;
      for (char& c : shown) c = is_command ? static_cast<char>(std::toupper(c)) : c;
      EXPECT_NE(page.find(shown), std::string::npos) << command << " " << name;
    }
    EXPECT_NE(page.find("\nhoctomap " + command), std::string::npos) << "no example of " << command;
  }
  const std::string page = test::readFile(folder_ / "man1/hoctomap.1");
  for (const std::string& command : commands_) EXPECT_NE(page.find(command + " (1)"), std::string::npos);
  EXPECT_NE(page.find("130/143"), std::string::npos);
  EXPECT_EQ(page.find("documentation (1)"), std::string::npos);
}

TEST_F(Documentation, PagesAreShownWithoutWarnings) {
  if (!std::filesystem::exists("/usr/bin/man")) GTEST_SKIP() << "no man";
  for (const auto& [name, page] : test::readTree(folder_ / "man1")) {
    const auto outcome =
        test::runProgram("man", {"--warnings", "-E", "UTF-8", "-l", "-Tutf8", folder_ / ("man1/" + name)},
                         {{"LC_ALL", "C.UTF-8"}, {"MANROFFSEQ", ""}, {"MANWIDTH", "80"}});
    EXPECT_EQ(outcome.exit_code, 0) << name;
    EXPECT_EQ(outcome.err, "") << name;
    EXPECT_GT(outcome.out.size(), 300U) << name;
  }
}

/// What bash would offer for a line of words, the last of which is being typed.
std::set<std::string> offered(const std::string& script, const std::vector<std::string>& words) {
  std::string line = "set -u; . '" + script + "'; COMP_WORDS=(";
  for (const std::string& word : words) line += "'" + word + "' ";
  line +=
      "); COMP_CWORD=" + std::to_string(words.size() - 1) + "; _hoctomap; printf '%s\\n' \"${COMPREPLY[@]}\"";
  const auto outcome = test::runProgram("bash", {"-c", line});
  EXPECT_EQ(outcome.err, "");
  std::set<std::string> answers;
  std::istringstream lines(outcome.out);
  for (std::string answer; std::getline(lines, answer);)
    if (!answer.empty()) answers.insert(answer);
  return answers;
}

TEST_F(Documentation, BashCompletesCommandsOptionsAndChoices) {
  const std::string script = folder_ / "completions/hoctomap";
  EXPECT_EQ(offered(script, {"hoctomap", ""}), std::set<std::string>(commands_.begin(), commands_.end()));
  EXPECT_EQ(offered(script, {"hoctomap", "bu"}), std::set<std::string>{"build"});
  for (const std::string& command : commands_) {
    std::set<std::string> dashed = namesIn(test::hoctomap({command, "--help"}).out);
    std::erase_if(dashed, [](const std::string& name) { return !name.starts_with("-"); });
    EXPECT_EQ(offered(script, {"hoctomap", command, "-"}), dashed) << command;
  }
  EXPECT_EQ(offered(script, {"hoctomap", "export", "map", "--format", "p"}),
            (std::set<std::string>{"pcd", "ply"}));
  EXPECT_EQ(offered(script, {"hoctomap", "edit", "map", "re"}), (std::set<std::string>{"relabel", "remove"}));
  EXPECT_EQ(offered(script, {"hoctomap", "edit", "map", "move", "3", "--fr"}),
            std::set<std::string>{"--frame"});
  EXPECT_EQ(offered(script, {"hoctomap", "import", "tum", "--images", "e"}),
            (std::set<std::string>{"embedded", "external"}));
  // File names, which bash completes where nothing is offered.
  EXPECT_TRUE(offered(script, {"hoctomap", "build", "-i", ""}).empty());
  EXPECT_TRUE(offered(script, {"hoctomap", "info", "ma"}).empty());
}

}  // namespace
}  // namespace hoctomap
