// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>

namespace hoctomap {

/// `,` and the number with six decimals, the same in any locale; zero has no sign.
void appendNumber(std::string& line, double value);
void appendVector(std::string& line, const Eigen::Vector3d& value);

/// A field of a CSV row (RFC 4180): quoted where it has to be.
[[nodiscard]] std::string csvField(std::string_view text);

/// Replaces the file. @throws FileError
void writeTextFile(const std::filesystem::path& path, const std::string& text);

}  // namespace hoctomap
