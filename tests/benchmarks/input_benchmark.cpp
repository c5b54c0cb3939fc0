// SPDX-License-Identifier: BSD-3-Clause
// Reading a log, and from range images to points.
#include <benchmark/benchmark.h>

#include "Input.h"
#include "measuring/Scans.h"

namespace hoctomap {

void registerInputStages(const BenchmarkInput& input) {
  // With the start of the reading process: what a run of `build` has.
  benchmark::RegisterBenchmark(
      "read/whole_log",
      [&input](benchmark::State& state) {
        ScanChoice choice;
        choice.log = input.log();
        for (auto _ : state) benchmark::DoNotOptimize(readScans(choice));
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(input.scans().size()));
      })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();

  if (!input.lastScan().image) return;
  benchmark::RegisterBenchmark("unproject", [&input](benchmark::State& state) {
    const Measurement& z = input.lastScan();
    for (auto _ : state) {
      state.PauseTiming();
      DepthImage image = *z.image;  // it is handed over
      state.ResumeTiming();
      benchmark::DoNotOptimize(unproject(std::move(image), z.world_T_sensor, {}));
    }
  })->Unit(benchmark::kMillisecond);
}

}  // namespace hoctomap
