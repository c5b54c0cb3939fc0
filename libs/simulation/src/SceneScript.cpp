// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/SceneScript.h"

#include <algorithm>

#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

[[noreturn]] void fail(const SceneEvent& event, const std::string& what) {
  throw ConfigError("event of '" + event.solid + "' at scan " + std::to_string(event.scan) + ": " + what);
}

SolidId require(const Scene& scene, const SceneEvent& event, const std::string& name) {
  const auto id = scene.find(name);
  if (!id) fail(event, "there is no solid '" + name + "'");
  return *id;
}

bool tellsPlace(const SceneEvent& event) {
  return event.position || event.yaw_pitch_roll || event.support;
}

void place(Scene& scene, const SceneEvent& event, SolidId id) {
  const Solid& solid = scene.solid(id);
  auto support = solid.support;
  if (event.support)
    support = *event.support == "world" ? std::nullopt : std::optional(require(scene, event, *event.support));
  const Pose& old = solid.support_T_solid;
  const Eigen::Vector3d p = event.position.value_or(Eigen::Vector3d(old.x(), old.y(), old.z()));
  const Eigen::Vector3d a =
      event.yaw_pitch_roll.value_or(Eigen::Vector3d(old.yaw(), old.pitch(), old.roll()));
  scene.place(id, support, Pose(p.x(), p.y(), p.z(), a.x(), a.y(), a.z()));
}

void swapPlaces(Scene& scene, SolidId a, SolidId b) {
  const auto support_a = scene.solid(a).support;
  const Pose pose_a = scene.solid(a).support_T_solid;
  const auto support_b = scene.solid(b).support;
  const Pose pose_b = scene.solid(b).support_T_solid;
  scene.place(a, support_b, pose_b);
  scene.place(b, support_a, pose_a);
}

void applyEvent(Scene& scene, const SceneEvent& event) {
  const SolidId id = require(scene, event, event.solid);
  const bool there = scene.solid(id).present;
  switch (event.action) {
    case SceneAction::appear:
      if (there) fail(event, "it cannot appear, it is there");
      if (tellsPlace(event)) place(scene, event, id);
      scene.setPresent(id, true);
      return;
    case SceneAction::vanish:
      if (!there) fail(event, "it cannot vanish, it is not there");
      scene.setPresent(id, false);
      return;
    case SceneAction::move:
      if (!there) fail(event, "it cannot move, it is not there");
      if (!tellsPlace(event)) fail(event, "a move needs a position, an orientation or a support");
      place(scene, event, id);
      return;
    case SceneAction::swap: {
      const SolidId other = require(scene, event, event.other);
      if (other == id) fail(event, "it cannot be swapped with itself");
      if (!there || !scene.solid(other).present) fail(event, "both solids of a swap must be there");
      swapPlaces(scene, id, other);
      return;
    }
  }
}

}  // namespace

SceneScript::SceneScript(std::vector<SceneEvent> events) : events_(std::move(events)) {
  std::stable_sort(events_.begin(), events_.end(),
                   [](const SceneEvent& a, const SceneEvent& b) { return a.scan < b.scan; });
}

void SceneScript::apply(Scene& scene, std::uint64_t scan) const {
  for (const SceneEvent& event : events_)
    if (event.scan == scan) applyEvent(scene, event);
}

Scene SceneScript::at(Scene initial, std::uint64_t scan) const {
  for (const SceneEvent& event : events_)
    if (event.scan <= scan) applyEvent(initial, event);
  return initial;
}

}  // namespace hoctomap
