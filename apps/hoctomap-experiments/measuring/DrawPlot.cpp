// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/DrawPlot.h"

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/ChildProcess.h"

namespace hoctomap {

void drawPlot(const std::filesystem::path& script) {
  ChildProcess child({.program = "/usr/bin/gnuplot",
                      .arguments = {script.string()},
                      .output = ChildProcess::Stream::null,
                      .own_group = false});
  const ExitStatus status = child.wait();
  if (status.code != 0 || status.signal != 0) {
    throw FileError(script.string() + ": gnuplot (Debian's gnuplot-nox) could not draw it");
  }
}

}  // namespace hoctomap
