// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/obs/CActionRobotMovement2D.h>

namespace mrpt::obs {

/// In place of MRPT's own, in this program: the increment as it was read, and nothing drawn from its motion
/// model. MRPT draws as many particles as the log says (a number that nothing in the
/// log has to back: 4 million take 20 s) to make `poseChange` of them, which nothing here looks at.
void CActionRobotMovement2D::computeFromOdometry(const mrpt::poses::CPose2D& odometryIncrement,
                                                 const TMotionModelOptions& options) {
  estimationMethod = emOdometry;
  rawOdometryIncrementReading = odometryIncrement;
  motionModelConfiguration = options;
}

}  // namespace mrpt::obs
