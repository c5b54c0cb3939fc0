// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/DrawPlot.h"

#include "hoctomap/io/CsvText.h"
#include "hoctomap/io/Gnuplot.h"

namespace hoctomap {

void drawPlot(const std::filesystem::path& picture, const std::string& script) {
  writeTextFile(std::filesystem::path(picture).replace_extension(".gnuplot"), script);
  writeTextFile(picture, drawWithGnuplot(script, picture.string()));
}

}  // namespace hoctomap
