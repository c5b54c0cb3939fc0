// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <memory>

#include "ProcessGuards.h"
#include "Verb.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/mrpt_io/LogWriter.h"

namespace hoctomap {

namespace {

/// Takes messages from stdin up to the end message and completes the log; without one (the sender died)
/// nothing stays behind.
StreamEnd writeLog(const std::string& log, double depth_unit) {
  LogWriter writer(log, depth_unit);
  ScanStreamReader reader(STDIN_FILENO);
  for (;;) {
    const StreamMessage message = reader.read();
    if (const auto* end = std::get_if<StreamEnd>(&message)) {
      writer.finish();
      return *end;
    }
    if (const auto* error = std::get_if<StreamError>(&message)) throwStreamError(*error);
    writer.write(message);
  }
}

StreamMessage resultOf(const std::string& log, double depth_unit) {
  try {
    return writeLog(log, depth_unit);
  } catch (const std::exception& error) {
    return StreamError{exitCodeOf(error), error.what()};
  }
}

int writeLogReporting(const std::string& log, double depth_unit) {
  const int stream = takeOverOutput();
  const StreamMessage result = resultOf(log, depth_unit);
  try {
    ScanStreamWriter(stream).write(result);
  } catch (const FileError&) {
    // The sender is gone: nobody to tell.
  }
  const auto* error = std::get_if<StreamError>(&result);
  return error == nullptr ? 0 : error->exit_code;
}

}  // namespace

void addWriteLogCommand(CLI::App& app, VerbRun& run) {
  auto* verb = app.add_subcommand("write-log", "write a rawlog from binary messages on stdin");
  const auto log = std::make_shared<std::string>();
  const auto unit = std::make_shared<double>(0.001);
  const auto report = std::make_shared<bool>(false);
  verb->add_option("log", *log, "rawlog to write")->required();
  verb->add_option("--depth-unit", *unit, "metres a step of the 16-bit range images")
      ->check(CLI::PositiveNumber);
  verb->add_flag("--report-on-stdout", *report, "answer with a binary message");
  verb->callback([=, &run] {
    run = [=] {
      if (*report) return writeLogReporting(*log, *unit);
      writeLog(*log, *unit);
      return 0;
    };
  });
}

}  // namespace hoctomap
