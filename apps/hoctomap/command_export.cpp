// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>

#include "AtScan.h"
#include "Command.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"
#include "hoctomap/io/MapExport.h"

namespace hoctomap {

namespace {

struct ExportOptions {
  std::string map;
  std::string output;
  OctreeFormat format = OctreeFormat::ot;
  AtScan at_scan;
};

int exportMap(const ExportOptions& options) {
  const Manifest manifest = readManifest(options.map, options.at_scan);
  noteOlderState(options.map, manifest, options.at_scan);
  const auto damage = exportOctrees(options.map, manifest, options.output, options.format);
  for (const Damage& d : damage)
    std::cout << "damaged  " << escapedText(d.path) << "  " << escapedText(d.what) << "\n";
  std::cout << "exported " << manifest.nodes.size() - damage.size() << " nodes to " << options.output
            << std::endl;
  if (damage.empty()) return 0;
  throw MapError(options.map + ": " + std::to_string(damage.size()) +
                 " of its nodes are damaged and left out");
}

}  // namespace

void addExportCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command =
      addCommand(app, "export", "Write the octrees of a map for other tools, a file a node",
                 {"hoctomap export map --format bt -o octrees",
                  "hoctomap export damaged_map --format ot -o rest   # what is intact; exit code 4"});
  command->add_option("map", options->map, "map directory")->type_name("DIR")->required();
  command->add_option("--format", options->format, "ot: full probabilities (default), bt: maximum likelihood")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, OctreeFormat>{{"ot", OctreeFormat::ot}, {"bt", OctreeFormat::bt}}));
  command->add_option("-o,--output", options->output, "directory for the files and nodes.csv; it is made")
      ->type_name("DIR")
      ->required();
  addAtScan(*command, options->at_scan);
  command->callback([options, &action] { action = [options] { return exportMap(*options); }; });
}

}  // namespace hoctomap
