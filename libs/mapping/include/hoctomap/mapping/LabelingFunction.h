// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "hoctomap/hierarchy/Label.h"
#include "hoctomap/mapping/Segmentation.h"

namespace hoctomap {

/// The labelling function L(z) of Section III-E.
class LabelingFunction {
 public:
  virtual ~LabelingFunction() = default;
  [[nodiscard]] virtual Label label(const Measurement& z, const Segment& segment) const = 0;

  /// Whether segments of these labels may show one object: a part of a cup need not look like one. The node
  /// that is there first gives the label.
  [[nodiscard]] virtual bool areOfOneKind(const Label& a, const Label& b) const { return a == b; }
};

/// A labelling function from a lambda `Label(const Measurement&, const Segment&)`.
[[nodiscard]] std::unique_ptr<LabelingFunction> makeLabeling(
    std::function<Label(const Measurement&, const Segment&)> label);

}  // namespace hoctomap
