// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>
#include <vector>

#include "hoctomap/simulation/TriangleMesh.h"

namespace hoctomap {

// Every shape stands on its origin: the origin is the centre of its base, z points up, metres.

struct BoxShape {
  Eigen::Vector3d size{0.1, 0.1, 0.1};  ///< along x, y, z
};

struct CylinderShape {
  double radius = 0.05;
  double height = 0.1;
};

struct SphereShape {
  double radius = 0.05;
};

/// A tube bent from the wall outwards and back to the wall, in the half plane y = 0, x > 0.
struct Handle {
  double low = 0.02;      ///< z of the lower end
  double high = 0.08;     ///< z of the upper end
  double reach = 0.03;    ///< how far the axis of the tube stands off the wall
  double radius = 0.005;  ///< of the tube
};

/// A surface of revolution about z: cups, bowls, bottles, vases.
struct TurnedShape {
  std::vector<Eigen::Vector2d> profile;  ///< (radius, z) of the outside, bottom up
  double wall = 0.0;                     ///< horizontal thickness and thickness of the bottom; 0 = solid
  std::optional<Handle> handle;
};

/// A top on four legs; the legs are square and flush with the top's corners.
struct TableShape {
  Eigen::Vector2d size{1.2, 0.8};  ///< of the top
  double height = 0.72;            ///< of the upper face
  double thickness = 0.03;
  double leg = 0.05;  ///< width of a leg
};

using Shape = std::variant<BoxShape, CylinderShape, SphereShape, TurnedShape, TableShape>;

/// The shape's closed surface. Curved shapes deviate from it by at most kChordTolerance.
/// @throws ConfigError if a size is not positive and finite, a profile is not bottom up, or a wall is thicker
///         than the radius it is taken from.
[[nodiscard]] TriangleMesh tessellate(const Shape& shape);

inline constexpr double kChordTolerance = 1e-5;  ///< metres

}  // namespace hoctomap
