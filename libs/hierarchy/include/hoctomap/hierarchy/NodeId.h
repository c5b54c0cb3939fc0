// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>

namespace hoctomap {

/// Identity of a map node. Ids are given once, in order of creation, and never again; the root is 0.
struct NodeId {
  std::uint32_t value = 0;
  auto operator<=>(const NodeId&) const = default;
};

inline constexpr NodeId kRootId{0};

}  // namespace hoctomap
