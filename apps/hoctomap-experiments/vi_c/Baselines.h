// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "hoctomap/exploration/Explorer.h"

namespace hoctomap {

/// Ways to choose viewpoints that look at no map but the traversability map.
enum class Baseline : std::uint8_t {
  random,    ///< any of the candidates that the explorer would draw
  circle_4,  ///< four even directions around a table, then the four between them, ...
  circle_8
};

/// Goes around all tables like that, with the explorer's own pieces: a look around at the start, m_trav,
/// paths, viewpoints that face the table. Tables are taken nearest first, a round of four (random, circle_4)
/// or eight views each, until each has had its views.
class BaselineExplorer {
 public:
  using OnView = std::function<void(const TableArea&, double travel)>;  ///< m, of this view
  using OnMeasurement = std::function<void(const Measurement&)>;

  /// All of them have to live as long as this. @param views of each table
  BaselineExplorer(Baseline baseline, const ExplorationConfig& config, int views, Robot& robot,
                   MeasurementSource& sensor, HierarchyMapper& mapper);

  void onView(OnView call) { on_view_ = std::move(call); }
  void onLook(std::function<void()> call) { on_look_ = std::move(call); }
  void run();

 private:
  /// A table with the views that it has had. Nodes may be replaced: a table is known by its place.
  struct Visited {
    Eigen::Vector2d center;
    int views = 0;
    int rounds = 0;
  };

  void lookAround();
  void measure();
  [[nodiscard]] std::optional<TableArea> nextTable();
  [[nodiscard]] Visited& visitedOf(const TableArea& area);
  void round(NodeId table);
  bool view(NodeId table, const Eigen::Vector2d& place);
  [[nodiscard]] std::vector<Eigen::Vector2d> randomPlaces(const TableArea& area, const TravelCost& travel,
                                                          int count);
  [[nodiscard]] static std::vector<Eigen::Vector2d> circlePlaces(const TableArea& area,
                                                                 const TravelCost& travel, double radius,
                                                                 int count, bool between);

  Baseline baseline_;
  ExplorationConfig config_;
  int views_;
  Robot& robot_;
  MeasurementSource& sensor_;
  HierarchyMapper& mapper_;
  ViewpointSampler sampler_;
  OnView on_view_;
  std::function<void()> on_look_;
  std::vector<Visited> visited_;
  std::uint64_t draws_ = 0;
};

}  // namespace hoctomap
