// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Verb.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/MapTables.h"
#include "hoctomap/mrpt_io/RenderMap.h"

namespace hoctomap {
namespace {

/// `1600x1000` as width and height.
void parseSize(const std::string& text, RenderOptions& options) {
  const auto cross = text.find('x');
  std::size_t used = 0;
  try {
    if (cross == std::string::npos || text.find_first_not_of("0123456789x") != std::string::npos) throw 0;
    options.width = static_cast<unsigned>(std::stoul(text.substr(0, cross)));
    options.height = static_cast<unsigned>(std::stoul(text.substr(cross + 1), &used));
    if (cross + 1 + used != text.size()) throw 0;
  } catch (...) {
    throw ConfigError("--size: \"" + text + "\" is not of the form WIDTHxHEIGHT");
  }
}

/// `sensor`: from where the last scan was taken; `sensor:K`: scan K. None for other views.
std::optional<SensorView> sensorView(const std::string& view, const std::string& map,
                                     const Manifest& manifest) {
  const std::string name = "sensor";
  if (view != name && !view.starts_with(name + ":")) return std::nullopt;
  const std::string number = view == name ? "" : view.substr(name.size() + 1);
  std::optional<SensorView> found;
  for (const ScanTableRow& row : readScans(map, manifest)) {
    if (!row.world_T_sensor || (!number.empty() && number != std::to_string(row.scan))) continue;
    found = SensorView{*row.world_T_sensor};
    if (row.fov_x && row.fov_y) found = SensorView{*row.world_T_sensor, *row.fov_x, *row.fov_y};
  }
  if (!found)
    throw ConfigError("--view " + view + ": the map does not know of such a scan where it was taken from");
  return found;
}

}  // namespace

void addRenderCommand(CLI::App& app, VerbRun& run) {
  auto* verb = app.add_subcommand("render", "a picture of a map, without a display");
  const auto map = std::make_shared<std::string>();
  const auto out = std::make_shared<std::string>();
  const auto size = std::make_shared<std::string>();
  const auto options = std::make_shared<RenderOptions>();
  const auto at_scan = std::make_shared<std::optional<std::uint64_t>>();
  verb->add_option("map", *map, "map directory")->required();
  verb->add_option("-o,--output", *out, "PNG to write")->required();
  verb->add_option("--size", *size, "pixels, WIDTHxHEIGHT")->default_str("1600x1000");
  verb->add_option("--view", options->view, "where to look from: a name, or AZIMUTH,ELEVATION")
      ->capture_default_str();
  verb->add_flag("--labels", options->labels, "also boxes and labels of the nodes");
  const auto hidden = std::make_shared<std::vector<std::string>>();
  verb->add_option("--hide", *hidden, "leave out the nodes of a label; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb->add_option("--at-scan", *at_scan, "the map as it was after this scan");
  verb->callback([=, &run] {
    run = [=] {
      for (const std::string& label : *hidden) options->hidden.insert(Label{label});
      if (!size->empty()) parseSize(*size, *options);
      const StoredMap stored = readMap(*map, {.at_scan = *at_scan});
      options->sensor = sensorView(options->view, *map, stored.manifest);
      renderMap(stored.hierarchy, *options, *out);
      return 0;
    };
  });
}

}  // namespace hoctomap
