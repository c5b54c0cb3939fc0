// SPDX-License-Identifier: BSD-3-Clause
#include "vi_a/Prediction.h"

#include <stdexcept>

namespace hoctomap {

double predictFiner(double at_4r, double at_2r) {
  if (!(at_4r > 0.0) || !(at_2r > 0.0)) throw std::invalid_argument("a prediction from nothing");
  return at_2r * (at_2r / at_4r);
}

double predictAll(double part_seconds, std::size_t part_points, std::size_t all_points) {
  if (part_points == 0) throw std::invalid_argument("a prediction from no points");
  return part_seconds * static_cast<double>(all_points) / static_cast<double>(part_points);
}

}  // namespace hoctomap
