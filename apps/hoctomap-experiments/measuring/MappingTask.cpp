// SPDX-License-Identifier: BSD-3-Clause
// Measurement of the whole map update.
#include <tbb/global_control.h>

#include "MappingSetup.h"
#include "hoctomap/io/OctreeFile.h"
#include "hoctomap/io/Sha256.h"
#include "measuring/FarNodes.h"
#include "measuring/Tasks.h"

namespace hoctomap {

namespace {

struct Stages {
  double segment = 0.0;
  double associate = 0.0;
  double update = 0.0;
  double existence = 0.0;

  void add(const StageSeconds& wall, double scale) {
    segment += scale * wall.segment;
    associate += scale * wall.associate;
    update += scale * wall.update;
    existence += scale * wall.existence;
  }
};

void addStages(Figures& figures, const std::string& unit, const Stages& stages) {
  figures.add("segment_" + unit, stages.segment);
  figures.add("associate_" + unit, stages.associate);
  figures.add("update_" + unit, stages.update);
  figures.add("existence_" + unit, stages.existence);
}

void addMap(Figures& figures, const MapHierarchy& map) {
  std::size_t bytes = 0;
  std::size_t objects = 0;
  for (const NodeId id : map.ids()) {
    const MapNode& node = map.node(id);
    bytes += node.map().tree().memoryUsage();
    if (node.label() == labels::object) ++objects;
  }
  figures.add("map_bytes", bytes);
  figures.add("nodes", map.size());
  figures.add("objects", objects);
}

}  // namespace

Figures measureMapping(const Task& task) {
  const Settings settings = loadSettings(task.config, task.overrides);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(task.threads));
  ScanChoice choice = task.scans;
  choice.min_range = settings.sensor.min_range;
  const std::vector<Measurement> scans = readScans(choice);
  HierarchyMapper mapper(settings.mappingConfig(), settings.labels, makeStrategies(settings),
                         makeFarNodes(settings, task.far_nodes));

  std::size_t next = 0;
  for (; next < task.warm_up && next < scans.size(); ++next) {
    static_cast<void>(mapper.integrate(scans[next]));
  }
  const MemoryPeak memory;
  Elapsed total;
  Stages wall;
  Stages cpu;
  std::size_t points = 0;
  const std::size_t measured = scans.size() - next;
  for (; next < scans.size(); ++next) {
    const Stopwatch watch;
    const UpdateReport report = mapper.integrate(scans[next]);
    const Elapsed elapsed = watch.elapsed();
    total += elapsed;
    wall.add(report.seconds, 1.0);
    cpu.add(report.seconds, elapsed.cpu_s / elapsed.wall_s);
    points += report.points;
  }

  Figures figures;
  figures.add("scans", measured);
  figures.add("points", points);
  figures.add(total);
  addStages(figures, "cpu_s", cpu);
  addStages(figures, "wall_s", wall);
  figures.add("rss_before_bytes", memory.before());
  figures.add("peak_bytes", memory.growth());
  addMap(figures, mapper.hierarchy());
  if (settings.monolithic) {
    figures.add("ot_sha256", sha256Hex(otBytes(mapper.hierarchy().root().map().tree())));
  }
  return figures;
}

}  // namespace hoctomap
