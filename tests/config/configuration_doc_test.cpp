// SPDX-License-Identifier: BSD-3-Clause
// docs/configuration.md and the table of keys say the same.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "hoctomap/config/Settings.h"
#include "support/SharedData.h"

namespace hoctomap {
namespace {

using Tables = std::map<std::string, std::vector<std::string>>;  // section -> rows

std::string row(const KeyReference& key) {
  return "| `" + key.key + "` | " + key.unit + " | " + key.default_value + " | " + key.range + " | " +
         key.description + " |";
}

// Rows of keys (`| \`key\` ...`) under headings such as "## [mapping]".
Tables documented() {
  std::ifstream in(test::sourceDir() / "docs" / "configuration.md");
  Tables tables;
  std::string section;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## [")) section = line.substr(4, line.find(']') - 4);
    if (!section.empty() && line.starts_with("| `")) tables[section].push_back(line);
  }
  return tables;
}

TEST(ConfigurationDocument, ListsEveryKeyWithUnitDefaultRangeAndMeaning) {
  Tables expected;
  for (const KeyReference& key : configurationReference()) expected[key.section].push_back(row(key));
  const Tables tables = documented();
  for (const auto& [section, rows] : expected) {
    ASSERT_TRUE(tables.contains(section)) << "docs/configuration.md has no heading `## [" << section << "]`";
    std::string wanted;
    for (const std::string& one : rows) wanted += one + "\n";
    std::string found;
    for (const std::string& one : tables.at(section)) found += one + "\n";
    EXPECT_EQ(found, wanted) << "rows of [" << section << "] in docs/configuration.md";
  }
  for (const auto& [section, rows] : tables) {
    EXPECT_TRUE(expected.contains(section)) << "docs/configuration.md names an unknown section " << section;
  }
}

}  // namespace
}  // namespace hoctomap
