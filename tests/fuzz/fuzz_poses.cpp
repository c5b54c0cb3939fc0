// SPDX-License-Identifier: BSD-3-Clause
// Pose files: every pose of a track that is accepted can be asked for.
#include <sstream>

#include "FuzzTarget.h"
#include "hoctomap/io/PoseTrack.h"

namespace hoctomap::fuzz {

std::vector<std::string> seeds() {
  return {"# t x y z yaw pitch roll\n1300000000.0 0 0 1.2 0.1 0 0\n1300000000.5 0.1 0 1.2 0.2 0 -0.1\n",
          "1300000000.0 0 0 1.2 0 0 0 1\n1300000000.5 0.1 0 1.2 0 0 0.6 0.8\n"};
}

void read(std::string_view bytes) {
  std::istringstream in{std::string(bytes)};
  const PoseTrack track = readPoses(in, "poses.txt");
  require(track.at(track.lastStamp(), 0.5).has_value(), "the last pose is there");
}

}  // namespace hoctomap::fuzz
