// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace hoctomap {

/// The whole file.
/// @throws FileError.
[[nodiscard]] std::string readWholeFile(const std::filesystem::path& file);

/// The beginning of a file.
struct FilePart {
  std::string bytes;
  std::uint64_t file_size = 0;  ///< of all of it
};

/// At most `most` bytes of a file: no more memory is taken, whatever its size.
/// @throws FileError.
[[nodiscard]] FilePart readFile(const std::filesystem::path& file, std::uint64_t most);

/// Whether `name` is one of our temporary files, which only a killed session leaves behind.
[[nodiscard]] bool isOurTemporary(const std::string& name);

/// Every change of the disk that a map session makes, each one checked. Members throw FileError.
class Disk {
 public:
  using Hook = std::function<void(std::string_view step, const std::filesystem::path& file)>;
  explicit Disk(Hook before_step) : before_step_(std::move(before_step)) {}

  /// The new file in place of the old one, all or nothing: temporary beside it, written, synced, renamed.
  void replace(const std::filesystem::path& file, std::string_view bytes) const;
  /// The same with a file that somebody else has written.
  void adopt(const std::filesystem::path& temporary, const std::filesystem::path& file) const;
  /// A second name for a file (a copy where the file system has no hard links); replaces `to`.
  void link(const std::filesystem::path& from, const std::filesystem::path& to) const;
  /// Puts `bytes` at `offset`, where the file ends from now on, and syncs it.
  void extend(const std::filesystem::path& file, std::uint64_t offset, std::string_view bytes) const;
  void makeDirectory(const std::filesystem::path& directory) const;
  /// Makes the names in a directory durable.
  void syncDirectory(const std::filesystem::path& directory) const;
  void remove(const std::filesystem::path& file) const;

  /// The name of the temporary file beside `file`.
  [[nodiscard]] static std::filesystem::path temporaryOf(const std::filesystem::path& file);

 private:
  void step(std::string_view name, const std::filesystem::path& file) const;
  Hook before_step_;
};

}  // namespace hoctomap
