// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <string>

namespace hoctomap {

/// Semantic label l_i of a node (Section III-E). Any text without whitespace or control characters.
struct Label {
  std::string name;
  auto operator<=>(const Label&) const = default;
};

namespace labels {
inline const Label background{"background"};
inline const Label table{"table"};
inline const Label object{"object"};
}  // namespace labels

}  // namespace hoctomap
