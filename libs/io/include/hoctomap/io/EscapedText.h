// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace hoctomap {

/// `text` fit for one line on a terminal: control characters (also those of the C1 set) become
/// `\n`, `\t`, `\xNN`, bytes that are no UTF-8 become `\xNN`; at most `max_bytes` bytes, then `...`.
/// Everything that stems from an input passes through here before it is shown.
[[nodiscard]] std::string escapedText(std::string_view text, std::size_t max_bytes = 2000);

}  // namespace hoctomap
