// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mrpt_io/LogFileStream.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 16;
constexpr int kGzipWindow = 15 + 16;  // zlib: the largest window, gzip header and trailer

/// Opens a regular file; waits for nothing (a FIFO without a writer would).
UniqueFd openRegular(const std::filesystem::path& file, const std::string& name) {
  UniqueFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (fd.get() < 0) throw InputError(name + ": cannot open: " + std::strerror(errno));
  struct stat info {};
  if (::fstat(fd.get(), &info) != 0) throw InputError(name + ": cannot examine: " + std::strerror(errno));
  if (S_ISDIR(info.st_mode)) throw InputError(name + ": is a directory, not a log");
  if (!S_ISREG(info.st_mode)) throw InputError(name + ": is no regular file (logs are read twice)");
  if (info.st_size == 0) throw InputError(name + ": is empty");
  return fd;
}

}  // namespace

LogFileStream::LogFileStream(const std::filesystem::path& file, const LogReadOptions& budgets,
                             ReadProgress& progress)
    : name_(escapedText(file.string())),
      budgets_(budgets),
      progress_(progress),
      file_(openRegular(file, name_)) {
  input_.resize(kBufferBytes);
  output_.resize(kBufferBytes);
  unsigned char magic[2] = {};
  compressed_ = ::pread(file_.get(), magic, 2, 0) == 2 && magic[0] == 0x1F && magic[1] == 0x8B;
  if (!compressed_) return;
  if (inflateInit2(&zlib_, kGzipWindow) != Z_OK) throw std::bad_alloc();
  in_member_ = true;
}

LogFileStream::~LogFileStream() {
  if (compressed_) inflateEnd(&zlib_);
}

std::size_t LogFileStream::Read(void* into, std::size_t bytes) {
  if (failure_) std::rethrow_exception(failure_);
  object_bytes_ += bytes;
  if (bytes > budgets_.max_object_bytes || object_bytes_ > budgets_.max_object_bytes)
    fail<LimitError>("the object is larger than " + std::to_string(budgets_.max_object_bytes) + " bytes");
  auto* to = static_cast<unsigned char*>(into);
  for (std::size_t left = bytes; left > 0;) {
    if (out_at_ == out_end_ && !fill()) fail<InputError>("the log ends inside an object: it was cut");
    const std::size_t n = std::min(left, out_end_ - out_at_);
    std::memcpy(to, output_.data() + out_at_, n);
    out_at_ += n;
    position_ += n;
    to += n;
    left -= n;
  }
  return bytes;
}

std::size_t LogFileStream::Write(const void*, std::size_t) {
  throw std::logic_error("LogFileStream only reads");
}

bool LogFileStream::atEnd() {
  return out_at_ == out_end_ && !fill();
}

/// Gets more uncompressed bytes; false at the clean end of the file.
bool LogFileStream::fill() {
  if (failure_) std::rethrow_exception(failure_);
  out_at_ = out_end_ = 0;
  progress_.read = position_;
  if (compressed_) return fillCompressed();
  const bool more = refillInput();
  std::swap(input_, output_);
  input_.resize(kBufferBytes);
  out_end_ = zlib_.avail_in;
  zlib_.avail_in = 0;
  return more;
}

bool LogFileStream::fillCompressed() {
  while (out_end_ == 0) {
    if (zlib_.avail_in == 0 && !refillInput()) {
      if (in_member_) fail<InputError>("the compressed data ends too early: the file was cut");
      return false;
    }
    if (!in_member_) {  // behind a trailer: another member, or what does not belong there
      if (*zlib_.next_in != 0x1F) fail<InputError>("stand trailing bytes behind the compressed data");
      inflateReset(&zlib_);
      in_member_ = true;
    }
    inflateMore();
  }
  return true;
}

bool LogFileStream::refillInput() {
  ssize_t n = 0;
  do {
    n = ::read(file_.get(), input_.data(), input_.size());
  } while (n < 0 && errno == EINTR);
  if (n < 0) fail<InputError>(std::string("the log cannot be read: ") + std::strerror(errno));
  zlib_.next_in = input_.data();
  zlib_.avail_in = static_cast<uInt>(n);
  consumed_ += static_cast<std::uint64_t>(n);
  return n > 0;
}

void LogFileStream::inflateMore() {
  zlib_.next_out = output_.data();
  zlib_.avail_out = static_cast<uInt>(output_.size());
  const int result = inflate(&zlib_, Z_NO_FLUSH);
  out_end_ = output_.size() - zlib_.avail_out;
  if (result == Z_MEM_ERROR) throw std::bad_alloc();
  if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR)
    fail<InputError>(std::string("the compressed data is damaged (") +
                     (zlib_.msg != nullptr ? zlib_.msg : "zlib error") + ")");
  if (result == Z_STREAM_END) in_member_ = false;
  const std::uint64_t inflated = position_ + out_end_;
  const double ratio = static_cast<double>(inflated) / static_cast<double>(consumed_ - zlib_.avail_in);
  if (inflated > budgets_.max_inflated_bytes)
    fail<LimitError>("the log inflates to more than " + std::to_string(budgets_.max_inflated_bytes) +
                     " bytes");
  if (inflated > budgets_.ratio_free_bytes && ratio > budgets_.max_ratio)
    fail<LimitError>("the log inflates by more than " + std::to_string(static_cast<int>(budgets_.max_ratio)) +
                     ":1: not a log but a bomb");
}

void LogFileStream::rejectBomb() {
  if (!compressed_ || failure_) return;
  const std::uint64_t enough = budgets_.ratio_free_bytes + kBufferBytes;
  try {
    while (position_ < enough) {
      position_ += out_end_ - out_at_;
      out_at_ = out_end_;
      if (!fill()) return;
    }
  } catch (const InputError&) {
    // Damaged as well: what was found first is told.
  }
}

template <class E>
void LogFileStream::fail(const std::string& what) {
  const std::string compressed =
      compressed_ ? " (compressed: " + std::to_string(consumed_ - zlib_.avail_in) + ")" : "";
  failure_ = std::make_exception_ptr(E("at byte " + std::to_string(position_) + compressed + " " + what));
  std::rethrow_exception(failure_);
}

}  // namespace hoctomap
