// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "Command.h"
#include "SimulatorCommands.h"

namespace hoctomap {

void addSimulateCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = addCommand(app, "simulate", "Make a log of a simulated scene, with the truth beside it",
                                 {"hoctomap simulate -c configs/scenes/small_objects.ini -o small.rawlog"});
  command->add_option("-c,--config", options->scene, "scene")->type_name("SCENE.ini")->required();
  command->add_option("-o,--output", options->log, "the log")->type_name("LOG")->required();
  command
      ->add_option("--truth", options->truth,
                   "folder for the truth (default: LOG with .truth for its extension)")
      ->type_name("DIR");
  command->add_option("--threads", options->threads, "threads to use (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_option("--set", options->overrides, "override a setting of the scene; may be repeated")
      ->type_name("section.key=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("-q,--quiet", options->quiet, "say only warnings and errors");
  command->callback([options, &action] { action = [options] { return simulate(*options); }; });
}

}  // namespace hoctomap
