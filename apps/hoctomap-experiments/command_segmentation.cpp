// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>

#include "Command.h"
#include "MappingSetup.h"
#include "hoctomap/config/Settings.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/LabelPng.h"
#include "segmentation/LabelledScenes.h"
#include "segmentation/SimulatedScenes.h"

namespace hoctomap {

namespace {

struct CommandOptions {
  std::string scenes;
  std::string output;
  std::string config;
  std::vector<std::string> overrides;
  int simulated = 0;
  int first = 1;
};

constexpr std::array kKinds{SceneKind::piled, SceneKind::thin, SceneKind::far, SceneKind::bare};

int segmentation(const CommandOptions& options) {
  const auto file =
      options.config.empty() ? std::nullopt : std::optional<std::filesystem::path>(options.config);
  const Settings settings = loadSettings(file, options.overrides);
  const auto method = makeSegmentation(settings);
  const std::filesystem::path output(options.output);
  std::vector<SceneResult> results;
  std::string csv = "scene,category,precision,recall,f,share75,found,objects,user_ms\n";
  const auto take = [&](const LabelledScene& scene, const auto& segment) {
    const auto labels = output / scene.name / "labels";
    std::filesystem::create_directories(labels);
    const SceneResult& r = results.emplace_back(segment([&](const GreyImage& image) {
      writeLabelPng(labels / "000000.png", image.width, image.height, image.values);
    }));
    csv += scene.name + "," + scene.category;
    for (const double value : {r.score.precision, r.score.recall, r.score.f, r.score.share75, r.score.found,
                               r.score.objects, r.user_ms}) {
      csv += "," + std::to_string(value);
    }
    csv += "\n";
    std::cerr << scene.name << " F " << r.score.f << ", " << r.score.found << " of " << r.score.objects
              << " objects" << std::endl;
  };
  if (!options.scenes.empty()) {
    for (const auto& scene : labelledScenes(options.scenes))
      take(scene, [&](const auto& keep) { return segmentScene(scene, *method, keep); });
  }
  for (const SceneKind kind : kKinds) {
    for (int seed = options.first; seed < options.first + options.simulated; ++seed) {
      const LabelledScene scene{toString(kind) + "_" + std::to_string(seed), toString(kind), {}};
      const auto view = look(makeSegmentationScene(kind, static_cast<std::uint64_t>(seed)));
      take(scene, [&](const auto& keep) { return segmentView(scene, view, *method, keep); });
    }
  }
  writeTextFile(output / "segmentation.csv", csv);
  const std::string table = categoryTable(results);
  writeTextFile(output / "segmentation.md", table);
  std::cout << table << std::flush;
  return 0;
}

}  // namespace

void addSegmentationCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* command = app.add_subcommand(
      "segmentation", "Objects found in labelled scenes beside the true ones: overlap by category, CPU time");
  command->add_option("scenes", options->scenes, "folder of NNNNNN/{scene.rawlog,label.png}")
      ->type_name("DIR");
  command
      ->add_option("--simulated", options->simulated,
                   "so many generated scenes of each kind: piled, thin, far, bare")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--first", options->first, "seed of the first generated scene")
      ->check(CLI::PositiveNumber);
  command->add_option("-o,--output", options->output, "folder for label images, CSV and table")
      ->type_name("DIR")
      ->required();
  command->add_option("-c,--config", options->config, "configuration (default: built in)")->type_name("INI");
  command->add_option("--set", options->overrides, "override a setting; may be repeated")
      ->type_name("section.key=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->callback([options, &action] { action = [options] { return segmentation(*options); }; });
}

}  // namespace hoctomap
