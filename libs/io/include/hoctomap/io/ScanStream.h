// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/mapping/MeasurementSource.h"

namespace hoctomap {

// Scans between two programs: what `hoctomap-mrpt read` sends and `hoctomap-mrpt write-log` takes.
//
// Format, version 3, little endian throughout:
//   stream  = "HOCTSCAN" u32 version  frame*
//   frame   = u32 type  u32 bytes  u32 log  u32 zero  u64 object  u64 offset  payload[bytes]
//   string  = u32 bytes  bytes          pose = f64[12], the upper three rows of the 4x4 matrix, row-major
//   type 1 header : u64 scans  u64 chosen  string pose_source  string sha256  u32 n { string label
//                   string class  u64 scans  u32 width  u32 height }[n]
//   type 2 depth  : u64 scan  f64 stamp  string sensor  pose world_T_sensor  u32 width  u32 height
//                   f64 fx fy cx cy  f32 depth[height * width], row-major
//                   u32 width  u32 height  u8 rgb[height * width][3] (0 x 0: no colours)
//   type 3 cloud  : u64 scan  f64 stamp  string sensor  pose world_T_sensor  u64 n  f32 xyz[n][3]
//                   u64 n or 0  u8 rgb[n][3]
//   type 4 motion : f64 stamp  u32 node  pose t
//   type 5 skipped: u64 scan  f64 stamp  string reason
//   type 6 warning: string text         type 7 truth: f64 stamp  string label  pose world_T_base
//   type 8 error  : u32 exit_code  string text      type 9 end: u64 used  u64 skipped
// `log`, `object` and `offset` (bytes, uncompressed) say in every frame how far the sender has read. The
// first frame of `read` is a header, the last one an end or an error; a stream that stops without either was
// cut.

/// How far the sender has come in its logs.
struct StreamPosition {
  std::uint32_t log = 0;     ///< number of the log, from 0
  std::uint64_t object = 0;  ///< number of the object in that log, from 0
  std::uint64_t offset = 0;  ///< where that object starts, bytes, uncompressed
  bool operator==(const StreamPosition&) const = default;
};

struct StreamHeader {
  struct Sensor {
    std::string label;
    std::string type;  ///< MRPT's class
    std::uint64_t scans = 0;
    std::uint32_t width = 0;  ///< of the range image; 0 if unorganised
    std::uint32_t height = 0;
  };
  std::uint64_t total_scans = 0;   ///< all 3D scans of the logs
  std::uint64_t chosen_scans = 0;  ///< at most this many will come, as scans or as skipped scans
  std::string pose_source;         ///< for the log of the run
  std::vector<std::string>
      log_sha256;  ///< hex, of each log with the files beside it that it names; may be empty
  std::vector<Sensor> sensors;
};

/// A picture beside the range image, for writing logs: what it shows is in register with it, each with its
/// own size. Row-major, red, green, blue.
struct ColourImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
  [[nodiscard]] bool empty() const { return rgb.empty(); }
};

struct DepthScan {
  std::uint64_t scan = 0;
  double stamp = 0.0;  ///< seconds since the epoch
  std::string sensor;
  Pose world_T_sensor;
  DepthImage image;
  ColourImage colour{};  ///< may be empty; logs are read without it
};

struct CloudScan {
  std::uint64_t scan = 0;
  double stamp = 0.0;
  std::string sensor;
  Pose world_T_sensor;
  PointCloud sensor_points;
  std::vector<std::array<std::uint8_t, 3>> colours{};  ///< one a point, or none; logs are read without them
};

struct StreamWarning {
  std::string text;
};

/// True pose of the robot's base, for writing logs: stands before the scans of the same stamp.
struct TruthPose {
  double stamp = 0.0;
  std::string label = "groundtruth";
  Pose world_T_base;
};

struct StreamError {
  int exit_code = 3;
  std::string text;
};

struct StreamEnd {
  std::uint64_t used = 0;
  std::uint64_t skipped = 0;
};

using StreamMessage = std::variant<StreamHeader, DepthScan, CloudScan, ObjectMotion, SkippedScan,
                                   StreamWarning, TruthPose, StreamError, StreamEnd>;

/// What a reader accepts; more is refused with LimitError before memory is taken.
struct StreamLimits {
  std::uint64_t max_points = 10'000'000;  ///< of a cloud, or pixels of an image
  std::uint32_t max_string_bytes = 65'536;
  std::uint32_t max_sensors = 10'000;
  std::uint32_t max_logs = 100'000;
};

/// The sender's end. Does not own the descriptor. A receiver that is gone gives FileError, never SIGPIPE.
class ScanStreamWriter {
 public:
  /// Sends the preamble. @throws FileError as write().
  explicit ScanStreamWriter(int fd);
  /// @throws FileError if the receiver is gone or the write fails.
  void write(const StreamMessage& message, const StreamPosition& position = {});

 private:
  void send() const;

  int fd_;
  std::vector<std::uint8_t> frame_;  ///< reused from message to message
};

/// Sends an error from a signal handler: async-signal-safe, errors of the write are lost. A ScanStreamWriter
/// of `fd` must have been made, and none be writing.
void sendErrorFromSignalHandler(int fd, int exit_code, const char* text,
                                const StreamPosition& position) noexcept;

/// The receiver's end. Does not own the descriptor. Trusts nothing: every length is checked before memory is
/// taken, every pose and camera before it is handed on.
class ScanStreamReader {
 public:
  explicit ScanStreamReader(int fd, StreamLimits limits = {});

  /// The next message; waits for it.
  /// @throws InputError if the stream is cut or malformed, LimitError beyond the limits, FileError if reading
  ///         fails.
  [[nodiscard]] StreamMessage read();

  /// Position sent with the last whole frame header.
  [[nodiscard]] const StreamPosition& position() const { return position_; }

 private:
  void readPreamble();
  void readFully(void* into, std::size_t bytes);

  int fd_;
  StreamLimits limits_;
  StreamPosition position_;
  bool preamble_read_ = false;
  std::vector<std::uint8_t> payload_;
};

/// The exception whose type belongs to `error.exit_code` (2 to 6; anything else: InputError), thrown.
[[noreturn]] void throwStreamError(const StreamError& error);

/// Exit code of an exception by its type: 2 to 6 for this project's errors, 6 for std::bad_alloc, else 3.
[[nodiscard]] int exitCodeOf(const std::exception& error);

}  // namespace hoctomap
