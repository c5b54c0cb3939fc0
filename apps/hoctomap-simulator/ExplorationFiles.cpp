// SPDX-License-Identifier: BSD-3-Clause
#include "ExplorationFiles.h"

#include <numbers>

#include "TextTable.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/LabelPng.h"

namespace hoctomap {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string optionalText(const std::optional<std::uint64_t>& value) {
  return value ? std::to_string(*value) : "";
}

void appendViewpoint(std::string& row, const Viewpoint& v) {
  appendNumber(row, v.world_T_base.x());
  appendNumber(row, v.world_T_base.y());
  appendNumber(row, kDegrees * v.world_T_base.yaw());
  appendNumber(row, v.base_T_sensor.z());
  appendNumber(row, kDegrees * v.base_T_sensor.pitch());
}

std::uint8_t greyOf(const TraversabilityMap& map, const GridCell& cell) {
  constexpr std::uint8_t kFree = 255;
  constexpr std::uint8_t kUnknown = 127;
  constexpr std::uint8_t kHit = 0;
  if (map.traversable(cell)) return kFree;
  return map.state(cell) == TraversabilityMap::State::unknown ? kUnknown : kHit;
}

}  // namespace

void ExplorationTable::add(const ExplorationStep& step, const std::optional<double>& coverage) {
  travel_ += step.travel;
  seconds_ += step.travel / robot_.speed + (step.scan ? robot_.measuring_time : 0.0);
  std::string row = std::to_string(step.step) + "," + toString(step.kind) + "," +
                    (step.table ? std::to_string(step.table->value) : "") + "," + optionalText(step.scan) +
                    "," + std::to_string(step.candidates.size());
  if (step.chosen) {
    const ExplorationStep::Candidate& chosen = step.candidates[*step.chosen];
    for (const double number : {chosen.gain, chosen.cost, chosen.utility}) appendNumber(row, number);
    appendViewpoint(row, chosen.viewpoint);
  } else {
    row += ",,,,,,,,";
  }
  appendNumber(row, step.entropy);
  row += "," + std::to_string(step.unknown_in_boxes);
  if (coverage)
    appendNumber(row, *coverage);
  else
    row += ",";
  for (const double number : {step.travel, travel_, seconds_}) appendNumber(row, number);
  text_ += row + "\n";
}

void writeTraversability(const TraversabilityMap& map, const std::filesystem::path& file_without_extension) {
  std::vector<std::uint8_t> grey;
  grey.reserve(map.cells());
  for (int y = map.height() - 1; y >= 0; --y)  // pictures begin at the top
    for (int x = 0; x < map.width(); ++x) grey.push_back(greyOf(map, {x, y}));
  std::filesystem::path png = file_without_extension;
  png += ".png";
  writeGreyPng(png, map.width(), map.height(), grey);
  std::filesystem::path yaml = file_without_extension;
  yaml += ".yaml";
  writeTextFile(yaml, "image: " + png.filename().string() + "\nresolution: " + fixedText(map.cellSize(), 6) +
                          "\norigin: [" + fixedText(map.corner().x(), 6) + ", " +
                          fixedText(map.corner().y(), 6) +
                          ", 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

std::string coverageCsv(const Scene& scene, const SurfaceCoverage& coverage,
                        const SurfaceCoverage::Result& result) {
  std::string csv = "object,table,samples,visible,covered,share\n";
  for (std::size_t i = 0; i < result.objects.size(); ++i) {
    const SurfaceCoverage::Object& object = coverage.objects()[i];
    csv += object.name + "," + scene.solid(object.table).name + "," + std::to_string(object.samples) + "," +
           std::to_string(result.objects[i].visible) + "," + std::to_string(result.objects[i].covered);
    appendNumber(csv, result.objects[i].value());
    csv += "\n";
  }
  return csv;
}

}  // namespace hoctomap
