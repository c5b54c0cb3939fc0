// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hoctomap/geometry/Pose.h"
#include "hoctomap/simulation/TriangleMesh.h"

namespace hoctomap {

/// What a map should call a solid.
enum class SolidLabel { background, table, object };

[[nodiscard]] std::string_view toString(SolidLabel label);

/// Identity of a solid: its place in the order of adding. Never reused.
struct SolidId {
  std::uint32_t value = 0;
  auto operator<=>(const SolidId&) const = default;
};

/// A rigid thing. It stands in the world or on another solid and moves with what it stands on.
struct Solid {
  std::string name;  ///< unique; letters, digits, `_`, `-`: it goes into file names and CSV files
  SolidLabel label = SolidLabel::object;
  std::shared_ptr<const TriangleMesh> surface;  ///< in the solid's frame; may be shared by many solids
  double top = 0.0;                ///< z, in the solid's frame, of the face that other solids stand on
  std::optional<SolidId> support;  ///< what it stands on; none = the world
  /// Pose relative to the support's `top` (axes of the support, origin raised by `top`), or to the world.
  Pose support_T_solid;
  bool present = true;
};

/// The named solids of a simulated place and their state at one moment. A plain value: copies are cheap,
/// since surfaces are shared, and independent.
class Scene {
 public:
  /// @throws ConfigError if the name is taken or not made of the allowed characters, the surface is empty,
  /// the
  ///         support is unknown, or there is no pixel value left (see `pixelValue`).
  SolidId add(Solid solid);

  [[nodiscard]] std::size_t size() const { return solids_.size(); }
  [[nodiscard]] std::vector<SolidId> ids() const;
  [[nodiscard]] const Solid& solid(SolidId id) const { return solids_.at(id.value); }
  [[nodiscard]] std::optional<SolidId> find(std::string_view name) const;

  [[nodiscard]] Pose world_T_solid(SolidId id) const;
  /// World pose of the frame in which the poses of solids that stand on `support` are given.
  [[nodiscard]] Pose world_T_top(const std::optional<SolidId>& support) const;

  /// A solid is there if it and everything below it is: who takes a table away takes what stands on it.
  [[nodiscard]] bool present(SolidId id) const;
  void setPresent(SolidId id, bool present);

  /// Puts a solid, with all that stands on it, somewhere else.
  /// @throws ConfigError if `support` is the solid itself or stands on it.
  void place(SolidId id, const std::optional<SolidId>& support, const Pose& support_T_solid);

  /// What a truth image says where this solid is seen: background 1, table i 10+i, object j 100+j, counted in
  /// the order of adding. The same during the whole life of the scene.
  [[nodiscard]] std::uint16_t pixelValue(SolidId id) const { return pixel_values_.at(id.value); }

 private:
  std::vector<Solid> solids_;
  std::vector<std::uint16_t> pixel_values_;

  [[nodiscard]] std::uint16_t nextPixelValue(SolidLabel label) const;
  [[nodiscard]] bool standsOn(const std::optional<SolidId>& upper, SolidId lower) const;
};

}  // namespace hoctomap
