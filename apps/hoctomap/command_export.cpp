// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>
#include <optional>

#include "AtScan.h"
#include "Command.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/AtomicFile.h"
#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/CloudExport.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/GlbExport.h"
#include "hoctomap/io/MapExport.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/io/MergedTree.h"
#include "hoctomap/io/OctreeFile.h"
#include "hoctomap/io/OpenMap.h"

namespace hoctomap {

namespace {

enum class Format { bt, ot, ply, pcd, glb, scene, mapcollection, csv };

struct ExportOptions {
  std::string map;
  std::string output;
  Format format = Format::ot;
  std::optional<std::uint32_t> node;
  bool merged = false;
  double resolution = 0.01;  ///< m, of a merged tree
  AtScan at_scan;
};

using Damages = std::vector<Damage>;

bool isOctree(Format format) {
  return format == Format::bt || format == Format::ot;
}

/// Reads no more of the map than this node.
int exportOneNode(const ExportOptions& options) {
  const auto [scans, node] = findNode(options.map, NodeId{*options.node}, options.at_scan);
  noteOlderState(options.map, scans, options.at_scan);
  if (!node) throw MapError(options.map + ": there is no node " + std::to_string(*options.node));
  const OctreeFormat format = options.format == Format::bt ? OctreeFormat::bt : OctreeFormat::ot;
  replaceFile(options.output, octreeBytes(options.map, *node, format));
  std::cout << "exported 1 node to " << options.output << std::endl;
  return 0;
}

/// The scene is written by the helper, which knows MRPT.
void exportScene(const ExportOptions& options) {
  std::vector<std::string> arguments{"scene", options.map, options.output, "--intact"};
  if (options.at_scan) {
    arguments.emplace_back("--at-scan");
    arguments.push_back(std::to_string(*options.at_scan));
  }
  if (runHelper(arguments) != 0) throw FileError(options.output + ": the scene could not be written");
}

std::string contentOf(const MapHierarchy& hierarchy, const ExportOptions& options) {
  switch (options.format) {
    case Format::ply:
      return plyOf(hierarchy);
    case Format::pcd:
      return pcdOf(hierarchy);
    case Format::glb:
      return glbOf(hierarchy);
    default:
      break;
  }
  const auto tree = mergedTree(hierarchy, options.resolution);
  return options.format == Format::bt ? btBytes(*tree) : otBytes(*tree);
}

/// Formats made of the whole hierarchy.
Damages exportHierarchy(const ExportOptions& options) {
  Damages damage;
  const StoredMap map = readMap(options.map, {.at_scan = options.at_scan, .damage = &damage});
  if (options.format == Format::scene) {
    exportScene(options);
  } else {
    replaceFile(options.output, contentOf(map.hierarchy, options));
  }
  return damage;
}

Damages exportInto(const ExportOptions& options, const Manifest& manifest) {
  if (options.format == Format::csv) {
    replaceFile(options.output, objectTable(manifest));
    return {};
  }
  if (options.format == Format::mapcollection)
    return exportMapCollection(options.map, manifest, options.output);
  if (isOctree(options.format) && !options.merged) {
    const OctreeFormat format = options.format == Format::bt ? OctreeFormat::bt : OctreeFormat::ot;
    return exportOctrees(options.map, manifest, options.output, format);
  }
  return exportHierarchy(options);
}

int exportMap(const ExportOptions& options) {
  if ((options.node || options.merged) && !isOctree(options.format))
    throw ConfigError("--node and --merged are for --format bt and ot");
  if (options.node) return exportOneNode(options);
  const Manifest manifest = readManifestAt(options.map, options.at_scan);
  const Damages damage = exportInto(options, manifest);
  for (const Damage& d : damage)
    std::cout << "damaged  " << escapedText(d.path) << "  " << escapedText(d.what) << "\n";
  const std::size_t nodes = manifest.nodes.size() - damage.size();
  std::cout << "exported " << nodes << (nodes == 1 ? " node to " : " nodes to ") << options.output
            << std::endl;
  if (damage.empty()) return 0;
  throw MapError(options.map + ": " + std::to_string(damage.size()) +
                 " of its nodes are damaged and left out");
}

}  // namespace

void addExportCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = addCommand(
      app, "export", "Write a map for other tools",
      {"hoctomap export map --format bt -o octrees                     # a file a node, and nodes.csv",
       "hoctomap export map --format bt --node 3 -o mug.bt",
       "hoctomap export map --format ot --merged --resolution 0.01 -o all.ot",
       "hoctomap export map --format ply -o voxels.ply                 # pcd, glb, 3dscene, csv alike",
       "hoctomap export map --format mapcollection -o collection       # octrees and an index for OctoMap",
       "hoctomap export damaged_map --format ot -o rest                # what is intact; exit code 4"});
  command->add_option("map", options->map, "map directory")->type_name("DIR")->required();
  command
      ->add_option(
          "--format", options->format,
          "ot: octrees with full probabilities (default), bt: maximum likelihood; ply, pcd: points with "
          "label, node and probability; glb: surfaces; 3dscene: for SceneViewer3D; mapcollection: bt with "
          "OctoMap's index; csv: a row a node")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, Format>{{"bt", Format::bt},
                                                                {"ot", Format::ot},
                                                                {"ply", Format::ply},
                                                                {"pcd", Format::pcd},
                                                                {"glb", Format::glb},
                                                                {"3dscene", Format::scene},
                                                                {"mapcollection", Format::mapcollection},
                                                                {"csv", Format::csv}}));
  command
      ->add_option(
          "-o,--output", options->output,
          "file; of mapcollection, and of bt and ot without --node or --merged, a folder, which is made")
      ->type_name("OUT")
      ->required();
  auto* node =
      command->add_option("--node", options->node, "bt, ot: only this node, in its frame")->type_name("ID");
  auto* merged =
      command->add_flag("--merged", options->merged, "bt, ot: all nodes as one tree, in the world's frame")
          ->excludes(node);
  command->add_option("--resolution", options->resolution, "of the merged tree, metres")
      ->type_name("R")
      ->capture_default_str()
      ->needs(merged);
  addAtScan(*command, options->at_scan);
  command->callback([options, &action] { action = [options] { return exportMap(*options); }; });
}

}  // namespace hoctomap
