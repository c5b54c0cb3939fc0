// SPDX-License-Identifier: BSD-3-Clause
// Takes the place of what `web/build.mjs` makes where there is no node or no `web/node_modules`.
#include "PageText.h"

namespace hoctomap {

const std::string_view kPageHead;
const std::string_view kPageTail;

}  // namespace hoctomap
