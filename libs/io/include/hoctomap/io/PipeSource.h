// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "hoctomap/io/ChildProcess.h"
#include "hoctomap/io/LogReadOptions.h"
#include "hoctomap/io/ScanStream.h"
#include "hoctomap/mapping/MeasurementSource.h"

namespace hoctomap {

/// Measurements of recorded logs. The logs are parsed by the helper program `hoctomap-mrpt` in a process of
/// its own, which a foreign log may crash or fill; its scans come over a pipe, and a thread here unprojects
/// up to two of them ahead, so that reading overlaps with mapping.
///
/// Usage:
///   PipeSource source({.logs = {"a.rawlog"}, ...}, limits, [](const std::string& text) { warn(text); });
///   while (auto item = source.next()) ...
///
/// Destroying it early stops and reaps the helper.
class PipeSource final : public MeasurementSource {
 public:
  /// Receives warnings, on the thread that calls next().
  using WarningSink = std::function<void(const std::string&)>;

  /// Starts the helper and waits until it has gone through the logs once: damage, missing poses and bad
  /// options throw here, before anything is mapped.
  /// @throws the error of the helper by its exit code (InputError, LimitError, ...), FileError if it cannot
  /// be
  ///         started.
  PipeSource(const LogReadOptions& options, const RangeLimits& limits, WarningSink warn);
  ~PipeSource() override;

  [[nodiscard]] std::optional<SourceItem> next() override;

  /// Scans that will come at most, as measurements or as skipped scans.
  [[nodiscard]] std::optional<std::uint64_t> totalScans() const override { return header_.chosen_scans; }

  /// What the logs hold, which poses are used, and the hash of the logs.
  [[nodiscard]] const StreamHeader& header() const { return header_; }

 private:
  using Item = std::variant<SourceItem, StreamWarning, StreamEnd, std::exception_ptr>;

  StreamMessage receive();
  [[noreturn]] void throwBroken(const std::exception& cause);
  void readAhead();
  bool push(Item item);
  Item pop();

  std::vector<std::filesystem::path> logs_;
  RangeLimits limits_;
  WarningSink warn_;
  ChildProcess child_;
  ScanStreamReader reader_;
  StreamHeader header_;
  bool ended_ = false;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> queue_;
  bool stopping_ = false;
  std::thread thread_;  // last: starts when all else is ready
};

}  // namespace hoctomap
