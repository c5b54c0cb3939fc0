// SPDX-License-Identifier: BSD-3-Clause
#include "MapFiles.h"

#include <system_error>

#include "Disk.h"
#include "MapNames.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/Sha256.h"

namespace hoctomap {

namespace {
constexpr std::uintmax_t kMaxManifestBytes = 1U << 30U;
}

void requireMap(const std::filesystem::path& directory) {
  if (!std::filesystem::exists(directory))
    throw MapError(directory.string() + ": there is no such directory");
  if (std::filesystem::exists(directory / kManifestName)) return;
  throw MapError(directory.string() + ": is no map directory: it has no " + kManifestName);
}

Manifest readManifestFile(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (!error && size > kMaxManifestBytes) throw LimitError(file.string() + ": is larger than 1 GiB");
  return parseManifest(readWholeFile(file), file.string());
}

std::string readChecked(const std::filesystem::path& directory, const FileRecord& record, bool prefix) {
  const auto file = directory / record.path;
  if (!std::filesystem::exists(file)) throw MapError(file.string() + ": is missing");
  std::string bytes = readWholeFile(file);
  if (prefix && bytes.size() > record.bytes) bytes.resize(static_cast<std::size_t>(record.bytes));
  if (bytes.size() != record.bytes) {
    throw MapError(file.string() + ": has " + std::to_string(bytes.size()) + " bytes, the manifest says " +
                   std::to_string(record.bytes));
  }
  if (sha256Hex(bytes) != record.sha256) {
    throw MapError(file.string() + ": does not have the hash that the manifest says");
  }
  return bytes;
}

}  // namespace hoctomap
