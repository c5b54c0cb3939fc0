// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>

#include "Command.h"
#include "hoctomap/io/CsvText.h"
#include "performance/Comparison.h"

namespace hoctomap {

namespace {

struct CommandOptions {
  PerformanceOptions comparison;
  std::string output;
  std::string log;
  std::string scenes = "configs/scenes";
  std::string many = "tests/benchmarks/many_objects.ini";
  bool quick = false;
};

/// Whether everything works, in a few seconds.
void makeQuick(CommandOptions& options) {
  options.comparison.repeats = 1;
  options.comparison.scans = 1;
  options.comparison.far_nodes = 100;
  options.comparison.coarsening = 4.0;
}

void makeLogs(CommandOptions& options) {
  namespace fs = std::filesystem;
  PerformanceOptions& comparison = options.comparison;
  comparison.output = options.output;
  fs::create_directories(comparison.output);
  std::vector<std::string> assignments;
  if (options.quick) assignments = quickScene();
  const auto make = [&](const fs::path& scene, const char* name) {
    const fs::path log = comparison.output / name;
    comparison.scans_of_log = simulateLog(scene, assignments, log);
    return log;
  };
  comparison.many = make(options.many, "many_objects.rawlog");
  comparison.simulated = make(fs::path(options.scenes) / "small_objects.ini", "small_objects.rawlog");
  comparison.log = comparison.simulated;
  if (options.log.empty()) return;
  ScanChoice choice;
  choice.log = comparison.log = options.log;
  comparison.scans_of_log = readScans(choice).size();
}

int performance(CommandOptions options) {
  if (options.quick) makeQuick(options);
  makeLogs(options);
  Comparison comparison(options.comparison, [](const std::string& text) { std::cerr << text << std::endl; });
  std::vector<TableRow> rows;
  bool equal = true;
  comparison.run([&](const TableRow& row) {
    rows.push_back(row);
    equal = equal && row.equal != "NO";
  });
  const std::string bounds = comparison.bounds();
  const std::filesystem::path folder(options.output);
  writeTextFile(folder / "performance.csv", tableCsv(rows));
  writeTextFile(folder / "measurements.csv", comparison.csv());
  writeTextFile(folder / "performance.md", tableMarkdown(rows) + "\n" + bounds);
  std::cout << tableMarkdown(rows) << "\n" << bounds << std::flush;
  if (equal) return 0;
  std::cerr << "the trees of stock OctoMap and ours differ" << std::endl;
  return 1;
}

}  // namespace

void addPerformanceCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* command = app.add_subcommand(
      "performance", "Our update beside stock OctoMap's, and what the program does a second");
  command->add_option("-o,--output", options->output, "folder for logs, maps, CSV and the table")
      ->type_name("DIR")
      ->required();
  command->add_option("--log", options->log, "scans to measure with (default: a simulated set)")
      ->type_name("LOG");
  command->add_option("--repeats", options->comparison.repeats, "of every measurement")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--scans", options->comparison.scans, "scans to compare with stock OctoMap on")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--scenes", options->scenes, "folder of small_objects.ini")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_option("--many-scene", options->many, "scene with many objects")
      ->type_name("INI")
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "few, small scans: does everything work?");
  command->footer("\nRun it from the root of the sources; scripts/benchmark.sh does.\n");
  command->callback([options, &action] { action = [options] { return performance(*options); }; });
}

}  // namespace hoctomap
