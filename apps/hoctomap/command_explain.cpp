// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <memory>

#include "AtScan.h"
#include "Command.h"
#include "ExistencePlot.h"
#include "NodeLife.h"

namespace hoctomap {

namespace {

struct ExplainOptions {
  std::string map;
  std::uint32_t node = 0;
  std::string plot;
  bool json = false;
  AtScan at_scan;
};

int explain(const ExplainOptions& options) {
  const Manifest manifest = readManifestAt(options.map, options.at_scan);
  const NodeLife life = readNodeLife(options.map, manifest, NodeId{options.node});
  if (!options.plot.empty()) {
    drawExistence(life, manifest.scans == 0 ? 0 : manifest.scans - 1, options.plot);
  }
  std::cout << (options.json ? lifeJson(life) : lifeText(life)) << std::flush;
  return 0;
}

}  // namespace

void addExplainCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ExplainOptions>();
  CLI::App* command = addCommand(
      app, "explain", "Tell the life of a node: what made it, every scan's evidence, why it was removed",
      {"hoctomap explain map 3", "hoctomap explain map 3 --plot existence.svg",
       "hoctomap explain map 3 --json --at-scan 7"});
  command->add_option("map", options->map, "map directory")->type_name("DIR")->required();
  command->add_option("node", options->node, "id of a node, removed ones too")->type_name("NODE")->required();
  command->add_option("--plot", options->plot, "also draw existence and beams over the scans (needs gnuplot)")
      ->type_name("SVG");
  command->add_flag("--json", options->json, "for programs");
  addAtScan(*command, options->at_scan);
  command->callback([options, &action] { action = [options] { return explain(*options); }; });
}

}  // namespace hoctomap
