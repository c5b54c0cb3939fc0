// SPDX-License-Identifier: BSD-3-Clause
// What a step of exploration costs: a table of 1 x 0.6 m with eight boxes on it, objects at 5 mm.
#include <benchmark/benchmark.h>

#include "../exploration/TableScene.h"
#include "hoctomap/exploration/ExpectedInformationGain.h"
#include "hoctomap/exploration/ViewpointSampler.h"

namespace hoctomap {
namespace {

struct Step {
  MapHierarchy map = testing::roomWithTable();
  TableArea table;
  std::optional<ClearedSpace> cleared;
  std::vector<Viewpoint> candidates;

  Step() {
    for (int i = 0; i < 8; ++i) {
      const double x = -0.4 + 0.2 * (i % 4);
      const double y = i < 4 ? -0.2 : 0.1;
      const std::vector sides{testing::box(x, y, 0.7, x + 0.005, y + 0.1, 0.9),
                              testing::box(x, y, 0.7, x + 0.1, y + 0.005, 0.9)};
      map.add(labels::object, testing::mapOf(0.005, {.free = {}, .occupied = sides}), Pose(),
              testing::kTable);
    }
    table = *tableArea(map, testing::kTable, {});
    cleared.emplace(table.space, 0.01);
    const TraversabilityMap traversability(map, {}, 0.3, 1.3, {1.5, 1.5});
    const TravelCost travel(traversability, {1.5, 1.5}, 0.5, 3.0);
    ViewpointConfig config;
    config.candidates = 100;
    candidates = ViewpointSampler(config, RobotModel{}).sample(table, travel, 1);
  }
};

void hundredCandidates(benchmark::State& state) {
  const Step step;
  const KnowledgeGrid grid(step.map, step.table, *step.cleared, 0.005, 4.0);
  const ExpectedInformationGain gain({}, RobotModel{});
  for (auto _ : state) {
    for (const Viewpoint& v : step.candidates) benchmark::DoNotOptimize(gain(grid, v, Wanted::boxes));
  }
  state.counters["candidates"] = static_cast<double>(step.candidates.size());
}
BENCHMARK(hundredCandidates)->Unit(benchmark::kMillisecond);

void knowledgeGrid(benchmark::State& state) {
  const Step step;
  for (auto _ : state) {
    benchmark::DoNotOptimize(KnowledgeGrid(step.map, step.table, *step.cleared, 0.005, 4.0).entropy());
  }
}
BENCHMARK(knowledgeGrid)->Unit(benchmark::kMillisecond);

void traversabilityAndTravel(benchmark::State& state) {
  const Step step;
  for (auto _ : state) {
    const TraversabilityMap traversability(step.map, {}, 0.3, 1.3, {1.5, 1.5});
    const TravelCost travel(traversability, {1.5, 1.5}, 0.5, 3.0);
    benchmark::DoNotOptimize(travel.length({-1.5, -1.5}));
  }
}
BENCHMARK(traversabilityAndTravel)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hoctomap
