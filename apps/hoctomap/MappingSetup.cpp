// SPDX-License-Identifier: BSD-3-Clause
#include "MappingSetup.h"

#include "hoctomap/octree/BlockScanUpdate.h"
#include "hoctomap/tabletop/LabelRules.h"
#include "hoctomap/tabletop/Tabletop.h"
#include "hoctomap/tabletop/TabletopSegmentation.h"

namespace hoctomap {

std::unique_ptr<Segmentation> makeSegmentation(const Settings& settings) {
  if (settings.monolithic) return makeWholeSegmentation();
  return std::make_unique<TabletopSegmentation>(settings.tabletop);
}

MappingStrategies makeStrategies(const Settings& settings) {
  MappingStrategies strategies;
  strategies.segmentation = makeSegmentation(settings);
  strategies.labeling = makeTabletopLabeling(settings.labelRules());
  strategies.relations = makeTabletopRelations(settings.labelRules());
  strategies.update = makeBlockScanUpdate();
  strategies.association = makeTabletopAssociation(settings.association_margin);
  if (!settings.monolithic) strategies.existence = std::make_unique<BeamExistenceModel>(settings.existence);
  return strategies;
}

}  // namespace hoctomap
