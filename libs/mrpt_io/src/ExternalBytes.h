// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <zlib.h>

#include <cstddef>
#include <memory>

#include "ExternalFiles.h"

namespace hoctomap {

/// The bytes of a file beside a log, inflated if it is compressed.
class ExternalBytes {
 public:
  explicit ExternalBytes(const ExternalFile& file);
  /// @return how many there were, at most `bytes`; fewer at the end and where it is damaged, which atEnd()
  /// tells apart
  [[nodiscard]] std::size_t readSome(void* into, std::size_t bytes);
  /// @return whether there were so many
  [[nodiscard]] bool read(void* into, std::size_t bytes) { return readSome(into, bytes) == bytes; }
  /// Whether nothing follows, and check sum and length of what was compressed are right.
  [[nodiscard]] bool atEnd();

 private:
  struct Close {
    void operator()(gzFile file) const { gzclose_r(file); }
  };
  std::unique_ptr<gzFile_s, Close> file_;
};

}  // namespace hoctomap
