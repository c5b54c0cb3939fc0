// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace hoctomap {

/// Runs a script of gnuplot's that draws to its standard output, and returns that.
/// @param what needs it, for messages
/// @throws FileError if gnuplot ($HOCTOMAP_GNUPLOT, else on the PATH) is not installed or fails.
[[nodiscard]] std::string drawWithGnuplot(const std::string& script, const std::string& what);

}  // namespace hoctomap
