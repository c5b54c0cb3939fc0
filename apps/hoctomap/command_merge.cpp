// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <sstream>
#include <tuple>

#include "Command.h"
#include "SceneMaker.h"
#include "TransformOption.h"
#include "hoctomap/config/Settings.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/MapCheck.h"
#include "hoctomap/io/MapDescription.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/Sha256.h"
#include "hoctomap/query/HierarchyMerge.h"

namespace hoctomap {

namespace {

struct MergeOptions {
  std::vector<std::string> maps;
  std::vector<std::string> transforms;
  std::string output;
};

struct Source {
  std::string path;
  std::string sha256;  ///< of the manifest, which vouches for everything else in the map
  std::string config;
  Pose world_T_map;
  StoredMap map;
};

/// Of a file that has just been checked against its hash.
std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Source readSource(const std::string& path, const Pose& world_T_map) {
  const std::filesystem::path directory(path);
  MapReadOptions with_waiting;
  with_waiting.to_edit = true;
  StoredMap map = readMap(directory, with_waiting);
  if (const auto damage = findDamage(directory, map.manifest); !damage.empty()) {
    throw MapError(path + "/" + damage.front().path + ": " + damage.front().what);
  }
  std::string config = textOf(directory / map.manifest.config.path);
  return {path, sha256Hex(toYaml(map.manifest)), std::move(config), world_T_map, std::move(map)};
}

/// Where two configurations part: "[section] line".
std::string difference(const std::string& a, const std::string& b) {
  std::istringstream in_a(a);
  std::istringstream in_b(b);
  std::string section;
  for (std::string line_a, line_b;;) {
    const bool more_a = static_cast<bool>(std::getline(in_a, line_a));
    const bool more_b = static_cast<bool>(std::getline(in_b, line_b));
    if (!more_a && !more_b) return "nothing but their ends";
    if (line_a != line_b || more_a != more_b) {
      return section + " \"" + escapedText(line_a, 100) + "\" and \"" + escapedText(line_b, 100) + "\"";
    }
    if (line_a.starts_with("[")) section = line_a;
  }
}

/// In the order of their last scans, whatever the order of the arguments.
std::vector<Source> readSources(const MergeOptions& options) {
  if (!options.transforms.empty() && options.transforms.size() + 1 != options.maps.size()) {
    throw ConfigError("--transform is wanted for every map after the first, or for none: " +
                      std::to_string(options.maps.size() - 1) + ", not " +
                      std::to_string(options.transforms.size()));
  }
  std::vector<Source> sources;
  for (std::size_t i = 0; i < options.maps.size(); ++i) {
    const bool stays = i == 0 || options.transforms.empty();
    sources.push_back(
        readSource(options.maps[i], stays ? Pose() : parseTransform(options.transforms[i - 1])));
  }
  std::sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) {
    return std::tie(a.map.manifest.last_stamp, a.sha256) < std::tie(b.map.manifest.last_stamp, b.sha256);
  });
  for (std::size_t i = 1; i < sources.size(); ++i) {
    const Source& a = sources[i - 1];
    const Source& b = sources[i];
    if (a.sha256 == b.sha256) {
      throw ConfigError(a.path + " and " + b.path + " are the same map: its scans would count twice");
    }
    if (a.config != b.config) {
      throw ConfigError(a.path + " and " + b.path +
                        " have different settings: " + difference(a.config, b.config));
    }
  }
  return sources;
}

int merge(const MergeOptions& options) {
  if (options.maps.size() < 2) throw ConfigError("merge wants two maps or more");
  const std::vector<Source> sources = readSources(options);
  const Settings settings = loadSettings(
      std::filesystem::path(sources.front().path) / sources.front().map.manifest.config.path, {});
  std::vector<MergePart> parts;
  std::string input = "merge";
  std::uint64_t mapped_scans = 0;
  std::uint64_t skipped_scans = 0;
  for (const Source& source : sources) {
    const Manifest& manifest = source.map.manifest;
    const std::string name = source.sha256.substr(0, 12);
    parts.push_back({source.map.hierarchy, source.world_T_map, manifest.scans, manifest.last_stamp, name});
    input += "+" + source.sha256;
    mapped_scans += manifest.mapped_scans;
    skipped_scans += manifest.skipped_scans;
    std::cout << "map " << name << "  " << escapedText(source.path) << "\n";
  }
  MergeConfig config;
  config.confirm_scans = settings.mappingConfig().confirm_scans;
  const MergedMaps merged = mergeMaps(parts, settings.labels, config);

  MapDirectory directory(options.output,
                         {MapOpenMode::create, sources.front().config, "hoctomap " HOCTOMAP_VERSION, {}});
  for (const UpdateReport& report : merged.reports) directory.append(report);
  directory.commit({.hierarchy = merged.hierarchy,
                    .removed = merged.removed,
                    .scans = merged.scans,
                    .input = input,
                    .last_stamp = parts.back().last_stamp,
                    .mapped_scans = mapped_scans,
                    .skipped_scans = skipped_scans});
  directory.writeScene(makeScene);
  std::cout << describeMap(readManifest(directory.path())) << "\nmap        " << escapedText(options.output)
            << std::endl;
  return 0;
}

}  // namespace

void addMergeCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command =
      addCommand(app, "merge", "Merge maps of one place into one hierarchy, whatever their order",
                 {"hoctomap merge monday tuesday -o both",
                  "hoctomap merge monday tuesday --transform 0.5,0,0,90,0,0 -o both"});
  command->add_option("maps", options->maps, "map directories, of the same settings")
      ->type_name("MAP")
      ->required();
  command->add_option("-o,--output", options->output, "directory of the new map")
      ->type_name("DIR")
      ->required();
  command
      ->add_option("--transform", options->transforms,
                   "world of a map after the first in that of the first (m, degrees); once for each")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("X,Y,Z,YAW,PITCH,ROLL");
  command->callback([options, &action] { action = [options] { return merge(*options); }; });
}

}  // namespace hoctomap
