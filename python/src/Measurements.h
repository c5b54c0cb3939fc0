// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "hoctomap/geometry/Measurement.h"

namespace hoctomap::python {

/// A measurement as Python holds it. The mapper numbers those that have no number.
struct NumberedMeasurement {
  Measurement z;
  bool has_number = false;
};

}  // namespace hoctomap::python
