// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "hoctomap/mapping/SeamVotes.h"

namespace hoctomap {

/// The votes as CSV: `x,y,z,shown,cut0,...,cut12`, one cell a line, ascending. Same votes, same bytes.
[[nodiscard]] std::string seamsText(const SeamVotes& seams);

/// @throws MapError naming file and line.
[[nodiscard]] SeamVotes parseSeams(const std::string& text, const std::string& name);

}  // namespace hoctomap
