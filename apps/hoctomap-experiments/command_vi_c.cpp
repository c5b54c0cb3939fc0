// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "Command.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/scenes/SceneConfig.h"
#include "vi_c/Results.h"

namespace hoctomap {

namespace {

struct CommandOptions {
  std::string output;
  std::vector<std::string> scenes{"configs/scenes/explore_table.ini", "configs/scenes/explore_cluttered.ini",
                                  "configs/scenes/explore_wall.ini", "configs/scenes/explore_two_tables.ini"};
  std::vector<std::string> assignments;        ///< of the settings
  std::vector<std::string> scene_assignments;  ///< of all scenes
  std::vector<std::string> methods;            ///< as `optionOf`; none: all
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

/// A method as an argument: `circle_of_4`.
std::string optionOf(ViewMethod method) {
  std::string name = toString(method);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::vector<std::string> methodNames() {
  std::vector<std::string> names;
  for (int m = 0; m < kViewMethods; ++m) names.push_back(optionOf(static_cast<ViewMethod>(m)));
  return names;
}

void runJob(const Job& job, const Settings& settings, const CommandOptions& options,
            std::vector<Trial>& trials) {
  const TrialScene scene(job.scene, *job.simulation, job.seed);
  for (int m = 0; m < kViewMethods; ++m) {
    const auto method = static_cast<ViewMethod>(m);
    if (!options.methods.empty() &&
        std::count(options.methods.begin(), options.methods.end(), optionOf(method)) == 0)
      continue;
    const bool chooses = method == ViewMethod::recommended || method == ViewMethod::paper;
    trials.push_back(runTrial(scene, settings, method, {options.views, chooses}));
    const Trial& trial = trials.back();
    std::cerr << trials.size() << " " << scene.name << ", " << toString(method) << ", seed " << scene.seed
              << ": " << 100.0 * trial.views.back().coverage << " % after " << trial.views.size() - 1
              << " views" << std::endl;
  }
}

void write(const std::vector<Trial>& trials, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  writeTextFile(folder / "views.csv", viewsCsv(trials));
  writeTextFile(folder / "steps.csv", stepsCsv(trials));
  writeTextFile(folder / "trials.csv", trialsCsv(trials));
  writeTextFile(folder / "vi_c.md", viCMarkdown(trials));
}

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
  for (const std::string& file : options.scenes) {
    simulations.push_back(loadScene(file, options.scene_assignments));
    if (!simulations.back().robot) throw ConfigError(file + ": needs a section [robot]");
  }
  // All scenes of a seed before the next seed: what a run that is stopped leaves behind is of all scenes.
  std::vector<Job> jobs;
  for (int seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed)
    for (std::size_t i = 0; i < simulations.size(); ++i)
      jobs.push_back({std::filesystem::path(options.scenes[i]).stem().string(), &simulations[i],
                      static_cast<std::uint64_t>(seed)});

  std::vector<Trial> trials;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    runJob(jobs[i], settings, options, trials);
    if ((i + 1) % simulations.size() == 0) write(trials, options.output);
  }
  std::cout << viCMarkdown(trials) << std::flush;
  drawViC(trials, options.output);
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
  command->add_option("--method", options->methods, "of choosing viewpoints; may be repeated (default: all)")
      ->type_name("METHOD")
      ->check(CLI::IsMember(methodNames()))
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
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
