// SPDX-License-Identifier: BSD-3-Clause
#include "vi_b/Sequence.h"

#include <algorithm>

#include "measuring/Figures.h"
#include "measuring/OwnProcess.h"
#include "measuring/Scans.h"
#include "vi_b/Pictures.h"

namespace hoctomap {

namespace {

void build(const ViBOptions& options, const std::filesystem::path& log,
           const std::filesystem::path& directory, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"build",      "-q", "--overwrite",     "-c", options.config, "-i",
                                     log.string(), "-o", directory.string()};
  for (const std::string& assignment : options.assignments) {
    arguments.insert(arguments.end(), {"--set", assignment});
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  static_cast<void>(runApart(findHoctomap(), arguments));
}

BuiltMap figuresOf(const Manifest& manifest) {
  BuiltMap built;
  for (const NodeRecord& node : manifest.nodes) {
    built.occupied += node.voxels.occupied;
    built.bytes += node.memory_bytes;
  }
  return built;
}

std::size_t countObjects(const Manifest& manifest) {
  return static_cast<std::size_t>(std::ranges::count(manifest.nodes, labels::object, &NodeRecord::label));
}

/// Ghosts and pictures.
void compare(const ViBOptions& options, const StoredMap& hierarchy, const MapHierarchy& monolithic,
             const RemovedNode& gone, const std::filesystem::path& log, SequenceResult& result) {
  ScanChoice since;
  since.log = log;
  since.start = gone.removed_scan;
  const std::vector<Measurement> scans = readScans(since);
  const VacatedPlace place(gone, hierarchy.hierarchy, scans);
  const PointCloud in_monolithic = place.ghostsOf(monolithic);
  const PointCloud in_hierarchy = place.ghostsOf(hierarchy.hierarchy);
  result.ghosts_monolithic = in_monolithic.size();
  result.hidden_monolithic = place.countHidden(in_monolithic);
  result.ghosts_hierarchy = in_hierarchy.size();

  const Settings settings = loadSettings(options.config, options.assignments);
  const PictureFrame frame = frameAround(gone, hierarchy.hierarchy, scans.back().origin());
  const std::filesystem::path folder = options.output / result.name;
  renderCut(monolithic, in_monolithic, frame, settings, folder / "monolithic");
  renderCut(hierarchy.hierarchy, in_hierarchy, frame, settings, folder / "hierarchy");
}

}  // namespace

SequenceResult runSequence(const ViBOptions& options, const std::string& name,
                           const std::filesystem::path& log,
                           const std::function<void(const std::string&)>& say) {
  const std::filesystem::path folder = options.output / name;
  std::filesystem::create_directories(folder);
  const std::string resolution = numberText(options.resolution);
  SequenceResult result;
  result.name = name;

  say(name + ": the hierarchy");
  const auto directory = folder / "hierarchy";
  build(options, log, directory, {"--set", "label.object.resolution=" + resolution});
  const StoredMap hierarchy = readMap(directory, {.at_scan = {}, .removed = true});
  result.hierarchy = figuresOf(hierarchy.manifest);
  result.scans = hierarchy.manifest.scans;
  result.removed_objects = countRemovedObjects(directory, hierarchy.manifest);
  result.objects_left = countObjects(hierarchy.manifest);

  say(name + ": the monolithic map");
  // One commit at the end: each writes the whole map.
  build(options, log, folder / "monolithic",
        {"--monolithic", "--set", "label.background.resolution=" + resolution, "--set",
         "mapping.checkpoint_scans=1000000"});
  const StoredMap monolithic = readMap(folder / "monolithic");
  result.monolithic = figuresOf(monolithic.manifest);

  const RemovedNode* gone = largestRemovedObject(directory, hierarchy);
  if (gone == nullptr) return result;
  result.node = gone->node.id();
  result.history = historyOf(directory, hierarchy.manifest, result.node);
  result.removed_scan = gone->removed_scan;
  result.node_voxels = gone->node.map().occupiedVoxels().size();
  say(name + ": ghosts and pictures");
  compare(options, hierarchy, monolithic.hierarchy, *gone, log, result);
  return result;
}

}  // namespace hoctomap
