// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>

#include "Command.h"
#include "hoctomap/config/Settings.h"
#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/MapDirectory.h"
#include "measuring/FarNodes.h"
#include "measuring/Figures.h"
#include "measuring/OwnProcess.h"

namespace hoctomap {

namespace {

struct CommandOptions {
  std::string output;
  std::size_t nodes = 100'000;
  bool only_write = false;
};

void writeMap(const std::filesystem::path& directory, std::size_t nodes) {
  const Settings settings = loadSettings(std::nullopt);
  const MapHierarchy map = makeFarNodes(settings, nodes - 1);
  MapDirectoryOptions options;
  options.mode = MapOpenMode::overwrite;
  options.config = toIni(settings);
  options.generator = "hoctomap-experiments large-map";
  MapDirectory writer(directory, options);
  const Stopwatch watch;
  writer.commit({map, {}, 1});
  std::cerr << "written in " << numberText(watch.elapsed().wall_s, 3) << " s, "
            << numberText(watch.elapsed().cpu_s, 3) << " s of CPU" << std::endl;
}

int largeMap(const CommandOptions& options) {
  const std::filesystem::path output(options.output);
  std::filesystem::create_directories(output);
  const auto map = output / "map";
  if (options.only_write) {
    writeMap(map, options.nodes);
    return 0;
  }
  // By a process of its own: what this one holds would be the least peak of those that it starts.
  if (!std::filesystem::exists(map / "hierarchy.yaml")) {
    static_cast<void>(runApart(thisProgram(), {"large-map", "--only-write", "-o", options.output, "--nodes",
                                               std::to_string(options.nodes)}));
  }
  // On the first table, in the middle of its first object.
  const std::string place = "100,-0.2,0.8";
  std::string table = "| command | wall | CPU | peak memory |\n|---|---|---|---|\n";
  const auto measure = [&](const std::string& what, const std::vector<std::string>& arguments) {
    const Figures figures = runApart(findHoctomap(), arguments);
    table += "| " + what + " | " + numberText(figures.number("wall_s"), 3) + " s | " +
             numberText(figures.number("cpu_s"), 3) + " s | " +
             numberText(1e-6 * figures.number("max_rss_bytes"), 3) + " MB |\n";
  };
  measure("--version", {"--version"});
  measure("query --point", {"query", map.string(), "--point", place});
  measure("query --objects (a table)", {"query", map.string(), "--objects", place + ",1,1,0.5"});
  measure("export --node",
          {"export", map.string(), "--format", "bt", "--node", "2", "-o", (output / "node.bt").string()});
  measure("info", {"info", map.string()});
  writeTextFile(output / "large_map.md", table);
  std::cout << table << std::flush;
  return 0;
}

}  // namespace

void addLargeMapCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* command = app.add_subcommand("large-map", "What does it cost to ask a map of many nodes?");
  command
      ->add_option("-o,--output", options->output, "folder for the map (made unless it is there) and table")
      ->type_name("DIR")
      ->required();
  command->add_option("--nodes", options->nodes, "of the map")
      ->type_name("N")
      ->check(CLI::Range(2, 100'000))
      ->capture_default_str();
  command->add_flag("--only-write", options->only_write, "write the map, and ask nothing");
  command->footer("\nExample:\n  hoctomap-experiments large-map -o out/large\n");
  command->callback([options, &action] { action = [options] { return largeMap(*options); }; });
}

}  // namespace hoctomap
