// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace hoctomap {

constexpr std::string_view kOwnHashMark = "# sha256: ";

/// The first line of a manifest, a comment: the hash of all that follows it. Who names the hashes of all
/// files is to be noticed itself when it is cut or a bit of it is flipped.
[[nodiscard]] std::string ownHashLine(std::string_view rest);

}  // namespace hoctomap
