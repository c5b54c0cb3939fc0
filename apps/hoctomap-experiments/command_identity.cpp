// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "Command.h"
#include "MappingSetup.h"
#include "hoctomap/config/Settings.h"
#include "hoctomap/io/CsvText.h"
#include "identity/IdentityRun.h"
#include "measuring/Figures.h"
#include "measuring/Scans.h"

namespace hoctomap {

namespace {

constexpr std::array kOrders{ScanOrder::forward, ScanOrder::reverse, ScanOrder::shuffled};
constexpr double kSamePlace = 0.01;  // m, between the centroids of one object in two maps

struct CommandOptions {
  std::string output;
  std::string config;
  std::vector<std::string> overrides;
  int scenes = 20;
  int first = 1;
  int views = 10;
  std::string log;
  std::vector<std::string> orders;
  bool verbose = false;
};

/// One row of the table, and of the CSV file: a log in one order.
struct Row {
  std::string name;
  ScanOrder order;
  SegmentationScore score;  ///< without truth, of which only the number of objects
  std::size_t nodes = 0;
  std::size_t as_forward = 0;  ///< objects that the map of the forward order has, too
};

std::string csvRow(const Row& r) {
  return r.name + "," + toString(r.order) + "," + std::to_string(static_cast<int>(r.score.objects)) + "," +
         std::to_string(r.nodes) + "," + std::to_string(r.as_forward) + "," +
         numberText(r.score.precision, 4) + "," + numberText(r.score.recall, 4) + "," +
         numberText(r.score.f, 4) + "," + numberText(r.score.share75, 4) + "\n";
}

void printMap(const MappedLog& map) {
  for (const auto& object : map.objects) {
    std::cerr << "  node " << object.id.value << " at " << object.centroid.transpose() << ", "
              << object.world_voxels.size() << " voxels\n";
  }
  for (const auto& event : map.events) std::cerr << "  " << event << "\n";
}

bool isAsked(const CommandOptions& options, ScanOrder order) {
  return options.orders.empty() ||
         std::find(options.orders.begin(), options.orders.end(), toString(order)) != options.orders.end();
}

/// Objects a part of which is missed, and how.
std::string fateRows(const std::string& log, ScanOrder order, const MappedLog& map, const SeenScene& truth) {
  std::string rows;
  for (const ObjectFate& fate : objectFates(map, truth)) {
    rows += log + "," + toString(order) + "," + fate.name + "," + numberText(fate.points);
    for (const double share : {fate.found, fate.in_other_half, fate.in_another, fate.nowhere})
      rows += "," + numberText(share, 3);
    rows += "," + fate.joined_with + "\n";
  }
  return rows;
}

/// The log in every order.
std::vector<Row> runLog(const std::string& name, const SeenScene& seen, const Settings& settings,
                        const CommandOptions& options, std::string& fates) {
  std::vector<Row> rows;
  MappedLog forward;
  if (seen.objects > 0) {
    const SegmentationScore views = scoreViews(seen, *makeSegmentation(settings));
    std::cerr << name << ": single views F " << numberText(views.f, 4) << ", F >= 0.75 "
              << numberText(views.share75, 4) << std::endl;
  }
  for (const ScanOrder order : kOrders) {
    if (!isAsked(options, order)) continue;
    const MappedLog map = mapScans(reordered(seen.scans, order, 7), settings);
    if (order == ScanOrder::forward) forward = map;
    if (seen.objects > 0) fates += fateRows(name, order, map, seen);
    Row row{name, order, {}, map.objects.size(), matchedObjects(forward, map, kSamePlace)};
    if (seen.objects > 0) row.score = scoreIdentity(map, seen);
    rows.push_back(row);
    std::cerr << csvRow(row) << std::flush;
    if (options.verbose) printMap(map);
  }
  return rows;
}

std::string summary(const std::vector<Row>& rows, const CommandOptions& options) {
  std::string table =
      "| order | logs | objects | nodes | also forward | P | R | F | F >= 0.75 "
      "|\n|---|---|---|---|---|---|---|---|---|\n";
  for (const ScanOrder order : kOrders) {
    if (!isAsked(options, order)) continue;
    SegmentationScore sum;
    double logs = 0.0;
    std::size_t nodes = 0;
    std::size_t as_forward = 0;
    for (const Row& row : rows) {
      if (row.order != order) continue;
      sum += row.score;
      logs += 1.0;
      nodes += row.nodes;
      as_forward += row.as_forward;
    }
    table += "| " + toString(order) + " | " + numberText(logs) + " | " + numberText(sum.objects) + " | " +
             std::to_string(nodes) + " | " + std::to_string(as_forward);
    for (const double value : {sum.precision, sum.recall, sum.f, sum.share75})
      table += " | " + numberText(value / std::max(1.0, logs), 3);
    table += " |\n";
  }
  return table;
}

int identity(const CommandOptions& options) {
  const auto file =
      options.config.empty() ? std::nullopt : std::optional<std::filesystem::path>(options.config);
  const Settings settings = loadSettings(file, options.overrides);
  std::vector<Row> rows;
  std::string fates = "log,order,object,points,found,in_other_half,in_another,nowhere,joined_with\n";
  const auto take = [&](const std::vector<Row>& more) { rows.insert(rows.end(), more.begin(), more.end()); };
  if (!options.log.empty()) {
    SeenScene seen;
    seen.scans = readScans({options.log, 0, 1, std::nullopt, settings.sensor.min_range});
    take(runLog(std::filesystem::path(options.log).stem().string(), seen, settings, options, fates));
  } else {
    for (int seed = options.first; seed < options.first + options.scenes; ++seed) {
      const CrowdedScene scene = makeCrowdedScene(static_cast<std::uint64_t>(seed), options.views);
      take(runLog(scene.name, see(scene), settings, options, fates));
    }
  }
  std::string csv = "log,order,objects,nodes,also_forward,precision,recall,f,share75\n";
  for (const Row& row : rows) csv += csvRow(row);
  const std::filesystem::path output(options.output);
  std::filesystem::create_directories(output);
  writeTextFile(output / "identity.csv", csv);
  writeTextFile(output / "objects.csv", fates);
  writeTextFile(output / "identity.md", summary(rows, options));
  std::cout << summary(rows, options) << std::flush;
  return 0;
}

}  // namespace

void addIdentityCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* command = app.add_subcommand(
      "identity",
      "Is one object one node, whatever the order of the views? Simulated objects that touch and stand "
      "on each other, or a log");
  command->add_option("-o,--output", options->output, "folder for CSV and table")
      ->type_name("DIR")
      ->required();
  command->add_option("-c,--config", options->config, "configuration")->type_name("INI");
  command->add_option("--set", options->overrides, "section.key=value")->type_name("ASSIGNMENT");
  command->add_option("--scenes", options->scenes, "random scenes")->type_name("N")->capture_default_str();
  command->add_option("--first", options->first, "seed of the first")->type_name("N")->capture_default_str();
  command->add_option("--views", options->views, "scans of a scene")->type_name("N")->capture_default_str();
  command
      ->add_option("--log", options->log, "instead of scenes: a log, whose maps are compared with each other")
      ->type_name("LOG");
  command->add_option("--order", options->orders, "only these orders")
      ->type_name("ORDER ...")
      ->check(CLI::IsMember({"forward", "reverse", "shuffled"}));
  command->add_flag("-v,--verbose", options->verbose, "nodes and events of every map");
  command->footer("\nExample:\n  hoctomap-experiments identity -o out/identity\n");
  command->callback([options, &action] { action = [options] { return identity(*options); }; });
}

}  // namespace hoctomap
