// SPDX-License-Identifier: BSD-3-Clause
#include "MapQuestions.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <string>

namespace hoctomap {

namespace {

constexpr std::string_view kBox = "x,y,z,sx,sy,sz[,yaw[,pitch,roll]]";

Eigen::Vector3d vectorAt(std::span<const double> numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

/// Centre and edges, in metres, and how it is turned, in degrees.
Obb boxOf(std::span<const double> numbers) {
  const Eigen::Vector3d edges = vectorAt(numbers, 3);
  if (edges.minCoeff() < 0.0) throw std::invalid_argument("the edges of a box must not be negative");
  const auto angle = [&](std::size_t i) {
    return i < numbers.size() ? numbers[i] * std::numbers::pi / 180.0 : 0.0;
  };
  return {toIsometry(Pose(numbers[0], numbers[1], numbers[2], angle(6), angle(7), angle(8))),
          Eigen::AlignedBox3d(-0.5 * edges, 0.5 * edges)};
}

std::string_view nameOf(Occupancy state) {
  if (state == Occupancy::unknown) return "unknown";
  return state == Occupancy::free ? "free" : "occupied";
}

std::string_view nameOf(RayAnswer::End end) {
  if (end == RayAnswer::End::nothing) return "nothing";
  return end == RayAnswer::End::unknown ? "unknown" : "hit";
}

void tellPoint(const std::optional<Eigen::Vector3d>& p, AnswerSink& answer) {
  constexpr std::array<std::string_view, 3> kNames{"hit_x", "hit_y", "hit_z"};
  for (int axis = 0; axis < 3; ++axis) {
    const auto name = kNames[static_cast<std::size_t>(axis)];
    if (p) {
      answer.number(name, (*p)[axis]);
    } else {
      answer.none(name);
    }
  }
}

}  // namespace

const std::vector<QuestionForm>& questionForms() {
  static const std::vector<QuestionForm> forms{
      {QuestionKind::point,
       "point",
       "x,y,z",
       "state,node,label,existence,probability",
       "is this point occupied, and which node says so?",
       {3}},
      {QuestionKind::ray,
       "ray",
       "x,y,z,dx,dy,dz",
       "end,distance,hit_x,hit_y,hit_z,node,label,existence",
       "what does a ray from here in this direction meet first?",
       {6}},
      {QuestionKind::box,
       "box",
       kBox,
       "collides,node,label,existence",
       "does a box (centre, edges in m, turned by degrees) touch anything occupied?",
       {6, 7, 9}},
      {QuestionKind::sphere,
       "sphere",
       "x,y,z,r",
       "collides,node,label,existence",
       "does a sphere touch anything occupied?",
       {4}},
      {QuestionKind::distance,
       "distance",
       "x,y,z",
       "distance,hit_x,hit_y,hit_z,node,label,existence",
       "how far is the surface of the nearest occupied voxel, and whose is it?",
       {3}},
      {QuestionKind::unknown,
       "unknown",
       kBox,
       "unknown_share",
       "how much of a box does no node know?",
       {6, 7, 9}},
      {QuestionKind::objects,
       "objects",
       kBox,
       "nodes",
       "which tables and objects have occupied voxels in a box, and which share of them?",
       {6, 7, 9}}};
  return forms;
}

void MapQuestions::ask(const QuestionForm& form, std::span<const double> numbers, AnswerSink& answer) const {
  if (std::find(form.counts.begin(), form.counts.end(), numbers.size()) == form.counts.end()) {
    throw std::invalid_argument(std::to_string(numbers.size()) + " numbers, not " +
                                std::string(form.numbers));
  }
  switch (form.kind) {
    case QuestionKind::point:
      return askPoint(vectorAt(numbers, 0), answer);
    case QuestionKind::ray:
      return askRay(vectorAt(numbers, 0), vectorAt(numbers, 3), answer);
    case QuestionKind::box:
      return tellCollision(query_.collision(boxOf(numbers)), answer);
    case QuestionKind::sphere:
      if (numbers[3] < 0.0) throw std::invalid_argument("a radius must not be negative");
      return tellCollision(query_.collision(vectorAt(numbers, 0), numbers[3]), answer);
    case QuestionKind::distance:
      return askDistance(vectorAt(numbers, 0), answer);
    case QuestionKind::unknown:
      return answer.number("unknown_share", query_.unknownShare(boxOf(numbers), options_.step));
    case QuestionKind::objects:
      return answer.nodes("nodes", query_.nodesIn(boxOf(numbers)));
  }
}

void MapQuestions::askPoint(const Eigen::Vector3d& p, AnswerSink& answer) const {
  const PointAnswer found = query_.at(p);
  answer.text("state", nameOf(found.state));
  tellNode(found.node, answer);
  answer.number("probability", found.probability);
}

void MapQuestions::askRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                          AnswerSink& answer) const {
  const RayAnswer found = query_.castRay(origin, direction, options_.ray);
  answer.text("end", nameOf(found.end));
  const bool ends = found.end != RayAnswer::End::nothing;
  if (ends) {
    answer.number("distance", found.distance);
  } else {
    answer.none("distance");
  }
  tellPoint(ends ? std::optional(found.point) : std::nullopt, answer);
  tellNode(found.node, answer);
}

void MapQuestions::askDistance(const Eigen::Vector3d& p, AnswerSink& answer) const {
  const auto found = query_.nearestOccupied(p, options_.ray.max_range);
  if (found) {
    answer.number("distance", found->distance);
  } else {
    answer.none("distance");
  }
  tellPoint(found ? std::optional(found->point) : std::nullopt, answer);
  tellNode(found ? std::optional(found->node) : std::nullopt, answer);
}

void MapQuestions::tellCollision(std::optional<NodeId> node, AnswerSink& answer) const {
  answer.flag("collides", node.has_value());
  tellNode(node, answer);
}

void MapQuestions::tellNode(std::optional<NodeId> node, AnswerSink& answer) const {
  if (node) {
    const auto& places = map_->places();
    const auto found = std::ranges::lower_bound(places, *node, {}, &NodePlace::id);
    answer.node("node", *node);
    answer.text("label", map_->label(static_cast<std::size_t>(found - places.begin())).name);
    answer.number("existence", found->existence);
  } else {
    for (const auto name : {"node", "label", "existence"}) answer.none(name);
  }
}

}  // namespace hoctomap
