// SPDX-License-Identifier: BSD-3-Clause
#include "TransformOption.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <numbers>
#include <sstream>
#include <vector>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

Pose parseTransform(const std::string& text) {
  std::string plain = text;
  for (char& c : plain) {
    if (c == ',' || c == '[' || c == ']') c = ' ';
  }
  std::istringstream in(plain);
  in.imbue(std::locale::classic());
  std::vector<double> v;
  for (double value = 0.0; in >> value;) v.push_back(value);
  const bool finite = std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
  if (!in.eof() || v.size() != 6 || !finite) {
    throw ConfigError("--transform: \"" + escapedText(text, 80) +
                      "\" is not of the form \"x y z yaw pitch roll\" (metres, degrees)");
  }
  const double degree = std::numbers::pi / 180.0;
  return {v[0], v[1], v[2], degree * v[3], degree * v[4], degree * v[5]};
}

}  // namespace hoctomap
