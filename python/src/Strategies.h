// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "Measurements.h"
#include "hoctomap/mapping/HierarchyMapper.h"

namespace hoctomap::python {

/// The scan at work as the strategies written in Python get it: one copy a scan. Guarded by the interpreter's
/// lock.
class ShownScan {
 public:
  [[nodiscard]] std::shared_ptr<NumberedMeasurement> of(const Measurement& z);

 private:
  const void* shown_points_ = nullptr;
  std::shared_ptr<NumberedMeasurement> copy_;
};

/// Puts callables in the place of strategies. Each may be None, which leaves what is there.
/// @param segmentation (Measurement) -> iterable of Segment
/// @param labeling     (Measurement, Segment) -> str
/// @param relations    dict of name -> (NodeView above, NodeView below) -> bool
void useCallables(MappingStrategies& strategies, const pybind11::object& segmentation,
                  const pybind11::object& labeling, const pybind11::object& relations);

/// Segment and NodeView.
void bindStrategyTypes(pybind11::module_& module);

}  // namespace hoctomap::python
