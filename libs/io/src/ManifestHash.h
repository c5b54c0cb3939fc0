// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace hoctomap {

constexpr std::string_view kOwnHashMark = "# sha256: ";

/// The first line of a manifest, a comment: the hash of all that follows it. Who names the hashes of all
/// files is to be noticed itself when it is cut or a bit of it is flipped.
[[nodiscard]] std::string ownHashLine(std::string_view rest);

/// Whether a manifest's text has such a line and it is not that of the rest. Maps of other programs need not
/// have it, nor have those that a YAML writer has written again.
[[nodiscard]] bool hasWrongOwnHash(std::string_view text);

}  // namespace hoctomap
