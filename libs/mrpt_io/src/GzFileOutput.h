// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <zlib.h>

#include <filesystem>
#include <string>
#include <vector>

#include "hoctomap/io/ChildProcess.h"

namespace hoctomap {

/// A gz file that appears whole or not at all, for `mrpt::serialization::archiveFrom()`. MRPT's own gz output
/// takes a full disk for success; here every write, the sync and the rename are checked. No time stamp
/// inside: same content, same bytes.
class GzFileOutput {
 public:
  /// @param level  of zlib
  /// @throws FileError
  explicit GzFileOutput(const std::filesystem::path& target, int level = Z_DEFAULT_COMPRESSION);
  ~GzFileOutput();
  GzFileOutput(const GzFileOutput&) = delete;
  GzFileOutput& operator=(const GzFileOutput&) = delete;

  std::size_t Write(const void* from, std::size_t bytes);
  std::size_t Read(void*, std::size_t);
  [[nodiscard]] std::string getStreamDescription() const { return target_.string(); }

  /// Ends the compressed data, syncs and renames.
  void commit();

 private:
  void deflateWaiting();
  void deflateAll(int flush);
  [[noreturn]] void fail(const std::string& what) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  UniqueFd file_;
  z_stream zlib_{};
  std::vector<unsigned char> waiting_;  ///< to be compressed: MRPT writes number by number
  std::vector<unsigned char> buffer_;   ///< compressed
  bool committed_ = false;
};

}  // namespace hoctomap
