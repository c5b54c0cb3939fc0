// SPDX-License-Identifier: BSD-3-Clause
#include "StreamLog.h"

#include <new>

#include "ProcessGuards.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {

int streamLog(const LogReadOptions& options, int stream) {
  ReadProgress progress;
  try {
    ScanStreamWriter writer(stream);
    reportCrashes(LastWord::stream_message, stream, options.logs, progress);
    try {
      LogReader reader(options, progress);
      reader.stream(
          [&](const StreamMessage& message, const StreamPosition& at) { writer.write(message, at); });
      return 0;
    } catch (const std::bad_alloc&) {
      writer.write(StreamError{6, "not enough memory to read the log"}, progress.get());
      return 6;
    } catch (const std::exception& error) {
      writer.write(StreamError{exitCodeOf(error), error.what()}, progress.get());
      return exitCodeOf(error);
    }
  } catch (const FileError&) {
    return 5;  // nobody reads any more
  }
}

}  // namespace hoctomap
