// SPDX-License-Identifier: BSD-3-Clause
// `.bt` files: what passes can be read by OctoMap, whose own reader overflows the stack on others.
#include <sstream>

#include "FuzzTarget.h"
#include "SeedTree.h"
#include "hoctomap/io/OctreeFile.h"

namespace hoctomap::fuzz {

std::vector<std::string> seeds() {
  return {btBytes(*seedTree(40)), btBytes(*seedTree(1)), btBytes(octomap::OcTree(kSeedResolution))};
}

void read(std::string_view bytes) {
  checkBt(bytes, "node.bt");
  if (bytes.find("\nsize 0\n") != std::string_view::npos) return;  // OctoMap reads beyond the end of these
  octomap::OcTree tree(kSeedResolution);
  std::istringstream data(std::string(bytes.substr(bytes.find("\ndata\n") + 6)), std::ios::binary);
  tree.readBinaryData(data);
  require(data.good(), "OctoMap reads what passes");
}

}  // namespace hoctomap::fuzz
