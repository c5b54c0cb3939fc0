// SPDX-License-Identifier: BSD-3-Clause
#include "vi_c/GainTruth.h"

#include <cmath>

#include "hoctomap/simulation/SimulatedRangeSensor.h"

namespace hoctomap {

GainTruth::GainTruth(const Simulation& simulation, const ExplorationConfig& config)
    : config_(config),
      camera_(simulation.sensor.camera),
      min_range_(simulation.sensor.min_range),
      max_range_(simulation.sensor.max_range),
      planned_range_(simulation.robot->model.max_range),
      scene_(simulation.scene) {
  const double shrink = std::max(1.0, camera_.width / 160.0);
  camera_ = {static_cast<int>(camera_.width / shrink),
             static_cast<int>(camera_.height / shrink),
             camera_.fx / shrink,
             camera_.fy / shrink,
             (camera_.cx + 0.5) / shrink - 0.5,
             (camera_.cy + 0.5) / shrink - 0.5};
}

void GainTruth::add(const Measurement& z) {
  scans_.push_back({z.origin().cast<float>(), z.world_points});
}

void GainTruth::look(const MapHierarchy& map, NodeId table) {
  table_.reset();
  unknown_.clear();
  if (!map.contains(table)) return;
  const auto area = tableArea(map, table, config_.space);
  if (!area) return;
  table_ = table;
  if (!cleared_ || !cleared_->space().contains(area->space)) {
    cleared_.emplace(area->space, config_.cleared_resolution, config_.noise);
    cleared_scans_ = 0;
  }
  for (; cleared_scans_ < scans_.size(); ++cleared_scans_)
    cleared_->add(scans_[cleared_scans_].origin, scans_[cleared_scans_].world_points);
  const KnowledgeGrid knowledge(map, *area, *cleared_, config_.cell, planned_range_);
  const KnowledgeGrid::Grid& grid = knowledge.fine();
  cell_ = grid.cell;
  for (int z = 0; z < grid.size[2]; ++z)
    for (int y = 0; y < grid.size[1]; ++y)
      for (int x = 0; x < grid.size[0]; ++x)
        if (grid.cells[grid.index(x, y, z)] == static_cast<std::uint8_t>(Knowledge::unknown_in_box))
          unknown_.push_back(grid.center(x, y, z));
}

std::vector<GainCheck> GainTruth::check(const ExplorationStep& step) const {
  std::vector<GainCheck> checks;
  if (table_ != step.table) return checks;
  for (const ExplorationStep::Candidate& candidate : step.candidates)
    checks.push_back({candidate.gain, cellsShown(candidate.viewpoint)});
  return checks;
}

double GainTruth::cellsShown(const Viewpoint& viewpoint) const {
  const Rendering rendering = render(scene_, camera_, viewpoint.world_T_sensor(), 1);
  const Eigen::Isometry3d sensor_T_world = toIsometry(viewpoint.world_T_sensor()).inverse();
  std::size_t shown = 0;
  for (const Eigen::Vector3d& cell : unknown_) {
    const Eigen::Vector3d p = sensor_T_world * cell;
    if (p.x() < min_range_) continue;
    const auto u = static_cast<int>(std::lround(camera_.cx - camera_.fx * p.y() / p.x()));
    const auto v = static_cast<int>(std::lround(camera_.cy - camera_.fy * p.z() / p.x()));
    if (u < 0 || v < 0 || u >= camera_.width || v >= camera_.height) continue;
    const auto depth = static_cast<double>(rendering.image.at(u, v));
    const bool is_measured = depth >= min_range_ && depth <= max_range_;
    shown += is_measured && p.x() <= depth + 0.5 * cell_ ? 1U : 0U;
  }
  return static_cast<double>(shown);
}

}  // namespace hoctomap
