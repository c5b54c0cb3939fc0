// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/io/PipeLogWriter.h"
#include "hoctomap/simulation/SimulatedRobot.h"

namespace hoctomap {

/// The measurements of a simulated robot, written to a log on their way. They are handed on as the log keeps
/// them, with depths in its steps, so that building a map from the log gives the same map.
class RecordedRobot final : public MeasurementSource {
 public:
  /// Both have to live as long as this. @param limits as for recorded scans
  RecordedRobot(SimulatedRobot& robot, PipeLogWriter& log, const RangeLimits& limits);

  [[nodiscard]] std::optional<SourceItem> next() override;

 private:
  SimulatedRobot& robot_;
  PipeLogWriter& log_;
  RangeLimits limits_;
};

}  // namespace hoctomap
