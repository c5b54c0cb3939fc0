// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
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
  verb->add_option("map", *map, "map directory")->required();
  verb->add_option("out", *out, ".3Dscene to write")->required();
  const auto at_scan = std::make_shared<std::optional<std::uint64_t>>();
  const auto intact = std::make_shared<bool>(false);
  verb->add_option("--at-scan", *at_scan, "the map as it was after this scan");
  verb->add_flag("--intact", *intact, "leave out nodes whose file is damaged");
  verb->callback([=, &run] {
    run = [=] {
      std::vector<Damage> damage;
      const MapReadOptions options{.at_scan = *at_scan, .damage = *intact ? &damage : nullptr};
      writeSceneFile(readMap(*map, options).hierarchy, *out);
      return 0;
    };
  });
}

}  // namespace hoctomap
