// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>

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
  verb->callback([=, &run] {
    run = [=] {
      writeSceneFile(readMap(*map).hierarchy, *out);
      return 0;
    };
  });
}

}  // namespace hoctomap
