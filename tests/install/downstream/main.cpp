// SPDX-License-Identifier: BSD-3-Clause
// Maps a table top and asks the map.
#include "every_header.h"

#include <iostream>

using namespace hoctomap;

int main() {
  const Settings settings = loadSettings(std::nullopt);
  MappingStrategies strategies;
  strategies.segmentation = std::make_unique<TabletopSegmentation>(settings.tabletop);
  strategies.labeling = makeTabletopLabeling();
  strategies.relations = makeTabletopRelations();
  strategies.association = makeTabletopAssociation(0.0);
  strategies.update = makeBlockScanUpdate();
  HierarchyMapper mapper({}, settings.labels, std::move(strategies));

  Measurement z;
  z.world_T_sensor = Pose(0.5, -1.0, 1.6, 0.0, 0.0, 0.0);
  for (int i = 0; i < 200; ++i)
    for (int j = 0; j < 160; ++j) z.world_points.emplace_back(0.005F * float(i), 0.005F * float(j), 0.7F);
  for (const NodeEvent& event : mapper.integrate(z).events)
    std::cout << event.label.name << " " << event.node.value << " " << toString(event.kind) << "\n";

  const HierarchyQuery query(mapper.hierarchy());
  if (query.at({0.5, 0.4, 0.7}).state != Occupancy::occupied) return 1;
  return describeMap(Manifest{}).empty() ? 1 : 0;
}
