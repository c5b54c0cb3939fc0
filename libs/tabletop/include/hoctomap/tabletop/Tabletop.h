// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "hoctomap/mapping/AssociationFunction.h"
#include "hoctomap/mapping/LabelingFunction.h"

namespace hoctomap {

/// L' of Eq. 10: planes are tables, clusters objects, the rest background.
[[nodiscard]] std::unique_ptr<LabelingFunction> makeTabletopLabeling();

/// r' of Eq. 11: tables are above objects, the background above tables and objects.
[[nodiscard]] std::unique_ptr<Relation> makeTabletopRelation();

/// r' with the choice among equally deep tables: the one whose surface lies nearest below the object and
/// whose outline contains the object's centre (docs/decisions).
[[nodiscard]] RelationSet makeTabletopRelations();

/// f'_A of Section IV-C: the node of the same label whose oriented box intersects that of the segment, grown
/// by `margin` metres; the deepest first, then the largest overlap, then the lowest id.
[[nodiscard]] std::unique_ptr<AssociationFunction> makeTabletopAssociation(double margin);

}  // namespace hoctomap
