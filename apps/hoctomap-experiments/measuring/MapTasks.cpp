// SPDX-License-Identifier: BSD-3-Clause
// Measurements of the update engine alone.
#include <tbb/global_control.h>

#include <memory>
#include <utility>

#include "MappingSetup.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/OctreeFile.h"
#include "hoctomap/io/Sha256.h"
#include "measuring/BeamRecorder.h"
#include "measuring/StockMap.h"
#include "measuring/Tasks.h"

namespace hoctomap {

namespace {

void addMemory(Figures& figures, const MemoryPeak& memory) {
  figures.add("rss_before_bytes", memory.before());
  figures.add("peak_bytes", memory.growth());
}

/// The engine that mapping uses.
std::unique_ptr<ScanUpdate> ourEngine(const Settings& settings) {
  return std::move(makeStrategies(settings).update);
}

octomap::OcTree makeTree(double resolution, const LabelProfile& profile) {
  octomap::OcTree tree(resolution);
  profile.occupancy.applyTo(tree);
  return tree;
}

/// As many threads as the task says, while this lives.
tbb::global_control threadsOf(const Task& task) {
  return {tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(task.threads)};
}

std::unique_ptr<ScanUpdate> boxEngine(const Task& task, const Settings& settings) {
  if (task.variant == "stock") return makeStockBoxUpdate();
  if (task.variant == "filtering") return makeReferenceScanUpdate();
  if (task.variant == "ours") return ourEngine(settings);
  throw ConfigError("boxes: variant stock, filtering or ours, not '" + task.variant + "'");
}

BeamRecord recordObjects(const Task& task, const Settings& settings, const std::vector<Measurement>& scans) {
  // One thread: the order of the nodes is the same in every process.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 1);
  BeamRecord record;
  MappingStrategies strategies = makeStrategies(settings);
  strategies.update = makeBeamRecorder(std::move(strategies.update), task.resolution, record);
  HierarchyMapper mapper(settings.mappingConfig(), settings.labels, std::move(strategies));
  for (const Measurement& z : scans) static_cast<void>(mapper.integrate(z));
  if (record.updates.empty()) throw InputError(task.scans.log.string() + ": no objects in the scans");
  for (const RecordedUpdate& update : record.updates) {
    if (!update.passing.empty()) throw ConfigError("boxes: stock needs [label.object] carve = own");
  }
  return record;
}

}  // namespace

Figures measureWhole(const Task& task) {
  if (task.variant != "stock" && task.variant != "ours") {
    throw ConfigError("whole: variant stock or ours, not '" + task.variant + "'");
  }
  const tbb::global_control threads = threadsOf(task);
  const Settings settings = loadSettings(task.config, task.overrides);
  const double max_range = settings.mappingConfig().max_range;
  const auto engine = ourEngine(settings);
  const std::vector<Measurement> scans = readScans(task.scans);
  // Each has its points in the form it takes them in; the conversion is not measured.
  std::vector<StockScan> stock_scans;
  if (task.variant == "stock") {
    for (const Measurement& z : scans) stock_scans.push_back(toStock(z));
  }

  octomap::OcTree tree = makeTree(task.resolution, settings.labels.at(labels::background));
  const MemoryPeak memory;
  const Stopwatch watch;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (task.variant == "stock") {
      insertStock(tree, stock_scans[i], max_range);
    } else {
      Beams beams;
      beams.origin = scans[i].origin().cast<float>();
      beams.hits = scans[i].world_points;
      beams.max_range = max_range;
      engine->apply(tree, beams);
    }
  }
  const Elapsed elapsed = watch.elapsed();

  Figures figures;
  figures.add("scans", scans.size());
  figures.add("points", pointsOf(scans));
  figures.add(elapsed);
  addMemory(figures, memory);
  figures.add("map_bytes", tree.memoryUsage());
  figures.add("leaves", tree.getNumLeafNodes());
  figures.add("ot_sha256", sha256Hex(otBytes(tree)));
  return figures;
}

Figures measureCells(const Task& task) {
  const Settings settings = loadSettings(task.config, task.overrides);
  const octomap::OcTree tree(task.resolution);
  ScanCells all;
  for (const Measurement& z : readScans(task.scans)) {
    const ScanCells cells = countCells(tree, toStock(z), settings.mappingConfig().max_range);
    all.visits += cells.visits;
    all.updates += cells.updates;
  }
  Figures figures;
  figures.add("visits", all.visits);
  figures.add("updates", all.updates);
  return figures;
}

Figures measureBoxes(const Task& task) {
  const tbb::global_control threads = threadsOf(task);
  Task adapted = task;
  adapted.overrides.push_back("label.object.resolution=" + numberText(task.resolution));
  adapted.overrides.emplace_back("label.object.grazing=clear");  // all that stock OctoMap knows
  // A node that is split or merged gets its tree in another way than by updates, and is not told from others.
  adapted.overrides.emplace_back("mapping.seam_votes=false");
  const Settings settings = loadSettings(adapted.config, adapted.overrides);
  const auto engine = boxEngine(task, settings);
  const BeamRecord record = recordObjects(task, settings, readScans(task.scans));

  std::vector<octomap::OcTree> trees;
  trees.reserve(record.trees);
  while (trees.size() < record.trees) {
    trees.push_back(makeTree(task.resolution, settings.labels.at(labels::object)));
  }
  const MemoryPeak memory;
  const Stopwatch watch;
  for (const RecordedUpdate& update : record.updates) engine->apply(trees[update.tree], update.view());
  const Elapsed elapsed = watch.elapsed();

  Figures figures;
  std::size_t points = 0;
  for (const RecordedUpdate& update : record.updates) points += update.hits.size();
  figures.add("updates", record.updates.size());
  figures.add("points", points);
  figures.add(elapsed);
  addMemory(figures, memory);
  std::size_t bytes = 0;
  std::string all;
  for (const octomap::OcTree& tree : trees) {
    bytes += tree.memoryUsage();
    all += sha256Hex(otBytes(tree));
  }
  figures.add("map_bytes", bytes);
  figures.add("nodes", trees.size());
  figures.add("ot_sha256", sha256Hex(all));
  return figures;
}

}  // namespace hoctomap
