// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hoctomap/exploration/ExpectedInformationGain.h"
#include "hoctomap/exploration/ViewpointSampler.h"
#include "hoctomap/mapping/HierarchyMapper.h"

namespace hoctomap {

enum class UtilityForm : std::uint8_t {
  ratio,    ///< gain / cost: Eq. 13 of the logarithms of gain and cost with alpha = 0.5
  additive  ///< Eq. 13: alpha * gain - (1 - alpha) * cost
};

struct ExplorationConfig {
  TraversabilityConfig traversability;
  ViewpointConfig viewpoints;
  GainConfig gain;
  TableSpace space;
  UtilityForm utility = UtilityForm::ratio;
  double alpha = 0.5;  ///< of `additive`
  double tau = 0.04;   ///< a table is explored when no gain is more than this share of its first one
  int first_look = 7;  ///< views around at the start, for the background
  int max_views = 20;  ///< of one table
  double cleared_resolution = 0.01;  ///< m
  double cell = 0.005;               ///< m, of the grid that gains are computed in
  std::uint64_t seed = 1;
};

/// One turn of the loop of Algorithm 1.
struct ExplorationStep {
  std::uint64_t step = 0;
  std::uint64_t scan = 0;       ///< number of the measurement that it led to, if `measured`
  std::optional<NodeId> table;  ///< none while looking around
  struct Candidate {
    Viewpoint viewpoint;
    double gain = 0.0;
    double cost = 0.0;  ///< s
    double utility = 0.0;
  };
  std::vector<Candidate> candidates;
  std::optional<std::size_t> chosen;  ///< of the candidates
  std::vector<Eigen::Vector2d> path;
  double travel = 0.0;    ///< m, of this step
  bool measured = false;  ///< false: the move failed, or the table is explored or cannot be seen
  std::string note;  ///< `look_around`, `first_view`, `view`, `explored`, `unreachable`, `move_failed`, ...
  double entropy = 0.0;                               ///< bits, of the space over the table before the step
  std::size_t unknown_in_boxes = 0;                   ///< cells before the step
  const TraversabilityMap* traversability = nullptr;  ///< valid during the call
};

enum class TableOutcome : std::uint8_t { explored, unreachable, out_of_views };
[[nodiscard]] std::string toString(TableOutcome outcome);

/// What one exploration came to.
struct ExplorationResult {
  std::map<NodeId, TableOutcome> tables;
  std::uint64_t measurements = 0;
  double travel = 0.0;   ///< m
  double seconds = 0.0;  ///< measuring and travelling
};

/// Algorithm 1: acquires the model of all tables that it finds, by choosing its own viewpoints.
class Explorer {
 public:
  using OnMeasurement = std::function<void(const Measurement&, const UpdateReport&)>;
  using OnStep = std::function<void(const ExplorationStep&)>;

  /// All of them have to live as long as this. @throws ConfigError if the configuration makes no sense.
  Explorer(const ExplorationConfig& config, Robot& robot, MeasurementSource& sensor, HierarchyMapper& mapper);

  void onMeasurement(OnMeasurement call) { on_measurement_ = std::move(call); }
  void onStep(OnStep call) { on_step_ = std::move(call); }

  /// Explores until no table is left that is neither explored nor known to be out of reach.
  ExplorationResult run();

 private:
  struct TableState;

  void lookAround();
  [[nodiscard]] std::optional<TableArea> findNearestUnexploredTable() const;
  void exploreStep(const TableArea& table);
  bool goAndMeasure(const Viewpoint& v, const TravelCost& travel, ExplorationStep& step);
  void measure(ExplorationStep& step);
  [[nodiscard]] ClearedSpace& clearedOf(const TableArea& table);

  ExplorationConfig config_;
  Robot& robot_;
  MeasurementSource& sensor_;
  HierarchyMapper& mapper_;
  ViewpointSampler sampler_;
  ExpectedInformationGain gain_;
  OnMeasurement on_measurement_;
  OnStep on_step_;
  std::map<NodeId, TableState> tables_;
  std::vector<Measurement> measurements_;
  std::vector<Eigen::Vector2d> failed_;  ///< places that could not be reached
  std::uint64_t steps_ = 0;
  ExplorationResult result_;
};

}  // namespace hoctomap
