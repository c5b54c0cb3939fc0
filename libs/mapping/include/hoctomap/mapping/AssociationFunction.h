// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "hoctomap/geometry/Obb.h"
#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// A labelled segment as association sees it.
struct LabelledSegment {
  Label label;
  const PointCloud* world_points = nullptr;
  Obb box;  ///< along the segment's principal components
};

/// Whether a node may take segments of this scan: false for one that the scan's evidence contradicts.
using Admissible = std::function<bool(NodeId)>;

/// The association function f_A of Section III-C: the node that a segment falls into, or none.
class AssociationFunction {
 public:
  virtual ~AssociationFunction() = default;
  [[nodiscard]] virtual std::optional<NodeId> associate(const MapHierarchy& hierarchy,
                                                        const LabelledSegment& segment,
                                                        const Admissible& admissible) const = 0;
};

/// An association function from a lambda of the same signature.
[[nodiscard]] std::unique_ptr<AssociationFunction> makeAssociation(
    std::function<std::optional<NodeId>(const MapHierarchy&, const LabelledSegment&, const Admissible&)>
        associate);

}  // namespace hoctomap
