// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hoctomap/existence/BeamExistenceModel.h"
#include "hoctomap/exploration/Explorer.h"
#include "hoctomap/mapping/HierarchyMapper.h"
#include "hoctomap/mapping/LabelProfile.h"
#include "hoctomap/tabletop/LabelRules.h"
#include "hoctomap/tabletop/TabletopConfig.h"

namespace hoctomap {

/// How measurements get their sensor poses.
struct PosesConfig {
  double max_gap = 0.2;  ///< s, largest gap between two poses that is interpolated over
};

/// What is taken from a measurement. The noise of ranges, also of `[sensor]`, is in Settings::existence and,
/// as far as it is used there, in Settings::tabletop.
struct SensorConfig {
  double min_range = 0.0;   ///< m, nearer points are dropped
  double max_range = -1.0;  ///< m, farther beams only clear space up to it; negative: no limit
};

/// What input and map may grow to before the run ends with a LimitError (skipped scans: exit 3).
struct Limits {
  std::int64_t max_inflated_bytes = std::int64_t{8} << 30;
  double max_inflate_ratio = 100.0;
  std::int64_t max_object_bytes = std::int64_t{1} << 30;
  std::int64_t max_points = 10'000'000;  ///< of a scan
  double max_memory = -1.0;              ///< MB, of the program; negative: nine tenths of the machine's
  std::int64_t max_nodes = 100'000;
  int max_depth = 64;               ///< of the hierarchy
  double max_skipped_share = 0.05;  ///< of the 3D scans
};

/// Every setting of a run. The defaults are those of the built-in `tabletop.ini`.
struct Settings {
  Settings();  ///< with the profiles of background, table and object

  bool monolithic = false;          ///< S(z) = {z}, one map, beams unbounded
  double association_margin = 0.0;  ///< m, by which boxes are grown in f_A
  bool contest_at_surface = true;   ///< of several segments in a node's box, those at its surface join it
  bool seam_votes = true;           ///< nodes are split and merged by votes on where objects meet
  bool reidentify = true;           ///< moved objects are found by registration
  int confirm_scans = 2;            ///< scans that must show an object before its node enters the map
  int checkpoint_scans = 10;        ///< scans between two commits to disk
  PosesConfig poses;
  SensorConfig sensor;
  TabletopSegmentationConfig tabletop;
  BeamExistenceConfig existence;
  ExplorationConfig exploration;  ///< without the sensor model: see explorationConfig()
  Limits limits;
  LabelProfiles labels;
  std::map<Label, LabelRule> rules;  ///< of labels other than background, table and object

  [[nodiscard]] MappingConfig mappingConfig() const;
  /// `exploration` with the sensor model of objects.
  [[nodiscard]] ExplorationConfig explorationConfig() const;
  /// The rules that name segments.
  [[nodiscard]] std::vector<NamedRule> labelRules() const;
};

/// Settings from an INI file, or from the built-in `tabletop.ini` if there is none. `overrides` are
/// `section.key=value` (`--set`), applied before anything is checked; the last of several for one key counts.
/// @throws ConfigError naming all problems.
[[nodiscard]] Settings loadSettings(const std::optional<std::filesystem::path>& file,
                                    const std::vector<std::string>& overrides = {});

/// The same from a text; `name` stands for the file in messages.
[[nodiscard]] Settings parseSettings(std::string_view text, const std::string& name,
                                     const std::vector<std::string>& overrides = {});

/// The text of the built-in `tabletop.ini`.
[[nodiscard]] std::string_view builtInIni();

/// Every setting in force as INI text: same settings, same bytes. Loading it gives the same settings.
[[nodiscard]] std::string toIni(const Settings& settings);

/// Settings that differ, one text each: `[section] key: VALUE OF A, VALUE OF B`; empty for equal settings.
[[nodiscard]] std::vector<std::string> settingsDifferences(const Settings& a, const Settings& b);

/// One key as docs/configuration.md lists it.
struct KeyReference {
  std::string section;  ///< `label.NAME` for those of the labels
  std::string key;
  std::string unit;
  std::string default_value;
  std::string range;
  std::string description;
};

/// Every key of the configuration, in the order in which `toIni` writes them.
[[nodiscard]] std::vector<KeyReference> configurationReference();

}  // namespace hoctomap
