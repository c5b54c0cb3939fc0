// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iostream>
#include <memory>

#include "Command.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/CsvText.h"
#include "measuring/Scans.h"
#include "vi_b/Results.h"

namespace hoctomap {

namespace {

namespace fs = std::filesystem;

struct CommandOptions {
  ViBOptions experiment;
  std::string output;
  std::string scene = "configs/scenes/occlusion.ini";
  std::string sequences;
  int scans = 24;
  double resolution_mm = 2.0;
  bool quick = false;
};

struct Sequence {
  std::string name;
  fs::path log;
};

/// The folders `occl_*` with a `sequence.rawlog`, by name.
std::vector<Sequence> recordedSequences(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder.string() + " is no folder");
  std::vector<Sequence> sequences;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const fs::path log = entry.path() / "sequence.rawlog";
    if (name.starts_with("occl_") && fs::is_regular_file(log)) sequences.push_back({name, log});
  }
  if (sequences.empty()) throw InputError(folder.string() + " holds no occl_*/sequence.rawlog");
  std::ranges::sort(sequences, {}, &Sequence::name);
  return sequences;
}

int viB(CommandOptions options) {
  if (options.quick) options.resolution_mm = 8.0;
  ViBOptions& experiment = options.experiment;
  experiment.output = options.output;
  experiment.resolution = 1e-3 * options.resolution_mm;
  fs::create_directories(experiment.output);
  const auto say = [](const std::string& text) { std::cerr << text << std::endl; };

  say("simulating the scans");
  std::vector<Sequence> sequences{{"simulated", experiment.output / "simulated.rawlog"}};
  simulateLog(options.scene, {"path.camera.scans_per_view=" + std::to_string(options.scans)},
              sequences.front().log);
  if (!options.sequences.empty()) {
    const auto recorded = recordedSequences(options.sequences);
    sequences.insert(sequences.end(), recorded.begin(), recorded.end());
  }
  std::vector<SequenceResult> results;
  for (const Sequence& sequence : sequences) {
    results.push_back(runSequence(experiment, sequence.name, sequence.log, say));
  }
  writeTextFile(experiment.output / "vi_b.csv", resultsCsv(results));
  writeTextFile(experiment.output / "vi_b_existence.csv", existenceCsv(results));
  writeTextFile(experiment.output / "vi_b.md", resultsMarkdown(results));
  std::cout << resultsMarkdown(results) << std::flush;
  return 0;
}

}  // namespace

void addViBCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  options->experiment.config = "configs/tabletop.ini";
  CLI::App* command = app.add_subcommand(
      "vi-b", "Section VI-B: an object is taken away behind another one; ghosts in both kinds of map");
  command->add_option("-o,--output", options->output, "folder for logs, maps, CSV and pictures")
      ->type_name("DIR")
      ->required();
  command->add_option("--scene", options->scene, "the scene to simulate")
      ->type_name("INI")
      ->capture_default_str();
  command->add_option("--scans", options->scans, "simulated scans, from one view")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--sequences", options->sequences, "also every DIR/occl_*/sequence.rawlog")
      ->type_name("DIR");
  command->add_option("-c,--config", options->experiment.config, "configuration of both maps")
      ->type_name("INI")
      ->capture_default_str();
  command->add_option("--set", options->experiment.assignments, "section.key=value, for both maps")
      ->type_name("ASSIGNMENT");
  command->add_option("--resolution", options->resolution_mm, "of objects and of the single map")
      ->type_name("MM")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--continue", options->experiment.resume, "take the maps that are in DIR already");
  command->add_flag("--quick", options->quick, "voxels of 8 mm, a few seconds: does everything work?");
  command->footer(
      "\nAt 2 mm the single map of the simulated scene takes 5.5 GB, and 19 GB while it is written;\n"
      "at 4 mm 0.11 GB.\n"
      "Run it from the root of the sources. Example:\n"
      "  hoctomap-experiments vi-b -o out/vi-b --sequences ../shared/data/mosd_change\n");
  command->callback([options, &action] { action = [options] { return viB(*options); }; });
}

}  // namespace hoctomap
