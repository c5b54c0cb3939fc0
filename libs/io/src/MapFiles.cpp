// SPDX-License-Identifier: BSD-3-Clause
#include "MapFiles.h"

#include <system_error>

#include "Disk.h"
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

Manifest readManifestFile(const std::filesystem::path& file) {
  const FilePart part = readFile(file, kMaxManifestBytes);
  if (part.file_size > kMaxManifestBytes) throw LimitError(file.string() + ": is larger than 256 MiB");
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
