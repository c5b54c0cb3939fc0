// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace hoctomap {

/// The page without its data, made by `web/build.mjs`: what stands before the data and after it. Both are
/// empty if the program was built without the packages of npm.
extern const std::string_view kPageHead;
extern const std::string_view kPageTail;

}  // namespace hoctomap
