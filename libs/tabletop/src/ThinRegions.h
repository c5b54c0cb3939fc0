// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hoctomap {

/// What of the table a picture shows.
struct RisePicture {
  static constexpr int kWindow = 1;  ///< pixels, half a window of 3 x 3 that rises are averaged over

  int width = 0;
  int height = 0;
  std::vector<float> rise;             ///< m above the table; NaN: not near it
  std::vector<float> least;            ///< m, the rise that is evidence there
  std::vector<std::uint8_t> thick;     ///< something that rises for certain
  std::vector<Eigen::Vector2f> place;  ///< m, seen from above
  std::vector<float> upright;          ///< m: what is upright may be as far off, seen from above

  [[nodiscard]] std::size_t at(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
};

/// The regions of a picture that stand above the table and end at a step (docs/decisions/0030).
class ThinRegions {
 public:
  /// Keeps references. @param pixel_angle2  solid angle of a pixel  @param range2  m^2, of every pixel
  ThinRegions(const RisePicture& picture, double pixel_angle2, std::span<const float> range2);

  /// Looks for connected pixels that rise more than `level` times what is evidence. What is found later holds
  /// what was found before.
  void findAbove(double level);

  /// Number of the thing of every pixel, -1 where there is none.
  [[nodiscard]] const std::vector<std::int32_t>& thing() const { return thing_; }
  [[nodiscard]] std::int32_t things() const { return things_; }

 private:
  [[nodiscard]] bool isAbove(std::size_t i, double level) const;
  void follow(int seed, double level, std::int32_t number, std::vector<std::int32_t>& region,
              std::vector<int>& pixels) const;
  /// @param pixels  of the region; what goes up into something thicker, and is not level, is left out
  [[nodiscard]] bool isThing(std::vector<int>& pixels, std::int32_t number,
                             const std::vector<std::int32_t>& region) const;
  /// Takes out of a region what of it rises above `level` where something thicker goes up: the lower part of
  /// the front of what stands on a thin thing.
  void leaveFronts(const std::vector<int>& contact, double level, std::vector<int>& pixels) const;
  [[nodiscard]] std::optional<std::size_t> offset(int u, int v, int du, int dv) const;

  const RisePicture& picture_;
  double pixel_angle2_;
  std::span<const float> range2_;
  std::vector<std::int32_t> thing_;
  std::int32_t things_ = 0;
};

}  // namespace hoctomap
