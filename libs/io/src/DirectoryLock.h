// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace hoctomap {

/// Name of the lock file in a map directory.
inline constexpr const char* kLockName = ".lock";

/// Makes sure that one process writes to a directory. The lock is the kernel's (`flock`), so that it goes
/// with the process however that ends; the file holds the pid for the message, and is removed at the end.
class DirectoryLock {
 public:
  /// @throws FileError naming the holder's pid if there is one.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace hoctomap
