// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "AtScan.h"
#include "Command.h"
#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/Manifest.h"

namespace hoctomap {

namespace {

struct RenderOptions {
  std::string map;
  std::string output;
  std::string size;
  std::string view;
  std::vector<std::string> hidden;
  AtScan at_scan;
};

int render(const RenderOptions& options) {
  std::vector<std::string> arguments{"render", options.map, "-o", options.output};
  if (!options.size.empty()) arguments.insert(arguments.end(), {"--size", options.size});
  if (!options.view.empty()) arguments.insert(arguments.end(), {"--view", options.view});
  for (const std::string& label : options.hidden) arguments.insert(arguments.end(), {"--hide", label});
  if (options.at_scan) {
    noteOlderState(options.map, readManifest(options.map, options.at_scan).scans, options.at_scan);
    arguments.insert(arguments.end(), {"--at-scan", std::to_string(*options.at_scan)});
  }
  return runHelper(arguments);
}

}  // namespace

void addRenderCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command =
      addCommand(app, "render", "Make a picture of a map, without a display",
                 {"hoctomap render map -o map.png", "hoctomap render map -o top.png --view top",
                  "hoctomap render map -o scan3.png --view sensor:3",
                  "hoctomap render map -o things.png --hide background"});
  command->add_option("map", options->map, "map directory")->type_name("DIR")->required();
  command->add_option("-o,--output", options->output, "the picture")->type_name("PNG")->required();
  command->add_option("--size", options->size, "in pixels")->type_name("WxH");
  command
      ->add_option(
          "--view", options->view,
          "oblique (default), front, back, left, right, top, sensor or sensor:SCAN (as a scan saw it), or "
          "AZIMUTH,ELEVATION in degrees")
      ->type_name("VIEW");
  command->add_option("--hide", options->hidden, "leave out the nodes of a label; may be repeated")
      ->type_name("LABEL")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  addAtScan(*command, options->at_scan);
  command->callback([options, &action] { action = [options] { return render(*options); }; });
}

}  // namespace hoctomap
