# SPDX-License-Identifier: BSD-3-Clause
# The stream part of this library: scans over a pipe, the helper process.
set(HOCTOMAP_IO_STREAM_SOURCES
  src/ScanStreamEscape.cpp
  src/ScanStreamWriter.cpp
  src/ScanStreamReader.cpp
  src/StreamLogReadOptions.cpp
  src/PipeWrite.cpp
  src/ChildProcess.cpp
  src/ChildHelper.cpp
  src/PipeSource.cpp
  src/PipeLogWriter.cpp)
