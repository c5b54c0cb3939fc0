// SPDX-License-Identifier: BSD-3-Clause
// Segmentation, association, existence: the stages of HierarchyMapper::integrate before and after the update.
#include <benchmark/benchmark.h>

#include "Input.h"
#include "MappingSetup.h"

namespace hoctomap {

namespace {

void segmentation(benchmark::State& state, const BenchmarkInput& input) {
  const auto stage = makeSegmentation(input.settings());
  for (auto _ : state) benchmark::DoNotOptimize(stage->segment(input.lastScan()));
  state.counters["points"] = static_cast<double>(input.lastScan().world_points.size());
}

void association(benchmark::State& state, const BenchmarkInput& input) {
  const MappingStrategies strategies = makeStrategies(input.settings());
  const std::vector<PartOfScan> parts = input.partsOfLastScan();
  for (auto _ : state) {
    for (const PartOfScan& part : parts) {
      benchmark::DoNotOptimize(strategies.association->associate(
          input.map(), {part.label, &part.world_points, part.box}, [](NodeId) { return true; }));
    }
  }
  state.counters["segments"] = static_cast<double>(parts.size());
}

void existence(benchmark::State& state, const BenchmarkInput& input) {
  const MappingStrategies strategies = makeStrategies(input.settings());
  std::vector<NodeInQuestion> nodes;
  for (const NodeId id : input.map().ids()) {
    if (id == kRootId) continue;
    nodes.push_back({id, input.settings().labels.at(input.map().node(id).label()).existence});
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(strategies.existence->evidence(input.map(), input.lastScan(), nodes));
  }
  state.counters["nodes"] = static_cast<double>(nodes.size());
}

}  // namespace

void registerMappingStages(const BenchmarkInput& input) {
  const auto add = [&input](const char* name, void (*stage)(benchmark::State&, const BenchmarkInput&)) {
    benchmark::RegisterBenchmark(name, [&input, stage](benchmark::State& state) {
      stage(state, input);
    })->Unit(benchmark::kMillisecond);
  };
  add("segmentation", segmentation);
  add("association", association);
  add("existence", existence);
}

}  // namespace hoctomap
