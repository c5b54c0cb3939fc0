// SPDX-License-Identifier: BSD-3-Clause
#include "DirectoryLock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include "NumberText.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

std::string reason() {
  return std::generic_category().message(errno);
}

std::string holder(int descriptor) {
  std::array<char, 24> text{};
  const auto size = ::pread(descriptor, text.data(), text.size(), 0);
  const std::string_view pid(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  const auto number = parseCount(pid.substr(0, pid.find('\n')));
  return number ? "process " + std::to_string(*number) : "another process";
}

/// Whether the file we have locked is still the one of that name: its last holder may have removed it.
bool isCurrent(int descriptor, const std::filesystem::path& file) {
  struct stat locked {};
  struct stat named {};
  return ::fstat(descriptor, &locked) == 0 && ::stat(file.c_str(), &named) == 0 &&
         locked.st_ino == named.st_ino && locked.st_dev == named.st_dev;
}

}  // namespace

DirectoryLock::DirectoryLock(const std::filesystem::path& directory) : file_(directory / kLockName) {
  while (descriptor_ < 0) {
    const int opened = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (opened < 0) throw FileError(directory.string() + ": cannot make the lock file: " + reason());
    if (::flock(opened, LOCK_EX | LOCK_NB) != 0) {
      const std::string who = holder(opened);
      ::close(opened);
      throw FileError(directory.string() + ": " + who +
                      " is writing to this map; wait until it has ended, or choose another directory");
    }
    if (isCurrent(opened, file_)) {
      descriptor_ = opened;
    } else {
      ::close(opened);
    }
  }
  const std::string pid = std::to_string(::getpid()) + "\n";
  if (::ftruncate(descriptor_, 0) != 0 ||
      ::pwrite(descriptor_, pid.data(), pid.size(), 0) != static_cast<ssize_t>(pid.size())) {
    const std::string why = reason();
    ::unlink(file_.c_str());
    ::close(descriptor_);
    throw FileError(directory.string() + ": cannot write the lock file: " + why);
  }
}

DirectoryLock::~DirectoryLock() {
  ::unlink(file_.c_str());  // while it is still locked, so that nobody's new lock is removed
  ::close(descriptor_);
}

}  // namespace hoctomap
