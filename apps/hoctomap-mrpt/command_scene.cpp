// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "Verb.h"
#include "hoctomap/io/MapReader.h"
#include "hoctomap/mrpt_io/SceneFile.h"

namespace hoctomap {

void addSceneCommand(CLI::App& app, VerbRun& run) {
  auto* verb = app.add_subcommand("scene", "a map as .3Dscene for MRPT's SceneViewer3D");
  const auto map = std::make_shared<std::string>();
  const auto out = std::make_shared<std::string>();
  auto* map_option = verb->add_option("map", *map, "map directory");
  verb->add_option("out", *out, ".3Dscene to write")->needs(map_option);
  const auto told = std::make_shared<bool>(false);
  verb->add_flag("--told", *told, "map and out come by standard input, each ended by a zero byte")
      ->excludes(map_option);
  const auto at_scan = std::make_shared<std::optional<std::uint64_t>>();
  const auto intact = std::make_shared<bool>(false);
  verb->add_option("--at-scan", *at_scan, "the map as it was after this scan");
  verb->add_flag("--intact", *intact, "leave out nodes whose file is damaged");
  verb->callback([=, &run] {
    if (!*told && out->empty()) throw CLI::RequiredError("map and out");
    run = [=] {
      if (*told && !(std::getline(std::cin, *map, '\0') && std::getline(std::cin, *out, '\0'))) {
        return 0;  // there is no map to show
      }
      std::vector<Damage> damage;
      const MapReadOptions options{.at_scan = *at_scan, .damage = *intact ? &damage : nullptr};
      const StoredMap stored = readMap(*map, options);
      writeSceneFile(stored.hierarchy, *out);
      // Somebody waits: to give back the memory of a large map one by one takes longer than to end.
      if (*told) std::_Exit(0);
      return 0;
    };
  });
}

}  // namespace hoctomap
