// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "Command.h"
#include "building/BuildingRun.h"
#include "building/BuildingScene.h"
#include "building/BuildingScore.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/MapReader.h"
#include "measuring/Figures.h"

namespace hoctomap {

namespace {

struct CommandOptions {
  std::string output;
  std::string config;
  std::vector<std::string> overrides;
  BuildingPlan plan;
};

/// Mean CPU seconds a scan, of the scans from `begin` to `end`.
double meanCpu(const std::vector<Elapsed>& scans, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += scans[i].cpu_s;
  return sum / static_cast<double>(std::max<std::size_t>(1, end - begin));
}

/// A row a tenth of the log.
std::string rateTable(const BuildingRun& run) {
  std::string table = "| scans | nodes | CPU a scan | of that commits |\n|---|---|---|---|\n";
  const std::size_t scans = run.scans.size();
  constexpr std::size_t kParts = 10;
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::size_t begin = part * scans / kParts;
    const std::size_t end = (part + 1) * scans / kParts;
    if (begin == end) continue;
    table += "| " + std::to_string(begin) + " to " + std::to_string(end - 1) + " | " +
             std::to_string(run.nodes[end - 1]) + " | " +
             numberText(1e3 * meanCpu(run.scans, begin, end), 4) + " ms | " +
             numberText(1e3 * meanCpu(run.commits, begin, end), 3) + " ms |\n";
  }
  // Two of twelve rooms at either end.
  const std::size_t sixth = scans / 6;
  const double first = meanCpu(run.scans, 0, sixth);
  const double last = meanCpu(run.scans, scans - sixth, scans);
  table += "\nCPU a scan, last sixth over first: " + numberText(last / first, 4) +
           "; memory: " + numberText(1e-6 * static_cast<double>(run.memory_bytes), 4) + " MB\n";
  return table;
}

std::string scoreRow(const std::string& what, const BuildingScore& score) {
  return "| " + what + " | " + std::to_string(score.solids) + " | " + std::to_string(score.nodes) + " | " +
         std::to_string(score.matched) + " | " + numberText(score.precision(), 4) + " | " +
         numberText(score.recall(), 4) + " |\n";
}

std::string csv(const BuildingRun& run) {
  std::string text = "scan,nodes,cpu_s,commit_cpu_s\n";
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    text += std::to_string(i) + "," + std::to_string(run.nodes[i]) + "," + numberText(run.scans[i].cpu_s) +
            "," + numberText(run.commits[i].cpu_s) + "\n";
  }
  return text;
}

int building(const CommandOptions& options) {
  const auto file =
      options.config.empty() ? std::nullopt : std::optional<std::filesystem::path>(options.config);
  const Settings settings = loadSettings(file, options.overrides);
  const std::filesystem::path output(options.output);
  std::filesystem::create_directories(output);
  const Simulation made = makeBuilding(options.plan);
  const auto log = output / "building.rawlog";
  if (!std::filesystem::exists(log)) {
    std::cerr << "the log: " << made.views.size() << " scans" << std::endl;
    writeBuildingLog(made, log);
  }
  constexpr std::uint64_t kEvery = 100;  // scans
  const BuildingRun run = mapBuilding(log, settings, output / "map", [](std::uint64_t scans) {
    if (scans % kEvery == 0) std::cerr << scans << " scans" << std::endl;
  });
  const StoredMap map = readMap(output / "map");
  const BuildingScore objects = scoreBuilding(map.hierarchy, made.scene, SolidLabel::object);
  const BuildingScore tables = scoreBuilding(map.hierarchy, made.scene, SolidLabel::table);
  for (const BuildingScore* score : {&objects, &tables}) {
    for (const std::string& mistake : score->mistakes) std::cerr << mistake << "\n";
  }
  const std::string text =
      "| | in the building | nodes | matched | precision | recall |\n|---|---|---|---|---|---|\n" +
      scoreRow("objects", objects) + scoreRow("tables", tables) + "\n" + rateTable(run);
  writeTextFile(output / "building.csv", csv(run));
  writeTextFile(output / "building.md", text);
  std::cout << text << std::flush;
  return 0;
}

}  // namespace

void addBuildingCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* command = app.add_subcommand(
      "building", "A long walk through a generated building: are all objects found, and does it stay fast?");
  command
      ->add_option("-o,--output", options->output,
                   "folder for the log (made unless it is there), the map, CSV and table")
      ->type_name("DIR")
      ->required();
  command->add_option("-c,--config", options->config, "configuration")->type_name("INI");
  command->add_option("--set", options->overrides, "section.key=value")->type_name("ASSIGNMENT");
  const auto number = [&](const char* name, int& value, const char* what) {
    command->add_option(name, value, what)->type_name("N")->check(CLI::PositiveNumber)->capture_default_str();
  };
  number("--rooms", options->plan.rooms, "of the building");
  number("--tables", options->plan.tables, "in all rooms");
  number("--objects", options->plan.objects, "on all tables");
  number("--scans", options->plan.scans, "of the walk");
  number("--width", options->plan.width, "of an image, pixels");
  command->add_option("--seed", options->plan.seed, "another building")
      ->type_name("N")
      ->capture_default_str();
  command->footer("\nExample:\n  hoctomap-experiments building -o out/building\n");
  command->callback([options, &action] { action = [options] { return building(*options); }; });
}

}  // namespace hoctomap
