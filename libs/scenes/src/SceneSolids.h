// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "hoctomap/config/IniDocument.h"
#include "hoctomap/simulation/Scene.h"

namespace hoctomap {

inline constexpr double kDegree = 0.017453292519943295;
inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{0.0, std::numeric_limits<double>::infinity(), true, false};
inline constexpr Range kNotNegative{0.0, std::numeric_limits<double>::infinity()};

/// `solid.NAME` -> `NAME` if `section` starts with `prefix`, otherwise empty.
[[nodiscard]] std::string nameAfter(std::string_view prefix, const std::string& section);

/// Three numbers of a key.
[[nodiscard]] Eigen::Vector3d readVector(IniDocument& ini, const std::string& section, const std::string& key,
                                         const Eigen::Vector3d& fallback);

/// The scene made of all sections [solid.NAME]. Notes what is wrong in `ini`.
[[nodiscard]] Scene readSolids(IniDocument& ini, const std::filesystem::path& mesh_folder);

}  // namespace hoctomap
