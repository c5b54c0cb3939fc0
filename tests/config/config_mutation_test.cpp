// SPDX-License-Identifier: BSD-3-Clause
// Damaged configurations are read or refused with a message, never anything else.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "Problems.h"
#include "hoctomap/config/Settings.h"
#include "support/SharedData.h"

namespace hoctomap {
namespace {

using test::problemsOf;

std::size_t below(std::mt19937_64& rng, std::size_t end) {
  return std::uniform_int_distribution<std::size_t>(0, end - 1)(rng);
}

std::string mutated(std::string text, std::mt19937_64& rng) {
  constexpr std::string_view telling = "[]=.;#/,-+eE019nainf \t\r\n\x00\x1b\xff\xef\xbb\xbf";
  for (std::size_t changes = 1 + below(rng, 4); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = below(rng, text.size());
    switch (below(rng, 5)) {
      case 0:
        text[at] = static_cast<char>(below(rng, 256));
        break;
      case 1:
        text[at] = telling[below(rng, telling.size())];
        break;
      case 2:
        text.insert(at, 1, telling[below(rng, telling.size())]);
        break;
      case 3:
        text.erase(at, 1 + below(rng, 20));
        break;
      default:
        text.insert(below(rng, text.size()), text.substr(at, 1 + below(rng, 200)));
    }
  }
  return text;
}

TEST(ConfigMutation, IsReadOrRefusedWithPrintableLines) {
  std::mt19937_64 rng(11);
  int refused = 0;
  int read = 0;
  for (const char* name : {"tabletop.ini", "paper.ini", "monolithic.ini"}) {
    std::ostringstream original;
    original << std::ifstream(test::sourceDir() / "configs" / name).rdbuf();
    ASSERT_FALSE(original.str().empty());
    for (int i = 0; i < 3000; ++i) {
      const std::string text = mutated(original.str(), rng);
      Settings settings;
      const std::string problems = problemsOf([&] { settings = parseSettings(text, "f.ini"); });
      ++(problems.empty() ? read : refused);
      std::istringstream lines(problems);
      for (std::string line; std::getline(lines, line);) {
        ASSERT_TRUE(line.starts_with("f.ini:")) << line;
        for (const char c : line) ASSERT_FALSE(c >= 0 && (c < 0x20 || c == 0x7f)) << problems;
      }
      // What is read is in order: it is written and read again.
      if (problems.empty()) {
        ASSERT_EQ(toIni(parseSettings(toIni(settings), "config.ini")), toIni(settings));
      }
    }
  }
  EXPECT_GT(refused, 2000);
  EXPECT_GT(read, 1000);
}

}  // namespace
}  // namespace hoctomap
