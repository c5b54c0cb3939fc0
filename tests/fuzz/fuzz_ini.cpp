// SPDX-License-Identifier: BSD-3-Clause
// The configuration: what is accepted says the same when it is written and read again.
#include "FuzzTarget.h"
#include "hoctomap/config/Settings.h"

namespace hoctomap::fuzz {

std::vector<std::string> seeds() {
  return {toIni(Settings()),
          "[mapping]\ncheckpoint_scans = 3\n[label.background]\n[label.table]\n[label.object]\n"};
}

void read(std::string_view bytes) {
  const std::string text(bytes);
  const std::string written = toIni(parseSettings(text, "config.ini"));
  require(toIni(parseSettings(written, "config.ini")) == written, "settings survive the round trip");
}

}  // namespace hoctomap::fuzz
