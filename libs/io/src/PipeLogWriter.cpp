// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/io/PipeLogWriter.h"

#include <array>
#include <charconv>

namespace hoctomap {

namespace {

std::string unitArgument(double unit) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), unit).ptr;
  return "--depth-unit=" + std::string(buffer.data(), end);
}

std::vector<std::string> arguments(const std::filesystem::path& log, double unit, bool external_images) {
  std::vector<std::string> words{"write-log", unitArgument(unit), "--report-on-stdout"};
  if (external_images) words.emplace_back("--external-images");
  words.emplace_back("--");
  words.push_back(log.string());
  return words;
}

}  // namespace

PipeLogWriter::PipeLogWriter(const std::filesystem::path& log, double depth_unit_m, bool external_images)
    : child_({.program = findHelper(),
              .arguments = arguments(log, depth_unit_m, external_images),
              .input = ChildProcess::Stream::pipe,
              .output = ChildProcess::Stream::pipe}),
      writer_(child_.inputFd()) {}

void PipeLogWriter::write(const StreamMessage& message) {
  try {
    writer_.write(message);
  } catch (const FileError&) {
    throwFailure();
  }
  if (std::holds_alternative<DepthScan>(message) || std::holds_alternative<CloudScan>(message)) ++scans_;
}

void PipeLogWriter::finish() {
  write(StreamEnd{scans_, 0});
  child_.closeInput();
  // One message comes back: the end or an error.
  const StreamMessage answer = [&] {
    try {
      return ScanStreamReader(child_.outputFd()).read();
    } catch (const InputError&) {
      throwFailure();
    }
  }();
  if (const auto* error = std::get_if<StreamError>(&answer)) throwStreamError(*error);
  child_.wait();
}

/// The helper has closed its end: says why.
void PipeLogWriter::throwFailure() {
  child_.closeInput();
  StreamMessage answer;
  try {
    answer = ScanStreamReader(child_.outputFd()).read();
  } catch (const InputError&) {
    throw FileError("the log writer stopped without a word");
  }
  if (const auto* error = std::get_if<StreamError>(&answer)) throwStreamError(*error);
  throw FileError("the log writer stopped early");
}

}  // namespace hoctomap
