// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/tabletop/Tabletop.h"

#include "TableChoice.h"

namespace hoctomap {

std::unique_ptr<LabelingFunction> makeTabletopLabeling() {
  return makeLabeling([](const Measurement&, const Segment& segment) {  // Eq. (10)
    switch (segment.structure) {
      case Structure::plane:
        return labels::table;
      case Structure::cluster:
        return labels::object;
      case Structure::remainder:
        break;
    }
    return labels::background;
  });
}

std::unique_ptr<Relation> makeTabletopRelation() {
  return makeLabelRelation("supports", [](const Label& i, const Label& j) {  // Eq. (11)
    return (i == labels::table && j == labels::object) || (i == labels::background && j == labels::table) ||
           (i == labels::background && j == labels::object);
  });
}

RelationSet makeTabletopRelations() {
  RelationSet relations;
  relations.add(makeTabletopRelation());
  relations.setTieBreak(preferredTable, reachOfChoice);
  return relations;
}

}  // namespace hoctomap
