// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/Scene.h"

#include <algorithm>
#include <limits>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

constexpr std::uint16_t kBackgroundValue = 1;
constexpr std::uint16_t kFirstTable = 10;
constexpr std::uint16_t kFirstObject = 100;

bool allowedName(const std::string& name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), allowed);
}

}  // namespace

std::string_view toString(SolidLabel label) {
  switch (label) {
    case SolidLabel::background:
      return "background";
    case SolidLabel::table:
      return "table";
    case SolidLabel::object:
      return "object";
  }
  return "";
}

SolidId Scene::add(Solid solid) {
  if (!allowedName(solid.name))
    throw ConfigError("name of a solid '" + solid.name + "': use letters, digits, _ and - only");
  if (find(solid.name)) throw ConfigError("two solids are named '" + solid.name + "'");
  if (!solid.surface || solid.surface->triangles.empty())
    throw ConfigError("solid '" + solid.name + "' has no surface");
  if (solid.support && solid.support->value >= solids_.size())
    throw ConfigError("solid '" + solid.name + "' stands on an unknown solid");
  pixel_values_.push_back(nextPixelValue(solid.label));
  solids_.push_back(std::move(solid));
  return SolidId{static_cast<std::uint32_t>(solids_.size() - 1)};
}

std::vector<SolidId> Scene::ids() const {
  std::vector<SolidId> all;
  for (std::uint32_t i = 0; i < solids_.size(); ++i) all.push_back(SolidId{i});
  return all;
}

std::optional<SolidId> Scene::find(std::string_view name) const {
  for (std::uint32_t i = 0; i < solids_.size(); ++i)
    if (solids_[i].name == name) return SolidId{i};
  return std::nullopt;
}

Pose Scene::world_T_solid(SolidId id) const {
  return world_T_top(solid(id).support) + solid(id).support_T_solid;
}

Pose Scene::world_T_top(const std::optional<SolidId>& support) const {
  if (!support) return {};
  return world_T_solid(*support) + Pose(0.0, 0.0, solid(*support).top, 0.0, 0.0, 0.0);
}

bool Scene::present(SolidId id) const {
  const Solid& s = solid(id);
  return s.present && (!s.support || present(*s.support));
}

void Scene::setPresent(SolidId id, bool present) {
  solids_.at(id.value).present = present;
}

void Scene::place(SolidId id, const std::optional<SolidId>& support, const Pose& support_T_solid) {
  if (standsOn(support, id))
    throw ConfigError("solid '" + solid(id).name + "' cannot stand on itself or on what it carries");
  Solid& s = solids_.at(id.value);
  s.support = support;
  s.support_T_solid = support_T_solid;
}

std::uint16_t Scene::nextPixelValue(SolidLabel label) const {
  if (label == SolidLabel::background) return kBackgroundValue;
  const int same = static_cast<int>(
      std::count_if(solids_.begin(), solids_.end(), [&](const Solid& s) { return s.label == label; }));
  const bool table = label == SolidLabel::table;
  const int value = (table ? kFirstTable : kFirstObject) + same;
  if (value > (table ? kFirstObject - 1 : std::numeric_limits<std::uint16_t>::max()))
    throw ConfigError("too many solids labelled " + std::string(toString(label)));
  return static_cast<std::uint16_t>(value);
}

bool Scene::standsOn(const std::optional<SolidId>& upper, SolidId lower) const {
  for (auto s = upper; s; s = solid(*s).support)
    if (*s == lower) return true;
  return false;
}

}  // namespace hoctomap
