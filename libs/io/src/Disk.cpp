// SPDX-License-Identifier: BSD-3-Clause
#include "Disk.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <system_error>
#include <utility>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/AtomicFile.h"

namespace hoctomap {
namespace {

constexpr std::string_view kTemporaryEnd = ".hoctomap-tmp";

[[noreturn]] void fail(const std::filesystem::path& file, const char* what, int error) {
  throw FileError(file.string() + ": cannot " + what + ": " + std::generic_category().message(error));
}

/// An open file. `close` reports what the destructor would swallow.
class Descriptor {
 public:
  Descriptor(std::filesystem::path file, int flags, const char* what) : file_(std::move(file)) {
    descriptor_ = ::open(file_.c_str(), flags | O_CLOEXEC, 0644);
    if (descriptor_ < 0) fail(file_, what, errno);
  }
  ~Descriptor() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void write(std::string_view bytes, std::uint64_t offset) const {
    while (!bytes.empty()) {
      const auto written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail(file_, "write", written < 0 ? errno : ENOSPC);
      bytes.remove_prefix(static_cast<std::size_t>(written));
      offset += static_cast<std::uint64_t>(written);
    }
  }
  void resize(std::uint64_t size) const {
    if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail(file_, "truncate", errno);
  }
  void sync() const {
    if (::fsync(descriptor_) != 0) fail(file_, "sync", errno);
  }
  void close() {
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(file_, "close", errno);
  }
  [[nodiscard]] int get() const { return descriptor_; }

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

void writeNew(const std::filesystem::path& file, std::string_view bytes) {
  Descriptor out(file, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, "make");
  out.write(bytes, 0);
  out.sync();
  out.close();
}

}  // namespace

std::string readWholeFile(const std::filesystem::path& file) {
  return readFile(file, std::numeric_limits<std::uint64_t>::max()).bytes;
}

FilePart readFile(const std::filesystem::path& file, std::uint64_t most) {
  // A pipe that somebody has put there must not keep us waiting.
  const Descriptor in(file, O_RDONLY | O_NONBLOCK | O_NOCTTY, "open");
  struct stat info {};
  if (::fstat(in.get(), &info) != 0) fail(file, "read", errno);
  if (!S_ISREG(info.st_mode)) throw FileError(file.string() + ": is not a regular file");
  const auto file_size = static_cast<std::uint64_t>(info.st_size);
  std::string bytes(static_cast<std::size_t>(std::min(file_size, most)), '\0');
  std::size_t size = 0;
  while (size < bytes.size()) {
    const auto got = ::read(in.get(), bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(file, "read", errno);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  bytes.resize(size);
  return {std::move(bytes), file_size};
}

bool isOurTemporary(const std::string& name) {
  return name.size() > kTemporaryEnd.size() && name.front() == '.' && name.ends_with(kTemporaryEnd);
}

void replaceFile(const std::filesystem::path& file, std::string_view bytes) {
  const Disk disk({});
  disk.replace(file, bytes);
  disk.syncDirectory(file.has_parent_path() ? file.parent_path() : ".");
}

std::filesystem::path Disk::temporaryOf(const std::filesystem::path& file) {
  return file.parent_path() / ("." + file.filename().string() + std::string(kTemporaryEnd));
}

void Disk::step(std::string_view name, const std::filesystem::path& file) const {
  if (before_step_) before_step_(name, file);
}

void Disk::replace(const std::filesystem::path& file, std::string_view bytes) const {
  const auto temporary = temporaryOf(file);
  try {
    step("write", file);
    ::unlink(temporary.c_str());  // of an earlier attempt: we hold the lock
    writeNew(temporary, bytes);
    step("rename", file);
    if (::rename(temporary.c_str(), file.c_str()) != 0) fail(file, "rename into place", errno);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

void Disk::adopt(const std::filesystem::path& temporary, const std::filesystem::path& file) const {
  step("adopt", file);
  const Descriptor written(temporary, O_RDONLY | O_NOFOLLOW, "open");
  written.sync();
  if (::rename(temporary.c_str(), file.c_str()) != 0) fail(file, "rename into place", errno);
}

void Disk::link(const std::filesystem::path& from, const std::filesystem::path& to) const {
  step("link", to);
  const auto temporary = temporaryOf(to);
  ::unlink(temporary.c_str());
  if (::link(from.c_str(), temporary.c_str()) != 0) {
    const int error = errno;
    if (error != EPERM && error != EOPNOTSUPP && error != EMLINK && error != ENOSYS) {
      fail(from, "link", error);
    }
    writeNew(temporary, readWholeFile(from));
  }
  if (::rename(temporary.c_str(), to.c_str()) != 0) fail(to, "rename into place", errno);
  ::unlink(temporary.c_str());  // rename leaves it where both names were the same file already
}

void Disk::extend(const std::filesystem::path& file, std::uint64_t offset, std::string_view bytes) const {
  step("extend", file);
  Descriptor out(file, O_WRONLY | O_NOFOLLOW, "open");
  try {
    out.resize(offset);
    out.write(bytes, offset);
    out.sync();
  } catch (...) {
    // Gives the room back if it can; the rows are no part of the map in either case.
    if (::ftruncate(out.get(), static_cast<off_t>(offset)) != 0) throw;
    throw;
  }
  out.close();
}

void Disk::makeDirectory(const std::filesystem::path& directory) const {
  if (std::filesystem::is_directory(directory)) return;
  step("mkdir", directory);
  if (::mkdir(directory.c_str(), 0755) != 0) fail(directory, "make the directory", errno);
}

void Disk::syncDirectory(const std::filesystem::path& directory) const {
  step("sync", directory);
  const Descriptor names(directory, O_RDONLY | O_DIRECTORY, "open");
  names.sync();
}

void Disk::remove(const std::filesystem::path& file) const {
  step("remove", file);
  if (::unlink(file.c_str()) != 0 && errno != ENOENT) fail(file, "remove", errno);
}

}  // namespace hoctomap
