// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/registerAllClasses.h>

#include "ObservationReader.h"

namespace hoctomap {

void registerLogClasses() {
  mrpt::obs::registerAllClasses_mrpt_obs();
  mrpt::maps::registerAllClasses_mrpt_maps();
}

}  // namespace hoctomap
