// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace hoctomap {

enum class Colour { red = 31, green = 32, yellow = 33 };

/// Whether what is written to this file descriptor may have colours: a terminal that can, and no NO_COLOR in
/// the environment (https://no-color.org: set and not empty).
[[nodiscard]] bool hasColours(int descriptor);

/// The text in a colour for standard error, or as it is where there are none.
[[nodiscard]] std::string coloured(std::string_view text, Colour colour);

/// A duration for people: `8 s`, `2:05 min`, `1:02:05 h`.
[[nodiscard]] std::string durationText(double seconds);

}  // namespace hoctomap
