// SPDX-License-Identifier: BSD-3-Clause
// The classes of MRPT that may stand in a log, and what one of them does while it is read.
#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/registerAllClasses.h>

#include "ObservationReader.h"

namespace hoctomap {

void registerLogClasses() {
  mrpt::obs::registerAllClasses_mrpt_obs();
  mrpt::maps::registerAllClasses_mrpt_maps();
}

}  // namespace hoctomap

namespace mrpt::obs {

/// In place of MRPT's own, for all programs with this library: the increment as it was read, and nothing
/// drawn from its motion model. MRPT draws as many particles as the log says (a number that nothing in the
/// log has to back: 4 million take 20 s) to make `poseChange` of them, which nothing here looks at.
void CActionRobotMovement2D::computeFromOdometry(const mrpt::poses::CPose2D& odometryIncrement,
                                                 const TMotionModelOptions& options) {
  estimationMethod = emOdometry;
  rawOdometryIncrementReading = odometryIncrement;
  motionModelConfiguration = options;
}

}  // namespace mrpt::obs
