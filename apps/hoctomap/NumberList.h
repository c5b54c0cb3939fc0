// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

namespace hoctomap {

/// Reads numbers with commas between them, `1,-2.5e-3,+4`, blanks around them allowed, the same in any
/// locale. Replaces what is in `numbers`, so that its memory serves for many lists.
/// @throws std::invalid_argument naming the field that is no finite number
void readNumbers(std::string_view text, std::vector<double>& numbers);

/// The same for one list.
[[nodiscard]] std::vector<double> numberList(std::string_view text);

}  // namespace hoctomap
