// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/config/Settings.h"
#include "hoctomap/exploration/Explorer.h"
#include "hoctomap/simulation/Simulation.h"
#include "hoctomap/simulation/SurfaceCoverage.h"

namespace hoctomap {

enum class ViewMethod : std::uint8_t { recommended, paper, random, circle_4, circle_8 };
inline constexpr int kViewMethods = 5;
[[nodiscard]] std::string toString(ViewMethod method);

/// How the map was after a view; the first entry is after the look around.
struct TrialView {
  std::optional<std::size_t> table;    ///< of `Trial::tables`, that was looked at
  double travel = 0.0;                 ///< m, so far
  double seconds = 0.0;                ///< of travel and measuring, so far
  double coverage = 0.0;               ///< of all objects
  std::vector<double> table_coverage;  ///< of the objects of each table
};

/// A candidate viewpoint of a step that was measured: what was expected, and what would have been found.
struct GainCheck {
  double gain = 0.0;
  double cells = 0.0;  ///< in boxes that a view from there would show: free, or the surface itself
};

/// A turn of the loop of Algorithm 1 in figures, of the methods that have one.
struct TrialStep {
  StepKind kind = StepKind::view;
  double best_gain = 0.0;    ///< of the candidates
  double chosen_gain = 0.0;  ///< of the one that was gone to
  double cost = 0.0;         ///< s, of that one
  double entropy = 0.0;      ///< bits, of the space over the table before the step
  std::size_t unknown_in_boxes = 0;
};

/// One exploration of one scene.
struct Trial {
  std::string scene;
  ViewMethod method = ViewMethod::recommended;
  std::uint64_t seed = 0;
  std::vector<std::string> tables;
  std::vector<TrialView> views;
  std::vector<TrialStep> steps;
  std::vector<std::vector<GainCheck>> checks;            ///< of the views of boxes
  std::vector<std::pair<double, double>> entropy_drops;  ///< gain of the view taken, bits that it took away
  bool ended_by_itself = false;                          ///< every table is explored

  /// After the k-th view of a table, or its last one before.
  [[nodiscard]] double tableCoverage(std::size_t table, int view) const;
  /// Views of a table until its coverage is `share`; nothing if it never is.
  [[nodiscard]] std::optional<int> viewsUntil(std::size_t table, double share) const;
  /// The first view after which the coverage of all objects is `share`.
  [[nodiscard]] const TrialView* firstWith(double share) const;
  /// Whether the last view of a table found less than 0.2 % of its surface.
  [[nodiscard]] bool lastTripWasUseless() const;
};

struct TrialOptions {
  int views = 8;             ///< of each table, for methods that do not end by themselves
  bool check_gains = false;  ///< fill `Trial::checks`
};

/// A scene with its objects as a seed has put them, and what can be seen of them: the same for all methods.
struct TrialScene {
  TrialScene(std::string scene_name, const Simulation& from, std::uint64_t with_seed);

  std::string name;
  std::uint64_t seed;
  Simulation simulation;
  SurfaceCoverage coverage;
};

/// Runs one. @param settings of the recommended method; the paper's changes gain, unknown space and utility.
[[nodiscard]] Trial runTrial(const TrialScene& scene, const Settings& settings, ViewMethod method,
                             const TrialOptions& options);

}  // namespace hoctomap
