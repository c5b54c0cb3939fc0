// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace hoctomap {

/// Looks at a YAML text before the parser does, which takes hundreds of bytes for every bracket that is not
/// closed. A manifest has few brackets in brackets, and no aliases, with which a short text stands for a huge
/// one.
/// @throws MapError naming the line.
void requireSimpleYaml(std::string_view text, const std::string& name);

}  // namespace hoctomap
