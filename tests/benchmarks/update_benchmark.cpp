// SPDX-License-Identifier: BSD-3-Clause
// The update engine: a scan into a fresh unbounded map, and the objects of the log into their boxes.
#include <benchmark/benchmark.h>

#include <string>

#include "Input.h"
#include "MappingSetup.h"
#include "measuring/BeamRecorder.h"

namespace hoctomap {

namespace {

void unbounded(benchmark::State& state, const BenchmarkInput& input, double resolution) {
  const MappingStrategies strategies = makeStrategies(input.settings());
  const Measurement& z = input.lastScan();
  Beams beams;
  beams.origin = z.origin().cast<float>();
  beams.hits = z.world_points;
  for (auto _ : state) {
    octomap::OcTree tree(resolution);
    strategies.update->apply(tree, beams);
    state.PauseTiming();
    tree.clear();
    state.ResumeTiming();
  }
}

void boxes(benchmark::State& state, const BenchmarkInput& input, double resolution) {
  Settings settings = input.settings();
  settings.labels.at(labels::object).resolution = resolution;
  BeamRecord record;
  MappingStrategies strategies = makeStrategies(settings);
  strategies.update = makeBeamRecorder(std::move(strategies.update), resolution, record);
  HierarchyMapper mapper(settings.mappingConfig(), settings.labels, std::move(strategies));
  for (const Measurement& z : input.scans()) static_cast<void>(mapper.integrate(z));

  const MappingStrategies fresh = makeStrategies(settings);
  for (auto _ : state) {
    state.PauseTiming();
    std::vector<octomap::OcTree> trees(record.trees, octomap::OcTree(resolution));
    state.ResumeTiming();
    for (const RecordedUpdate& update : record.updates) {
      fresh.update->apply(trees[update.tree], update.view());
    }
    state.PauseTiming();
    trees.clear();
    state.ResumeTiming();
  }
  state.counters["updates"] = static_cast<double>(record.updates.size());
}

}  // namespace

void registerUpdate(const BenchmarkInput& input) {
  const auto name = [](const char* what, int mm) { return what + std::to_string(mm) + "mm"; };
  for (const int mm : {10, 5}) {
    benchmark::RegisterBenchmark(name("update/unbounded/", mm).c_str(), [&input, mm](auto& state) {
      unbounded(state, input, 1e-3 * mm);
    })->Unit(benchmark::kMillisecond);
  }
  for (const int mm : {2, 1}) {
    benchmark::RegisterBenchmark(name("update/objects_of_log/", mm).c_str(), [&input, mm](auto& state) {
      boxes(state, input, 1e-3 * mm);
    })->Unit(benchmark::kMillisecond);
  }
}

}  // namespace hoctomap
