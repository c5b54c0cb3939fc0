// SPDX-License-Identifier: BSD-3-Clause
#include "building/BuildingRun.h"

#include <iostream>
#include <variant>

#include "MappingSetup.h"
#include "hoctomap/io/MapDirectory.h"
#include "hoctomap/io/PipeLogWriter.h"
#include "hoctomap/io/PipeSource.h"
#include "measuring/ProcessMemory.h"

namespace hoctomap {

void writeBuildingLog(const Simulation& building, const std::filesystem::path& log) {
  PipeLogWriter writer(log);
  simulateScene(building, 0, [&](const SimulatedScan& scan) {
    writer.write(TruthPose{scan.stamp, "groundtruth", scan.view.world_T_base});
    writer.write(DepthScan{scan.scan, scan.stamp, scan.sensor, scan.world_T_sensor, scan.image});
  });
  writer.finish();
}

BuildingRun mapBuilding(const std::filesystem::path& log, const Settings& settings,
                        const std::filesystem::path& directory,
                        const std::function<void(std::uint64_t)>& progress) {
  LogReadOptions options;
  options.logs = {log};
  PipeSource source(options, RangeLimits{settings.sensor.min_range},
                    [](const std::string& text) { std::cerr << "warning: " << text << "\n"; });
  MapDirectoryOptions writing_options;
  writing_options.mode = MapOpenMode::overwrite;
  writing_options.config = toIni(settings);
  writing_options.generator = "hoctomap-experiments building";
  MapDirectory out(directory, writing_options);
  HierarchyMapper mapper(settings.mappingConfig(), settings.labels, makeStrategies(settings));
  BuildingRun run;
  const MemoryPeak memory;
  std::uint64_t scans = 0;
  double stamp = 0.0;
  const auto commit = [&] {
    MapState state{mapper.hierarchy(), mapper.removed()};
    state.scans = state.mapped_scans = scans;
    state.last_stamp = stamp;
    state.seams = &mapper.seams();
    state.sensor = mapper.sensor();
    out.commit(state);
  };
  while (auto item = source.next()) {
    const auto* z = std::get_if<Measurement>(&*item);
    if (z == nullptr) continue;
    const Stopwatch all;
    const UpdateReport report = mapper.integrate(*z);
    scans = z->scan + 1;
    stamp = z->stamp;
    out.append(report);
    out.append(scanRow(*z));
    const Stopwatch writing;
    if (scans % static_cast<std::uint64_t>(settings.checkpoint_scans) == 0) commit();
    run.commits.push_back(writing.elapsed());
    run.scans.push_back(all.elapsed());
    run.nodes.push_back(mapper.hierarchy().size());
    progress(scans);
  }
  out.appendEnd(mapper.finish(scans - 1, stamp));
  commit();
  run.memory_bytes = memory.growth();
  return run;
}

}  // namespace hoctomap
