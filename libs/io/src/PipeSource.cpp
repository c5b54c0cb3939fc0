// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/PipeSource.h"

#include <signal.h>

#include <cstring>
#include <utility>

#include "hoctomap/io/EscapedText.h"

namespace hoctomap {

namespace {

/// Items ready ahead of the mapper: enough to overlap reading with mapping, small in memory.
constexpr std::size_t kAhead = 2;

Measurement measurementFrom(DepthScan&& scan, const RangeLimits& limits) {
  Measurement z = unproject(std::move(scan.image), scan.world_T_sensor, limits);
  z.scan = scan.scan;
  z.stamp = scan.stamp;
  z.sensor = std::move(scan.sensor);
  return z;
}

Measurement measurementFrom(CloudScan&& scan, const RangeLimits& limits) {
  Measurement z = fromSensorPoints(scan.sensor_points, scan.world_T_sensor, limits);
  z.scan = scan.scan;
  z.stamp = scan.stamp;
  z.sensor = std::move(scan.sensor);
  return z;
}

/// A scan of which no point is of use is no scan, one without any points is.
SourceItem itemFrom(Measurement&& z) {
  if (z.world_points.empty() && z.dropped_points > 0) return SkippedScan{z.scan, z.stamp, "no usable point"};
  return std::move(z);
}

std::string where(const StreamPosition& position, const std::vector<std::filesystem::path>& logs) {
  const std::string log = position.log < logs.size() ? escapedText(logs[position.log].string()) : "the log";
  return log + ", object " + std::to_string(position.object) + " at byte " + std::to_string(position.offset);
}

StreamLimits limitsOf(const LogReadOptions& options) {
  StreamLimits limits;
  limits.max_points = options.max_points;
  return limits;
}

}  // namespace

PipeSource::PipeSource(const LogReadOptions& options, const RangeLimits& limits, WarningSink warn)
    : logs_(options.logs),
      limits_(limits),
      warn_(std::move(warn)),
      child_({.program = findHelper(),
              .arguments = toArguments(options),
              .input = ChildProcess::Stream::null,
              .output = ChildProcess::Stream::pipe}),
      reader_(child_.outputFd(), limitsOf(options)) {
  for (bool header_seen = false; !header_seen;) {
    StreamMessage message = receive();
    if (auto* warning = std::get_if<StreamWarning>(&message)) {
      if (warn_) warn_(warning->text);
    } else if (auto* header = std::get_if<StreamHeader>(&message)) {
      header_ = std::move(*header);
      header_seen = true;
    } else {
      throw InputError("scan stream: does not begin with its header");
    }
  }
  thread_ = std::thread([this] { readAhead(); });
}

PipeSource::~PipeSource() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  child_.kill(SIGKILL);  // reads only: nothing to lose; ends a read that waits
  if (thread_.joinable()) thread_.join();
}

std::optional<SourceItem> PipeSource::next() {
  while (!ended_) {
    Item item = pop();
    if (auto* result = std::get_if<SourceItem>(&item)) return std::move(*result);
    if (auto* warning = std::get_if<StreamWarning>(&item)) {
      if (warn_) warn_(warning->text);
      continue;
    }
    ended_ = true;
    if (auto* error = std::get_if<std::exception_ptr>(&item)) std::rethrow_exception(*error);
  }
  return std::nullopt;
}

/// One message; an error message of the helper and the death of the helper become exceptions.
StreamMessage PipeSource::receive() {
  StreamMessage message;
  try {
    message = reader_.read();
  } catch (const InputError& error) {
    throwBroken(error);
  }
  if (const auto* error = std::get_if<StreamError>(&message)) throwStreamError(*error);
  return message;
}

void PipeSource::throwBroken(const std::exception& cause) {
  child_.kill(SIGKILL);  // a helper that sent nonsense may still run; one that died keeps its own status
  const ExitStatus status = child_.wait();
  const std::string reached = " after " + where(reader_.position(), logs_);
  if (status.signal != 0 && status.signal != SIGKILL)
    throw InputError("the log reader crashed (" + std::string(::strsignal(status.signal)) + ")" + reached +
                     ": the log is damaged or made to do harm");
  throw InputError("the log reader stopped" + reached + ": " + cause.what());
}

void PipeSource::readAhead() {
  try {
    for (;;) {
      StreamMessage message = receive();
      Item item = StreamEnd{};
      if (auto* depth = std::get_if<DepthScan>(&message)) {
        item = itemFrom(measurementFrom(std::move(*depth), limits_));
      } else if (auto* cloud = std::get_if<CloudScan>(&message)) {
        item = itemFrom(measurementFrom(std::move(*cloud), limits_));
      } else if (auto* motion = std::get_if<ObjectMotion>(&message)) {
        item = SourceItem(std::move(*motion));
      } else if (auto* skipped = std::get_if<SkippedScan>(&message)) {
        item = SourceItem(std::move(*skipped));
      } else if (auto* warning = std::get_if<StreamWarning>(&message)) {
        item = std::move(*warning);
      } else if (!std::holds_alternative<StreamEnd>(message)) {
        throw InputError("scan stream: a message that does not belong here");
      }
      const bool end = std::holds_alternative<StreamEnd>(item);
      if (!push(std::move(item)) || end) return;
    }
  } catch (...) {
    push(std::current_exception());
  }
}

/// @return false if nobody will take it any more
bool PipeSource::push(Item item) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return stopping_ || queue_.size() < kAhead; });
  if (stopping_) return false;
  queue_.push_back(std::move(item));
  changed_.notify_all();
  return true;
}

PipeSource::Item PipeSource::pop() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !queue_.empty(); });
  Item item = std::move(queue_.front());
  queue_.pop_front();
  changed_.notify_all();
  return item;
}

}  // namespace hoctomap
