// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/FixedSolid.h"

#include <memory>
#include <utility>
#include <variant>

namespace hoctomap {

SolidId addFixedSolid(Scene& scene, const std::string& name, const Shape& shape, const Pose& world_T_solid,
                      SolidLabel label) {
  Solid solid;
  solid.name = name;
  solid.label = label;
  solid.surface = std::make_shared<const TriangleMesh>(tessellate(shape));
  solid.support_T_solid = world_T_solid;
  if (const auto* table = std::get_if<TableShape>(&shape)) solid.top = table->height;
  return scene.add(std::move(solid));
}

}  // namespace hoctomap
