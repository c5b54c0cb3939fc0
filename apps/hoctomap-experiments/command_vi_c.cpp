// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>

#include "Command.h"
#include "hoctomap/config/SceneConfig.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/CsvText.h"
#include "vi_c/Results.h"

namespace hoctomap {

namespace {

struct CommandOptions {
  std::string output;
  std::vector<std::string> scenes{"configs/scenes/explore_table.ini", "configs/scenes/explore_cluttered.ini",
                                  "configs/scenes/explore_wall.ini", "configs/scenes/explore_two_tables.ini"};
  std::vector<std::string> assignments;        ///< of the settings
  std::vector<std::string> scene_assignments;  ///< of all scenes
  int seeds = 20;
  int first_seed = 1;
  int views = 8;
  bool quick = false;
};

/// A scene and a seed, for all methods.
struct Job {
  std::string scene;
  const Simulation* simulation;
  std::uint64_t seed;
};

int viC(CommandOptions options) {
  std::vector<std::string> assignments{"label.object.resolution=0.005"};
  assignments.insert(assignments.end(), options.assignments.begin(), options.assignments.end());
  if (options.quick) {
    options.seeds = 1;
    options.views = 4;
    options.scenes.resize(1);
    for (const char* small : {"camera.width=320", "camera.height=240", "camera.fx=270"})
      options.scene_assignments.emplace_back(small);
    assignments.emplace_back("exploration.max_views=4");
  }
  const Settings settings = loadSettings(std::nullopt, assignments);
  std::vector<Simulation> simulations;
  simulations.reserve(options.scenes.size());
  std::vector<Job> jobs;
  for (const std::string& file : options.scenes) {
    simulations.push_back(loadScene(file, options.scene_assignments));
    if (!simulations.back().robot) throw ConfigError(file + ": needs a section [robot]");
    const std::string name = std::filesystem::path(file).stem().string();
    for (int seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed)
      jobs.push_back({name, &simulations.back(), static_cast<std::uint64_t>(seed)});
  }

  std::vector<Trial> trials;
  for (const Job& job : jobs) {
    const TrialScene scene(job.scene, *job.simulation, job.seed);
    for (int m = 0; m < kViewMethods; ++m) {
      const auto method = static_cast<ViewMethod>(m);
      const bool chooses = method == ViewMethod::recommended || method == ViewMethod::paper;
      trials.push_back(runTrial(scene, settings, method, {options.views, chooses}));
      std::cerr << trials.size() << "/" << jobs.size() * kViewMethods << " " << scene.name << ", "
                << toString(method) << ", seed " << scene.seed << ": "
                << 100.0 * trials.back().views.back().coverage << " % after "
                << trials.back().views.size() - 1 << " views" << std::endl;
    }
  }

  std::filesystem::create_directories(options.output);
  const std::filesystem::path folder(options.output);
  const std::string tables = viCMarkdown(trials);
  writeTextFile(folder / "views.csv", viewsCsv(trials));
  writeTextFile(folder / "trials.csv", trialsCsv(trials));
  writeTextFile(folder / "vi_c.md", tables);
  std::cout << tables << std::flush;
  drawViC(trials, folder);
  return 0;
}

}  // namespace

void addViCCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* command = app.add_subcommand(
      "vi-c", "Section VI-C: exploration of simulated tables beside random viewpoints and circles");
  command->add_option("-o,--output", options->output, "folder for CSV, tables and plots")
      ->type_name("DIR")
      ->required();
  command
      ->add_option("scenes", options->scenes, "scenes with a robot (default: configs/scenes/explore_*.ini)")
      ->type_name("SCENE.ini");
  command->add_option("--seeds", options->seeds, "seeds of each scene")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command->add_option("--first-seed", options->first_seed, "the first of them (default 1)")->type_name("N");
  command
      ->add_option("--views", options->views, "views of each table, of methods that do not end by themselves")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command->add_option("--set", options->assignments, "section.key=value of the settings")
      ->type_name("ASSIGNMENT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--set-scene", options->scene_assignments, "section.key=value of the scenes")
      ->type_name("ASSIGNMENT")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("--quick", options->quick, "one seed of one scene, small images, four views");
  command->footer("\nExample, from the root of the sources:\n  hoctomap-experiments vi-c -o out/vi-c\n");
  command->callback([options, &action] { action = [options] { return viC(*options); }; });
}

}  // namespace hoctomap
