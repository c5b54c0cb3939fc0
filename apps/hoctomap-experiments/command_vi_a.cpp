// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>

#include "Command.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/CsvText.h"
#include "measuring/OwnProcess.h"
#include "performance/Machine.h"
#include "vi_a/Plots.h"
#include "vi_a/Runs.h"

namespace hoctomap {

namespace {

struct CommandOptions {
  ViAOptions experiment;
  std::string output;
  std::string scenes = "configs/scenes";
  std::string kitchen;
  bool quick = false;
  bool resume = false;
};

/// A few seconds for all: images of 320 x 240, three views, coarse maps; every kind of figure occurs.
void makeQuick(ViAOptions& options) {
  options.repeats = 1;
  options.resolutions_mm = {128, 64, 32, 16};
  options.monolithic_to_mm = 32;
  options.stock_to_mm = 64;
  options.stock_part_to_mm = 32;
}

ScanSet simulatedSet(const CommandOptions& options, const std::string& name) {
  const std::filesystem::path log = std::filesystem::path(options.output) / (name + ".rawlog");
  std::vector<std::string> assignments;
  if (options.quick) assignments = quickScene();
  const auto scene = std::filesystem::path(options.scenes) / (name + ".ini");
  return {name, log, simulateLog(scene, assignments, log)};
}

ScanSet recordedSet(const std::string& name, const std::string& log) {
  ScanChoice choice;
  choice.log = log;
  return {name, log, readScans(choice).size()};
}

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FileError(file.string() + " cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What docs/reproduction.md shows.
std::string summary(const ViAResults& results) {
  Task machine;
  machine.name = "machine";
  return markdownTables(results) + "\nequal maps of stock and ours: " + std::to_string(results.equal_maps) +
         " of " + std::to_string(results.equal_maps + results.unequal_maps) +
         "\n\nPredictions beside measurements:\n\n" + checksMarkdown(results) + "\n" +
         describeMachine(*measureApart(machine));
}

int viA(CommandOptions options) {
  if (options.quick) makeQuick(options.experiment);
  std::filesystem::create_directories(options.output);
  const auto say = [](const std::string& text) { std::cerr << text << std::endl; };
  say("simulating the scans");
  std::vector<ScanSet> sets{simulatedSet(options, "small_objects"), simulatedSet(options, "big_objects")};
  if (!options.kitchen.empty()) sets.push_back(recordedSet("kitchen", options.kitchen));

  const std::filesystem::path folder(options.output);
  const std::filesystem::path runs_csv = folder / "vi_a_runs.csv";
  const KnownRuns known = options.resume ? parseRuns(textOf(runs_csv)) : KnownRuns();
  if (!options.resume) writeTextFile(runs_csv, runsCsvHeader());
  std::ofstream runs(runs_csv, std::ios::binary | std::ios::app);
  const auto add_run = [&](const std::string& row) {
    if (!(runs << row).flush()) throw FileError(runs_csv.string() + " cannot be written");
  };
  const ViAResults results = runViA(options.experiment, sets, known, say, add_run);
  writeTextFile(folder / "vi_a.csv", pointsCsv(results));
  writeTextFile(folder / "vi_a_checks.csv", checksCsv(results));
  drawPlots(results, folder);
  const std::string text = summary(results);
  writeTextFile(folder / "vi_a.md", text);
  std::cout << text << std::flush;
  if (results.unequal_maps > 0) throw MapError("stock's map and ours differ");
  return 0;
}

}  // namespace

void addViACommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  ViAOptions& experiment = options->experiment;
  experiment.config = "configs/paper.ini";
  CLI::App* command = app.add_subcommand(
      "vi-a", "Section VI-A, Fig. 4 and 5: memory and time of the hierarchy and of one single map");
  command->add_option("-o,--output", options->output, "folder for logs, CSV and plots")
      ->type_name("DIR")
      ->required();
  command->add_option("--kitchen", options->kitchen, "a recorded sweep as third set")->type_name("LOG");
  command->add_option("--scenes", options->scenes, "folder of small_objects.ini and big_objects.ini")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_option("-c,--config", experiment.config, "configuration")
      ->type_name("INI")
      ->capture_default_str();
  command->add_option("--repeats", experiment.repeats, "of every run")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--stock-repeats", experiment.stock_repeats, "at most, of all scans with stock OctoMap")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--monolithic-to", experiment.monolithic_to_mm, "finest single map with our engine")
      ->type_name("MM")
      ->capture_default_str();
  command->add_option("--stock-to", experiment.stock_to_mm, "finest single map with stock OctoMap")
      ->type_name("MM")
      ->capture_default_str();
  command->add_option("--stock-part-to", experiment.stock_part_to_mm, "finest one from a part of the scans")
      ->type_name("MM")
      ->capture_default_str();
  command->add_option("--stock-part-scans", experiment.stock_part_scans, "scans of that part")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--continue", options->resume, "take the runs that DIR/vi_a_runs.csv has already");
  command->add_flag("--quick", options->quick, "few, small scans and coarse maps: does everything work?");
  command->footer(
      "\nWhat is finer is predicted (docs/reproduction.md). Run it from the root of the sources.\n"
      "Example:\n  hoctomap-experiments vi-a -o out/vi-a --kitchen table_sweep.rawlog\n");
  command->callback([options, &action] { action = [options] { return viA(*options); }; });
}

}  // namespace hoctomap
