// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "hoctomap/simulation/TriangleMesh.h"

namespace hoctomap {

/// The triangles of a mesh file (any format that assimp reads: STL, PLY, OBJ, ...), all its parts in the
/// file's own axes and origin, times `scale` (0.001 for files in millimetres).
/// @throws InputError if the file cannot be read, has no triangles or coordinates that are not finite;
///         LimitError beyond 10^7 triangles.
[[nodiscard]] TriangleMesh loadMesh(const std::filesystem::path& path, double scale);

}  // namespace hoctomap
