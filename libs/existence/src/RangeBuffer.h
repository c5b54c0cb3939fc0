// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "hoctomap/existence/RangeView.h"

namespace hoctomap {

/// Nearest range of rendered voxels over a rectangle of a view.
class RangeBuffer {
 public:
  static constexpr float kEmpty = std::numeric_limits<float>::infinity();

  /// All pixels of `view` that lie in the rectangle [u0, u1] x [v0, v1].
  RangeBuffer(int u0, int v0, int u1, int v1)
      : u0_(u0),
        v0_(v0),
        width_(u1 - u0 + 1),
        height_(v1 - v0 + 1),
        range_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kEmpty) {}

  /// Renders a cube of edge `size` metres as the square it covers about its centre.
  void splat(const RangeView::Pixel& center, float focal, float size);
  /// The same, but only where the centre lies half an edge or more behind what `front` holds.
  /// @param beside  also where `front` holds nothing
  void splatBehind(const RangeBuffer& front, const RangeView::Pixel& center, float focal, float size,
                   bool beside);

  /// The nearer of both, where `other` lies within this one.
  void overlay(const RangeBuffer& other);

  [[nodiscard]] int u0() const { return u0_; }
  [[nodiscard]] int v0() const { return v0_; }
  [[nodiscard]] int u1() const { return u0_ + width_ - 1; }
  [[nodiscard]] int v1() const { return v0_ + height_ - 1; }
  /// Nearest rendered range, `kEmpty` if there is none.
  [[nodiscard]] float at(int u, int v) const {
    if (u < u0_ || v < v0_ || u >= u0_ + width_ || v >= v0_ + height_) return kEmpty;
    return range_[static_cast<std::size_t>(v - v0_) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(u - u0_)];
  }

 private:
  template <typename Visit>
  void forPixels(const RangeView::Pixel& center, float focal, float size, const Visit& visit);

  int u0_;
  int v0_;
  int width_;
  int height_;
  std::vector<float> range_;
};

}  // namespace hoctomap
