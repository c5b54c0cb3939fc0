// SPDX-License-Identifier: BSD-3-Clause
#include "ExplorationPicture.h"

#include <cmath>

#include "TextTable.h"
#include "hoctomap/io/AtomicFile.h"
#include "hoctomap/io/Gnuplot.h"

namespace hoctomap {

namespace {

std::string pointText(const Eigen::Vector2d& p) {
  return fixedText(p.x(), 4) + " " + fixedText(p.y(), 4);
}

Eigen::Vector2d placeOf(const Viewpoint& v) {
  return {v.world_T_base.x(), v.world_T_base.y()};
}

std::string block(const std::string& name, const std::string& rows) {
  return "$" + name + " << EOD\n" + rows + "EOD\n";
}

/// `x y grey` of each cell.
std::string gridRows(const TraversabilityMap& map) {
  std::string rows;
  for (std::size_t i = 0; i < map.cells(); ++i) {
    const GridCell cell = map.cell(i);
    const TraversabilityMap::State state = map.state(cell);
    const int grey = map.traversable(cell)                         ? 255
                     : state == TraversabilityMap::State::occupied ? 90
                     : state == TraversabilityMap::State::unknown  ? 175
                                                                   : 222;
    rows += pointText(map.center(cell)) + " " + std::to_string(grey) + "\n";
  }
  return rows;
}

/// A square for each cell of a table's outline.
std::string tableRows(const MapHierarchy& map) {
  std::string rows;
  for (const TableArea& table : tableAreas(map, TableSpace{}))
    for (const Eigen::Vector2d& cell : table.outline) rows += pointText(cell) + "\n";
  return rows;
}

/// Centres of the voxels of objects, in the plan.
std::string objectRows(const MapHierarchy& map) {
  std::string rows;
  for (const NodeId id : map.ids()) {
    const MapNode& node = map.node(id);
    if (node.label() == labels::background || node.label() == labels::table) continue;
    const Eigen::Isometry3d world_T_node = toIsometry(map.world_T_node(id));
    for (const Eigen::Vector3f& voxel : node.map().occupiedVoxels())
      rows += pointText((world_T_node * voxel.cast<double>()).head<2>()) + "\n";
  }
  return rows;
}

}  // namespace

void ExplorationPicture::add(const ExplorationStep& step) {
  if (step.traversability == nullptr) return;  // looking around
  traversability_ = *step.traversability;
  for (const ExplorationStep::Candidate& candidate : step.candidates)
    candidates_.push_back(candidate.viewpoint);
  if (!step.chosen || !step.scan) return;
  chosen_.push_back(step.candidates[*step.chosen].viewpoint);
  paths_.push_back(step.path);
}

std::string ExplorationPicture::script(const MapHierarchy& map) const {
  std::string discs;
  for (const Viewpoint& v : candidates_) discs += pointText(placeOf(v)) + "\n";
  std::string arrows;
  std::string numbers;
  constexpr double kArrow = 0.32;  // m
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const double yaw = chosen_[i].world_T_base.yaw();
    const Eigen::Vector2d heading(std::cos(yaw), std::sin(yaw));
    arrows += pointText(placeOf(chosen_[i])) + " " + pointText(kArrow * heading) + "\n";
    numbers += pointText(placeOf(chosen_[i]) - 0.14 * heading) + " " + std::to_string(i + 1) + "\n";
  }
  std::string ways;
  for (const auto& path : paths_) {
    for (const Eigen::Vector2d& p : path) ways += pointText(p) + "\n";
    ways += "\n";
  }
  std::string text =
      "set terminal pngcairo size 1000,800 background '#ffffff' font 'sans,11'\nset encoding utf8\n";
  std::string plot;
  const auto layer = [&](const std::string& name, const std::string& rows, const std::string& style) {
    if (rows.empty()) return;
    text += block(name, rows);
    plot += (plot.empty() ? "plot $" : ", \\\n  $") + name + " " + style;
  };
  if (traversability_) layer("grid", gridRows(*traversability_), "using 1:2:3:3:3 with rgbimage notitle");
  layer("tables", tableRows(map),
        "using ($1-0.025):($2-0.025):($1-0.025):($1+0.025):($2-0.025):($2+0.025) with boxxyerror fs solid "
        "noborder "
        "lc rgb '#d9a9d6' title 'table'");
  layer("objects", objectRows(map), "using 1:2 with dots lc rgb '#008b8b' title 'objects'");
  layer("ways", ways, "using 1:2 with lines lw 1.5 lc rgb '#999999' title 'way'");
  layer("discs", discs, "using 1:2 with points pt 7 ps 0.7 lc rgb '#0072b2' title 'candidate viewpoints'");
  layer("arrows", arrows,
        "using 1:2:3:4 with vectors head filled size 0.1,25 lw 3 lc rgb '#d55e00' title 'chosen'");
  layer("numbers", numbers, "using 1:2:3 with labels font 'sans,12' tc rgb '#d55e00' notitle");
  if (plot.empty()) plot = "plot [0:1] [0:1] -1 notitle";
  return text +
         "set size ratio -1\nset xlabel 'x / m'\nset ylabel 'y / m'\nset key outside below horizontal\n" +
         plot + "\n";
}

void ExplorationPicture::draw(const MapHierarchy& map, const std::filesystem::path& file) const {
  replaceFile(file, drawWithGnuplot(script(map), file.filename().string()));
}

}  // namespace hoctomap
