// SPDX-License-Identifier: BSD-3-Clause
#include "GzFileOutput.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
constexpr int kGzipWindow = 15 + 16;  // zlib: the largest window, gzip header and trailer
constexpr int kMemoryLevel = 8;       // zlib's default

}  // namespace

GzFileOutput::GzFileOutput(const std::filesystem::path& target, int level)
    : target_(target),
      temporary_(target.parent_path() /
                 ("." + target.filename().string() + "." + std::to_string(::getpid()) + ".tmp")),
      file_(::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666)),
      buffer_(kBufferBytes) {
  waiting_.reserve(kBufferBytes);
  if (file_.get() < 0) fail(std::string("cannot be written: ") + std::strerror(errno));
  if (deflateInit2(&zlib_, level, Z_DEFLATED, kGzipWindow, kMemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
}

GzFileOutput::~GzFileOutput() {
  deflateEnd(&zlib_);
  if (!committed_) ::unlink(temporary_.c_str());
}

std::size_t GzFileOutput::Write(const void* from, std::size_t bytes) {
  if (waiting_.size() + bytes > kBufferBytes) deflateWaiting();
  const auto* first = static_cast<const unsigned char*>(from);
  waiting_.insert(waiting_.end(), first, first + bytes);
  return bytes;
}

std::size_t GzFileOutput::Read(void*, std::size_t) {
  throw std::logic_error("GzFileOutput only writes");
}

void GzFileOutput::deflateWaiting() {
  if (waiting_.size() > std::numeric_limits<uInt>::max()) fail("an object is too large");
  zlib_.next_in = waiting_.data();
  zlib_.avail_in = static_cast<uInt>(waiting_.size());
  deflateAll(Z_NO_FLUSH);
  waiting_.clear();
}

void GzFileOutput::deflateAll(int flush) {
  int result = Z_OK;
  do {
    zlib_.next_out = buffer_.data();
    zlib_.avail_out = static_cast<uInt>(buffer_.size());
    result = deflate(&zlib_, flush);
    const unsigned char* from = buffer_.data();
    for (std::size_t left = buffer_.size() - zlib_.avail_out; left > 0;) {
      const ssize_t n = ::write(file_.get(), from, left);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail(std::string("cannot be written: ") + std::strerror(errno));
      from += n;
      left -= static_cast<std::size_t>(n);
    }
  } while (zlib_.avail_out == 0 || (flush == Z_FINISH && result != Z_STREAM_END));
}

void GzFileOutput::commit() {
  deflateWaiting();
  deflateAll(Z_FINISH);
  if (::fsync(file_.get()) != 0) fail(std::string("cannot be synced: ") + std::strerror(errno));
  if (::close(file_.release()) != 0) fail(std::string("cannot be closed: ") + std::strerror(errno));
  if (::rename(temporary_.c_str(), target_.c_str()) != 0)
    fail(std::string("cannot be renamed: ") + std::strerror(errno));
  committed_ = true;
  // The new name itself reaches the disk with its folder.
  const auto parent = target_.has_parent_path() ? target_.parent_path() : std::filesystem::path(".");
  const UniqueFd folder(::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() >= 0) ::fsync(folder.get());
}

void GzFileOutput::fail(const std::string& what) const {
  throw FileError(escapedText(target_.string()) + ": " + what);
}

}  // namespace hoctomap
