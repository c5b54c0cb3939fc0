// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/config/Settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "Problems.h"
#include "support/SharedData.h"

namespace hoctomap {
namespace {

using test::problemsOf;

std::filesystem::path configs() {
  return test::sourceDir() / "configs";
}

std::string textOf(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

using Differences = std::vector<std::string>;

TEST(Settings, TheBuiltInFileIsTheShippedOneAndTheDefaults) {
  EXPECT_EQ(builtInIni(), textOf(configs() / "tabletop.ini"));
  EXPECT_EQ(settingsDifferences(loadSettings({}), loadSettings(configs() / "tabletop.ini")), Differences{});
  EXPECT_EQ(settingsDifferences(loadSettings({}), Settings{}), Differences{});
}

TEST(Settings, TabletopIsWhatTheDesignRecommends) {
  const Settings settings = loadSettings(configs() / "tabletop.ini");
  const LabelProfile& background = settings.labels.at(labels::background);
  const LabelProfile& table = settings.labels.at(labels::table);
  const LabelProfile& object = settings.labels.at(labels::object);
  EXPECT_EQ(settings.labels.size(), 3U);
  EXPECT_EQ(background.resolution, 0.05);
  EXPECT_EQ(background.frame, FrameChoice::world);
  EXPECT_EQ(background.carve, Carve::scan);
  EXPECT_FALSE(background.existence_enabled);
  EXPECT_EQ(table.resolution, 0.01);
  EXPECT_EQ(object.resolution, 0.002);
  for (const LabelProfile* profile : {&table, &object}) {
    EXPECT_EQ(profile->frame, FrameChoice::pca);
    EXPECT_EQ(profile->carve, Carve::own);
    EXPECT_EQ(profile->grazing, Grazing::spare);
    EXPECT_TRUE(profile->existence_enabled);
    EXPECT_EQ(profile->occupancy.prob_hit, 0.7);
    EXPECT_EQ(profile->occupancy.clamping_min, 0.1192);
  }
  EXPECT_EQ(settings.limits.max_inflated_bytes, 8LL * 1024 * 1024 * 1024);
  EXPECT_EQ(settings.limits.max_object_bytes, 1024LL * 1024 * 1024);
  EXPECT_EQ(settings.mappingConfig().max_range, -1.0);
  EXPECT_TRUE(settings.mappingConfig().bounded);
}

TEST(Settings, PaperFollowsThePaper) {
  const Settings settings = loadSettings(configs() / "paper.ini");
  EXPECT_EQ(settings.tabletop.cluster_tolerance, 0.01);
  EXPECT_EQ(settings.tabletop.table_height_min, 0.5);
  EXPECT_EQ(settings.tabletop.table_height_max, 1.0);
  EXPECT_EQ(settings.association_margin, 0.0);
  for (const auto& [label, profile] : settings.labels) {
    EXPECT_EQ(profile.carve, Carve::own) << label.name;
    EXPECT_EQ(profile.grazing, Grazing::clear) << label.name;
  }
  EXPECT_EQ(settings.labels.at(labels::object).resolution, 0.002);
  EXPECT_EQ(settings.labels.at(labels::background).frame, FrameChoice::world);
}

TEST(Settings, MonolithicIsOneUnboundedMap) {
  const Settings settings = loadSettings(configs() / "monolithic.ini");
  EXPECT_TRUE(settings.monolithic);
  EXPECT_FALSE(settings.mappingConfig().bounded);
  EXPECT_EQ(settings.labels.size(), 1U);
  EXPECT_EQ(settings.labels.at(labels::background).resolution, 0.01);
}

TEST(Settings, ShippedFilesSurviveTheRoundTrip) {
  for (const char* name : {"tabletop.ini", "paper.ini", "monolithic.ini"}) {
    const Settings settings = loadSettings(configs() / name);
    const std::string text = toIni(settings);
    const Settings again = parseSettings(text, "config.ini");
    EXPECT_EQ(settingsDifferences(settings, again), Differences{}) << name;
    EXPECT_EQ(toIni(again), text) << name;
  }
}

TEST(Settings, WrittenIniHoldsEveryKeyOnce) {
  const std::string text = toIni(Settings{});
  std::map<std::string, int> lines;
  std::istringstream in(text);
  std::string section;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('[')) section = line;
    if (line.find(" = ") != std::string::npos) ++lines[section + line.substr(0, line.find(" = "))];
  }
  std::size_t expected = 0;
  for (const KeyReference& key : configurationReference()) {
    const bool of_label = key.section == "label.NAME";
    if (key.section == "label.OWN") continue;  // of labels that are not there by default
    for (const char* label : {"background", "table", "object"}) {
      if (!of_label && label != std::string("table")) continue;
      const std::string name = "[" + (of_label ? std::string("label.") + label : key.section) + "]" + key.key;
      EXPECT_EQ(lines[name], 1) << name;
      ++expected;
    }
  }
  EXPECT_EQ(lines.size(), expected);
}

// A value inside the range that `range` describes, and "" sometimes where the default may stay.
std::string randomValue(const KeyReference& key, std::mt19937_64& rng) {
  const auto one = [&] { return std::uniform_real_distribution<double>(0, 1)(rng); };
  if (key.range.starts_with("none") && one() < 0.3) return "none";
  if (key.range.find_first_of("<>") == std::string::npos) {  // words
    std::vector<std::string> words;
    std::istringstream in(key.range);
    for (std::string word; in >> word;) words.push_back(word.substr(0, word.find(',')));
    return words.at(std::uniform_int_distribution<std::size_t>(0, words.size() - 1)(rng));
  }
  const auto bound = [&](const char* sign, double otherwise) {
    const std::size_t at = key.range.find(sign);
    return at == std::string::npos ? otherwise : std::stod(key.range.substr(key.range.find(' ', at)));
  };
  const double low = bound(">", 0);
  const double high = bound("<", 1e6);
  const bool whole = key.default_value.find('.') == std::string::npos && high >= 1000 && key.unit != "m" &&
                     key.unit != "s" && key.key != "max_inflate_ratio";
  std::ostringstream text;
  text.precision(17);
  if (whole) {
    text << std::uniform_int_distribution<std::int64_t>(static_cast<std::int64_t>(low),
                                                        static_cast<std::int64_t>(high))(rng);
  } else {
    // Small values, too: numbers with exponents.
    text << low + (high - low) * std::pow(10.0, -8.0 * one()) * (0.001 + 0.998 * one());
  }
  return text.str();
}

TEST(Settings, RulesNameLabelsOfOnesOwn) {
  const Settings settings =
      parseSettings(std::string(builtInIni()) + "[label.cup]\nrule = object\nmax_length = 0.14\n", "test");
  ASSERT_EQ(settings.labelRules().size(), 1U);
  EXPECT_EQ(settings.labelRules()[0].label, Label{"cup"});
  EXPECT_EQ(settings.labelRules()[0].rule.max_length, 0.14);
  EXPECT_TRUE(loadSettings(std::nullopt).labelRules().empty());
  for (const char* wrong :
       {"[label.cup]\nrule = plane\n", "[label.cup]\nmax_length = 0.1\nmin_length = 0.2\n",
        "[label.cup]\nshape = round\n", "[label.cup]\nmin_heigth = 0.1\n"}) {
    EXPECT_NE(
        problemsOf([&] { static_cast<void>(parseSettings(std::string(builtInIni()) + wrong, "test")); }), "")
        << wrong;
  }
  // Labels of Eq. 10 need no rule, and have none.
  EXPECT_NE(problemsOf([&] { static_cast<void>(loadSettings(std::nullopt, {"label.object.rule=object"})); }),
            "");
}

TEST(Settings, RandomValidSettingsSurviveTheRoundTrip) {
  std::mt19937_64 rng(7);
  const std::vector<KeyReference> keys = configurationReference();
  int valid = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::string> overrides;
    for (int k = 0; k < 4; ++k) {
      const KeyReference& key = keys.at(std::uniform_int_distribution<std::size_t>(0, keys.size() - 1)(rng));
      const std::string section =
          key.section == "label.NAME" ? "label.cup-" + std::to_string(k) : key.section;
      overrides.push_back(section + "." + key.key + "=" + randomValue(key, rng));
    }
    Settings settings;
    const std::string problems = problemsOf([&] { settings = loadSettings({}, overrides); });
    // Only numbers that contradict each other may be refused.
    if (!problems.empty()) {
      EXPECT_NE(problems.find(" must be "), std::string::npos) << problems;
      EXPECT_EQ(problems.find("out of range"), std::string::npos) << problems;
      EXPECT_EQ(problems.find("number"), std::string::npos) << problems;
      continue;
    }
    ++valid;
    const std::string text = toIni(settings);
    const Settings again = parseSettings(text, "config.ini");
    ASSERT_EQ(settingsDifferences(settings, again), Differences{});
    ASSERT_EQ(toIni(again), text);
  }
  EXPECT_GT(valid, 1000);
}

TEST(Settings, NumbersAreExactAfterTheRoundTrip) {
  Settings settings;
  settings.poses.max_gap = 0.1 + 0.2;
  settings.labels.at(labels::object).resolution = 1.0 / 3.0;
  settings.sensor.max_range = 5e-324;
  settings.sensor.min_range = 0.0;
  settings.limits.max_inflated_bytes = 999'999'999'999'999;
  settings.tabletop.seed = 4294967295;
  const Settings again = parseSettings(toIni(settings), "config.ini");
  EXPECT_EQ(again.poses.max_gap, 0.1 + 0.2);
  EXPECT_EQ(again.labels.at(labels::object).resolution, 1.0 / 3.0);
  EXPECT_EQ(again.sensor.max_range, 5e-324);
  EXPECT_EQ(again.limits.max_inflated_bytes, 999'999'999'999'999);
  EXPECT_EQ(again.tabletop.seed, 4294967295U);
}

TEST(Settings, OverridesReachEveryPart) {
  const Settings settings =
      loadSettings({}, {"label.object.resolution=0.004", "label.object.max_range=none",
                        "label.table.max_range = 2.5", "label.cup.carve=scan", "sensor.max_range=4",
                        "sensor.noise_constant=0.001", "mapping.monolithic=true", "segmentation.seed=9",
                        "limits.max_nodes=7", "mapping.checkpoint_scans=3", "mapping.checkpoint_scans=4"});
  EXPECT_EQ(settings.labels.at(labels::object).resolution, 0.004);
  EXPECT_EQ(settings.labels.at(labels::object).max_range, -1.0);
  EXPECT_EQ(settings.labels.at(labels::table).max_range, 2.5);
  EXPECT_EQ(settings.labels.at(Label{"cup"}).carve, Carve::scan);
  EXPECT_EQ(settings.mappingConfig().max_range, 4.0);
  EXPECT_EQ(settings.existence.noise.constant, 0.001);
  EXPECT_FALSE(settings.mappingConfig().bounded);
  EXPECT_EQ(settings.tabletop.seed, 9U);
  EXPECT_EQ(settings.limits.max_nodes, 7);
  EXPECT_EQ(settings.checkpoint_scans, 4);
}

TEST(Settings, DifferencesNameTheKeyAndBothValues) {
  const Settings a = loadSettings({}, {"label.cup.resolution=0.004"});
  const Settings b = loadSettings({}, {"sensor.max_range=3"});
  const Differences differences = settingsDifferences(a, b);
  EXPECT_EQ(differences.back(), "[sensor] max_range: none, 3");
  EXPECT_EQ(std::count(differences.begin(), differences.end(), "[label.cup] resolution: 0.004, not set"), 1);
}

}  // namespace
}  // namespace hoctomap
