// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hoctomap/exploration/ExpectedInformationGain.h"
#include "hoctomap/exploration/ExplorationStep.h"
#include "hoctomap/exploration/ViewpointSampler.h"
#include "hoctomap/mapping/HierarchyMapper.h"

namespace hoctomap {

enum class UtilityForm : std::uint8_t {
  ratio,    ///< gain^(alpha / (1 - alpha)) / cost: orders as Eq. 13 of the logarithms of gain and cost
  additive  ///< Eq. 13: alpha * gain - (1 - alpha) * cost
};

struct ExplorationConfig {
  TraversabilityConfig traversability;
  ViewpointConfig viewpoints;
  GainConfig gain;
  TableSpace space;
  UtilityForm utility = UtilityForm::ratio;
  double alpha = 0.5;  ///< weight of the gain, Eq. 13
  double tau = 0.045;  ///< a gain of no more than this share of a table's first one is no trip worth
  int first_look = 7;  ///< views around at the start, for the background
  int max_views = 20;  ///< of one table
  double cleared_resolution = 0.01;  ///< m
  RangeNoise noise;                  ///< of the sensor: what is measured worse than that is not known
  double cell = 0.005;               ///< m, of the grid that gains are computed in
  std::uint64_t seed = 1;
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
  ~Explorer();
  Explorer(const Explorer&) = delete;
  Explorer& operator=(const Explorer&) = delete;
  Explorer(Explorer&&) = delete;
  Explorer& operator=(Explorer&&) = delete;

  void onMeasurement(OnMeasurement call) { on_measurement_ = std::move(call); }
  void onStep(OnStep call) { on_step_ = std::move(call); }

  /// Explores until no table is left that is neither explored nor known to be out of reach. What the mapper
  /// still holds back for confirmation afterwards is for the caller to let in (`HierarchyMapper::finish`).
  /// @throws InputError if the sensor gives no measurement
  ExplorationResult run();

 private:
  struct Promise;
  struct TableState;
  struct Scan;

  void lookAround();
  [[nodiscard]] std::optional<TableArea> findNearestUnexploredTable();
  void exploreStep(const TableArea& area);
  [[nodiscard]] static Wanted wantedOf(const TableState& state);
  void evaluate(ExplorationStep& step, const std::vector<Viewpoint>& candidates,
                const KnowledgeGrid& knowledge, const TravelCost& travel, Wanted wanted) const;
  [[nodiscard]] double utilityOf(double gain, double cost) const;
  static void noteBrokenPromise(TableState& state, std::size_t unknown);
  static void passOver(const std::vector<Eigen::Vector2d>& barren, ExplorationStep& step);
  void goAndMeasure(TableState& state, const TravelCost& travel, ExplorationStep& step);
  void measure(ExplorationStep& step);
  void end(TableState& state, TableOutcome outcome, ExplorationStep& step);
  void report(ExplorationStep& step);
  [[nodiscard]] const ClearedSpace& clearedOf(TableState& state);
  [[nodiscard]] std::vector<Viewpoint> candidatesOf(const TableArea& area, const TravelCost& travel,
                                                    std::uint64_t draw) const;

  ExplorationConfig config_;
  Robot& robot_;
  MeasurementSource& sensor_;
  HierarchyMapper& mapper_;
  ViewpointSampler sampler_;
  ExpectedInformationGain gain_;
  OnMeasurement on_measurement_;
  OnStep on_step_;
  std::map<NodeId, TableState> tables_;
  std::vector<Scan> scans_;  ///< for the space over tables that are found later
  /// Where the robot could not get to, and how far around it may not either.
  struct FailedPlace {
    Eigen::Vector2d place;
    double radius;  ///< m
  };
  std::vector<FailedPlace> failed_;
  std::uint64_t steps_ = 0;
  ExplorationResult result_;
};

}  // namespace hoctomap
