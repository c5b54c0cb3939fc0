// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/hierarchy/NodeId.h"

namespace hoctomap {

/// A perceived movement of a node (Section III-D): t_i <- t_i o t.
struct ObjectMotion {
  double stamp = 0.0;  ///< seconds since the epoch
  NodeId node{};
  Pose motion;  ///< t, in the node's frame
};

/// A scan of the log that could not be used.
struct SkippedScan {
  std::uint64_t scan = 0;
  double stamp = 0.0;
  std::string reason;  ///< one of few texts, so that skips can be counted by reason
};

using SourceItem = std::variant<Measurement, ObjectMotion, SkippedScan>;

/// Where measurements come from: a log, a simulation, a robot. Items come in the order of the log.
class MeasurementSource {
 public:
  virtual ~MeasurementSource() = default;

  /// The next item, or nothing at the end.
  /// @throws InputError if the input is damaged.
  [[nodiscard]] virtual std::optional<SourceItem> next() = 0;

  /// Number of scans in all, if known: for progress only.
  [[nodiscard]] virtual std::optional<std::uint64_t> totalScans() const { return std::nullopt; }
};

}  // namespace hoctomap
