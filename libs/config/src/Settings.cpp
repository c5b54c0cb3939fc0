// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/config/Settings.h"

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include "IniText.h"
#include "SettingsKeys.h"
#include "SettingsValues.h"
#include "hoctomap/config/IniDocument.h"

namespace hoctomap {
namespace {

constexpr std::string_view label_prefix = "label.";

std::string labelSection(const Label& label) {
  return std::string(label_prefix) + label.name;
}

/// The labels of Eq. 10; others need a rule.
bool isPlain(const Label& label) {
  return label == labels::background || label == labels::table || label == labels::object;
}

bool isLabelName(std::string_view name) {
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  constexpr std::size_t longest = 64;
  return !name.empty() && name.size() <= longest && name.find_first_not_of(allowed) == std::string_view::npos;
}

// Labels that the segmentation can give: each needs a section.
std::vector<Label> usedLabels(const Settings& settings) {
  if (settings.monolithic) return {labels::background};
  return {labels::background, labels::table, labels::object};
}

const char* frameKey() {
  const auto all = keys::labelKeys();
  return std::find_if(all.begin(), all.end(),
                      [](const auto& key) {
                        return std::holds_alternative<FrameChoice& (*)(LabelProfile&)>(key.access);
                      })
      ->name;
}

void readLabel(IniDocument& document, const std::string& section, Settings& settings) {
  const Label label{section.substr(label_prefix.size())};
  LabelProfile profile = keys::defaultProfile(label);
  for (const auto& key : keys::labelKeys()) keys::read(document, section, key, profile);
  keys::checkOrders(document, section, keys::labelOrders(), keys::labelKeys(), profile);
  if (!isLabelName(label.name)) {
    document.problem(section, "", "a label is up to 64 letters, digits, _ and -");
  }
  if (label == labels::background && profile.frame != FrameChoice::world) {
    document.problem(section, frameKey(), "the frame of the root is the world frame");
  }
  settings.labels[label] = profile;
  if (isPlain(label)) return;
  LabelRule rule;
  for (const auto& key : keys::ruleKeys()) keys::read(document, section, key, rule);
  keys::checkOrders(document, section, keys::ruleOrders(), keys::ruleKeys(), rule);
  settings.rules[label] = rule;
}

void readLabels(IniDocument& document, Settings& settings) {
  settings.labels.clear();
  settings.rules.clear();
  for (const std::string& section : document.sections()) {
    if (section.starts_with(label_prefix)) readLabel(document, section, settings);
  }
  for (const Label& label : usedLabels(settings)) {
    if (settings.labels.contains(label)) continue;
    document.problem(labelSection(label), "", "a label without a section: add it, if only for the defaults");
    // A wrong section name is rather a typing error of this one.
    for (const auto& key : keys::labelKeys()) {
      LabelProfile ignored;
      keys::read(document, labelSection(label), key, ignored);
    }
  }
}

Settings readSettings(IniDocument document, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides) document.set(assignment);
  Settings settings;
  for (const auto& key : keys::settingsKeys()) keys::read(document, key.section, key, settings);
  keys::checkOrders(document, "", keys::settingsOrders(), keys::settingsKeys(), settings);
  readLabels(document, settings);
  settings.tabletop.range_noise = settings.existence.noise.quadratic;
  document.finish();
  return settings;
}

struct Value {
  std::string section;
  std::string key;
  std::string text;
};

// Every setting in the order of config.ini.
std::vector<Value> values(Settings settings) {
  std::vector<Value> all;
  for (const auto& key : keys::settingsKeys()) {
    all.push_back({key.section, key.name, keys::valueText(key, settings)});
  }
  for (auto& [label, profile] : settings.labels) {
    for (const auto& key : keys::labelKeys()) {
      all.push_back({labelSection(label), key.name, keys::valueText(key, profile)});
    }
    if (isPlain(label)) continue;
    for (const auto& key : keys::ruleKeys())
      all.push_back({labelSection(label), key.name, keys::valueText(key, settings.rules[label])});
  }
  return all;
}

// `0.05`, or `0.05 (background), 0.01 (table)` where the default depends on the label.
std::string labelDefaults(const keys::Key<LabelProfile>& key) {
  LabelProfile other = keys::defaultProfile(Label{});
  const std::string common = keys::valueText(key, other);
  std::string exceptions;
  for (const Label& label : {labels::background, labels::table, labels::object}) {
    LabelProfile profile = keys::defaultProfile(label);
    const std::string text = keys::valueText(key, profile);
    if (text != common) exceptions += "; " + label.name + ": " + text;
  }
  return common + exceptions;
}

}  // namespace

MappingConfig Settings::mappingConfig() const {
  MappingConfig config;
  config.max_range = sensor.max_range;
  config.bounded = !monolithic;
  config.contest_at_surface = contest_at_surface;
  config.seam_votes = seam_votes && !monolithic;
  config.confirm_scans = static_cast<std::uint64_t>(confirm_scans);
  config.reidentification.enabled = reidentify && !monolithic;
  config.reidentification.noise = existence.noise;
  config.reidentification.least_shift = std::max(config.reidentification.least_shift, existence.pose_shift);
  return config;
}

ExplorationConfig Settings::explorationConfig() const {
  ExplorationConfig config = exploration;
  config.noise = existence.noise;
  if (const auto profile = labels.find(hoctomap::labels::object); profile != labels.end())
    config.gain.sensor = profile->second.occupancy;
  return config;
}

std::vector<NamedRule> Settings::labelRules() const {
  std::vector<NamedRule> named;
  for (const auto& [label, rule] : rules) named.push_back({label, rule});
  return named;
}

Settings::Settings() {
  for (const Label& label : {labels::background, labels::table, labels::object}) {
    labels[label] = keys::defaultProfile(label);
  }
}

Settings loadSettings(const std::optional<std::filesystem::path>& file,
                      const std::vector<std::string>& overrides) {
  if (!file) return parseSettings(builtInIni(), "built-in tabletop.ini", overrides);
  return readSettings(IniDocument::fromFile(*file), overrides);
}

Settings parseSettings(std::string_view text, const std::string& name,
                       const std::vector<std::string>& overrides) {
  return readSettings(IniDocument::fromText(text, name), overrides);
}

std::string toIni(const Settings& settings) {
  std::string text = "# Every setting in force: the same log with these settings gives the same map.\n";
  std::string section;
  for (const Value& value : values(settings)) {
    if (value.section != section) text += "\n[" + value.section + "]\n";
    section = value.section;
    text += value.key + " = " + value.text + "\n";
  }
  return text;
}

std::vector<std::string> settingsDifferences(const Settings& a, const Settings& b) {
  using Texts = std::map<std::pair<std::string, std::string>, std::pair<std::string, std::string>>;
  Texts texts;
  for (const Value& value : values(a)) texts[{value.section, value.key}].first = value.text;
  for (const Value& value : values(b)) texts[{value.section, value.key}].second = value.text;
  std::vector<std::string> differences;
  const auto shown = [](const std::string& text) { return text.empty() ? "not set" : text; };
  for (const auto& [name, both] : texts) {
    if (both.first == both.second) continue;
    differences.push_back("[" + name.first + "] " + name.second + ": " + shown(both.first) + ", " +
                          shown(both.second));
  }
  return differences;
}

std::vector<KeyReference> configurationReference() {
  std::vector<KeyReference> reference;
  Settings defaults;
  for (const auto& key : keys::settingsKeys()) {
    reference.push_back({key.section, key.name, key.unit, keys::valueText(key, defaults),
                         keys::rangeText(key), key.description});
  }
  for (const auto& key : keys::labelKeys()) {
    reference.push_back(
        {key.section, key.name, key.unit, labelDefaults(key), keys::rangeText(key), key.description});
  }
  LabelRule rule;
  for (const auto& key : keys::ruleKeys()) {
    reference.push_back(
        {key.section, key.name, key.unit, keys::valueText(key, rule), keys::rangeText(key), key.description});
  }
  return reference;
}

}  // namespace hoctomap
