// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <zlib.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/LogReadOptions.h"
#include "hoctomap/mrpt_io/ReadProgress.h"

namespace hoctomap {

/// Bytes of a log, gz (one or several members) or plain, for `mrpt::serialization::archiveFrom()`.
///
/// MRPT's own gz stream takes a missing trailer for a clean end and a read error for a huge count of bytes;
/// this one reports every kind of damage, and keeps the budgets of LogReadOptions. MRPT wraps exceptions on
/// their way up and loses their type, so the first one is also kept in failure().
class LogFileStream {
 public:
  /// @param progress is told of what is read; outlives the stream
  /// @throws InputError if `file` is missing, unreadable, empty, or no regular file.
  LogFileStream(const std::filesystem::path& file, const LogReadOptions& budgets, ReadProgress& progress);
  ~LogFileStream();
  LogFileStream(const LogFileStream&) = delete;
  LogFileStream& operator=(const LogFileStream&) = delete;

  // What archiveFrom() asks of a stream.
  /// Exactly `bytes` bytes. @throws InputError if they are not there, LimitError beyond a budget.
  std::size_t Read(void* into, std::size_t bytes);
  std::size_t Write(const void*, std::size_t);
  [[nodiscard]] std::string getStreamDescription() const { return name_; }

  /// Whether all bytes are read and, with gz, the trailers are there and right and nothing stands behind
  /// them.
  [[nodiscard]] bool atEnd();
  /// The budget of one object starts anew.
  void beginObject() { object_bytes_ = 0; }
  /// After an object that could not be read: inflates on, up to where the ratio counts, so that a bomb is
  /// called one whatever it pretends to hold. @throws LimitError
  void rejectBomb();
  [[nodiscard]] std::uint64_t position() const { return position_; }  ///< uncompressed bytes read
  [[nodiscard]] bool compressed() const { return compressed_; }
  [[nodiscard]] const std::exception_ptr& failure() const { return failure_; }

 private:
  bool fill();
  bool fillCompressed();
  bool refillInput();
  void inflateMore();
  template <class E>
  [[noreturn]] void fail(const std::string& what);

  std::string name_;
  LogReadOptions budgets_;
  ReadProgress& progress_;
  UniqueFd file_;
  bool compressed_ = false;
  z_stream zlib_{};
  bool in_member_ = false;
  std::vector<unsigned char> input_;   // compressed bytes
  std::vector<unsigned char> output_;  // uncompressed bytes not yet handed out: [out_at_, out_end_)
  std::size_t out_at_ = 0;
  std::size_t out_end_ = 0;
  std::uint64_t consumed_ = 0;  // bytes taken from the file
  std::uint64_t position_ = 0;
  std::uint64_t object_bytes_ = 0;
  std::exception_ptr failure_;
};

}  // namespace hoctomap
