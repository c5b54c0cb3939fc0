// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "hoctomap/io/Manifest.h"

namespace hoctomap {

/// The last part of a manifest's text: the nodes, of which there may be many.
[[nodiscard]] std::string manifestNodesText(const Manifest& manifest);
/// The text of a manifest whose last part is made already.
[[nodiscard]] std::string manifestText(const Manifest& manifest, const std::string& nodes_text);

/// Where the nodes begin in a manifest's text as we write it; npos if they are not there.
[[nodiscard]] std::size_t nodesBegin(std::string_view manifest_text);

/// The manifest of its head's text, without nodes.
/// @throws MapError naming file and key.
[[nodiscard]] Manifest parseManifestHead(const std::string& text, const std::string& name);

/// A manifest of which only the head was parsed.
struct ManifestHead {
  Manifest manifest;
  std::uint64_t nodes_bytes = 0;            ///< of the rest of the file
  std::optional<std::string> nodes_sha256;  ///< of the rest, if it was read
};

/// @param text  the beginning of a manifest
/// @param file_size  of all of it
/// @returns nothing if it does not begin as we write it: then the whole has to be parsed
[[nodiscard]] std::optional<ManifestHead> headOf(const std::string& text, std::uint64_t file_size,
                                                 const std::string& name);

/// The head of a manifest's file, of which no more than 16 MiB are read: the nodes of a larger one are known
/// by their size only, and its own hash is not checked.
[[nodiscard]] std::optional<ManifestHead> readManifestHead(const std::filesystem::path& file);

}  // namespace hoctomap
