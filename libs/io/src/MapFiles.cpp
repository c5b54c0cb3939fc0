// SPDX-License-Identifier: BSD-3-Clause
#include "MapFiles.h"

#include <string_view>
#include <system_error>
#include <utility>

#include "Disk.h"
#include "ManifestHash.h"
#include "MapNames.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

namespace {
// Twice what the largest map, of 10^5 nodes, needs.
constexpr std::uint64_t kMaxManifestBytes = 1U << 28U;
}  // namespace

void requireMap(const std::filesystem::path& directory) {
  if (!std::filesystem::exists(directory))
    throw MapError(directory.string() + ": there is no such directory");
  if (std::filesystem::exists(directory / kManifestName)) return;
  throw MapError(directory.string() + ": is no map directory: it has no " + kManifestName);
}

std::optional<std::uint64_t> snapshotAt(const std::filesystem::path& directory, std::uint64_t scans,
                                        std::optional<std::uint64_t> at_scan) {
  if (!at_scan || scans == 0 || *at_scan >= scans - 1) return std::nullopt;
  std::optional<std::uint64_t> newest;
  for (const std::uint64_t scan : snapshotScans(directory)) {
    // Those beyond the map itself, of a commit that never was, are beyond what is asked for, too.
    if (scan <= *at_scan) newest = scan;
  }
  if (!newest) {
    throw MapError(directory.string() + ": no state after scan " + std::to_string(*at_scan) +
                   " or before was kept (build --snapshot-every)");
  }
  return newest;
}

std::size_t nodesBegin(std::string_view manifest_text) {
  const std::size_t end_of_line = manifest_text.find("\nnodes:");
  return end_of_line == std::string_view::npos ? end_of_line : end_of_line + 1;
}

std::optional<ManifestHead> headOf(const std::string& text, std::uint64_t file_size,
                                   const std::string& name) {
  const std::size_t begin = nodesBegin(text);
  const bool is_whole = text.size() == file_size;
  // Whoever parses all of it says what is wrong.
  if (begin == std::string::npos || (is_whole && hasWrongOwnHash(text))) return std::nullopt;
  try {
    ManifestHead head{parseManifestHead(text.substr(0, begin), name), file_size - begin, std::nullopt};
    if (is_whole) head.nodes_sha256 = sha256Hex(std::string_view(text).substr(begin));
    return head;
  } catch (const MapError&) {
    return std::nullopt;
  }
}

std::optional<ManifestHead> readManifestHead(const std::filesystem::path& file) {
  constexpr std::uint64_t kMostBytes = 1U << 24U;
  const FilePart part = readFile(file, kMostBytes);
  return headOf(part.bytes, part.file_size, file.string());
}

std::optional<NodeIndex> readIndex(const std::filesystem::path& directory, const ManifestHead& head) {
  if (!head.manifest.index || head.manifest.index->bytes > kMaxManifestBytes) return std::nullopt;
  try {
    NodeIndex index(readChecked(directory, *head.manifest.index, false),
                    (directory / head.manifest.index->path).string());
    const bool is_of_these = index.nodesBytes() == head.nodes_bytes &&
                             (!head.nodes_sha256 || *head.nodes_sha256 == index.nodesSha256());
    if (is_of_these) return index;
  } catch (const Error&) {
    // `verify` tells.
  }
  return std::nullopt;
}

namespace {

/// The manifest with its nodes from the index that is bound to this very text.
std::optional<Manifest> manifestByIndex(const std::filesystem::path& file, const std::string& text) {
  auto head = headOf(text, text.size(), file.string());
  if (!head) return std::nullopt;
  const auto index = readIndex(file.parent_path(), *head);
  if (!index) return std::nullopt;
  try {
    index->addNodes(head->manifest);
  } catch (const MapError&) {
    return std::nullopt;
  }
  return std::move(head->manifest);
}

}  // namespace

Manifest readManifestFile(const std::filesystem::path& file) {
  const FilePart part = readFile(file, kMaxManifestBytes);
  if (part.file_size > kMaxManifestBytes) throw LimitError(file.string() + ": is larger than 256 MiB");
  if (auto manifest = manifestByIndex(file, part.bytes)) return *std::move(manifest);
  return parseManifest(part.bytes, file.string());
}

std::string readChecked(const std::filesystem::path& directory, const FileRecord& record, bool prefix) {
  const auto file = directory / record.path;
  if (!std::filesystem::exists(file)) throw MapError(file.string() + ": is missing");
  const auto refuseSize = [&](std::uint64_t size) {
    throw MapError(file.string() + ": has " + std::to_string(size) + " bytes, the manifest says " +
                   std::to_string(record.bytes));
  };
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);  // before any memory is taken
  if (!error && (prefix ? size < record.bytes : size != record.bytes)) refuseSize(size);
  std::string bytes = readFile(file, record.bytes).bytes;
  if (bytes.size() != record.bytes) refuseSize(bytes.size());
  if (sha256Hex(bytes) != record.sha256) {
    throw MapError(file.string() + ": does not have the hash that the manifest says");
  }
  return bytes;
}

}  // namespace hoctomap
