// SPDX-License-Identifier: BSD-3-Clause
// A whole map to disk, all nodes new.
#include <benchmark/benchmark.h>

#include "Input.h"
#include "hoctomap/io/MapDirectory.h"

namespace hoctomap {

void registerCommit(const BenchmarkInput& input) {
  benchmark::RegisterBenchmark(
      "commit/all_nodes",
      [&input](benchmark::State& state) {
        const auto folder = input.log().parent_path() / "benchmark_map";
        for (auto _ : state) {
          state.PauseTiming();
          std::filesystem::remove_all(folder);
          MapDirectory directory(folder, {MapOpenMode::create, toIni(input.settings()), "benchmark", {}});
          state.ResumeTiming();
          directory.commit({input.map(), {}, input.scans().size() - 1});
        }
        std::filesystem::remove_all(folder);
        state.counters["nodes"] = static_cast<double>(input.map().size());
      })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace hoctomap
