// SPDX-License-Identifier: BSD-3-Clause
// `.ot` files: what passes can be read by OctoMap and is written again byte for byte.
#include "FuzzTarget.h"
#include "SeedTree.h"
#include "hoctomap/io/OctreeFile.h"

namespace hoctomap::fuzz {

std::vector<std::string> seeds() {
  return {otBytes(*seedTree(40)), otBytes(*seedTree(1)), otBytes(octomap::OcTree(kSeedResolution))};
}

void read(std::string_view bytes) {
  const auto tree = parseOt(bytes, kSeedResolution, "node.ot");
  const std::string written = otBytes(*tree);
  const std::string_view data = bytes.substr(bytes.find("\ndata\n"));
  require(written.ends_with(data), "an octree survives the round trip");
}

}  // namespace hoctomap::fuzz
