// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "hoctomap/io/Manifest.h"

namespace hoctomap {

inline constexpr std::size_t kMaxMapNodes = 100'000;
inline constexpr std::size_t kMaxMapDepth = 64;

/// The nodes, parents before children and siblings by id.
/// @throws MapError if they are no tree as Manifest promises it; LimitError if it is too deep.
[[nodiscard]] std::vector<NodeRecord> orderedTree(std::vector<NodeRecord> nodes, const std::string& name);

/// What a run that ended with the last scan of a kept state would have left: of the nodes that wait for
/// confirmation those that enough speaks for are in the tree, the others are gone (docs/decisions/0022).
void endLog(Manifest& manifest);

/// @throws MapError if an id stands for two nodes, or is not below `next_id`.
void checkIds(const Manifest& manifest, const std::string& name);

}  // namespace hoctomap
