// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace hoctomap {

/// The first line of a manifest: the hash of all that follows it. Who names the hashes of all files is to be
/// noticed itself when it is cut or a bit of it is flipped.
[[nodiscard]] std::string ownHashLine(std::string_view rest);

}  // namespace hoctomap
