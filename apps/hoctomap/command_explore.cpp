// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "Command.h"
#include "SimulatorCommands.h"

namespace hoctomap {

void addExploreCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ExploreOptions>();
  CLI::App* command = addCommand(
      app, "explore", "Let a simulated robot map the tables of a scene by itself (Section V)",
      {"hoctomap explore -c configs/scenes/explore_table.ini -o map",
       "hoctomap explore -c configs/scenes/explore_wall.ini -o map --set robot.position_error=0.01"});
  command->add_option("-c,--scene", options->scene, "scene with a section [robot]")
      ->type_name("SCENE.ini")
      ->required();
  command->add_option("-o,--output", options->output, "directory for the map and what the robot did")
      ->type_name("DIR")
      ->required();
  command
      ->add_option("--config", options->config,
                   "configuration (default: the built-in tabletop.ini with objects at 5 mm)")
      ->type_name("INI");
  command
      ->add_option("--set", options->overrides,
                   "override a setting of the scene or the configuration; may be repeated")
      ->type_name("section.key=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--seed", options->seed, "seed of the noise and of the viewpoints")->type_name("N");
  command->add_flag("--overwrite", options->overwrite, "replace the map in DIR");
  command->add_option("--threads", options->threads, "threads to use (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  command->add_flag("-v,--verbose", options->verbose, "say more");
  command->add_flag("-q,--quiet", options->quiet, "say only warnings and errors");
  command->callback([options, &action] { action = [options] { return explore(*options); }; });
}

}  // namespace hoctomap
